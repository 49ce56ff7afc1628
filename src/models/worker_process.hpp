/// \file
/// One running worker and the pipes to it; internal to Worker.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/scratch_directory.hpp"
#include "models/child.hpp"

namespace models {

/// The worker has gone, or has been killed because the time was over.
struct WorkerEnded {
  ChildEnd end;  ///< how
};

/// A descriptor that is closed with its owner.
class Descriptor {
 public:
  /// \param value  taken over; -1: none
  explicit Descriptor(int value = -1) : value_(value) {}
  ~Descriptor() { close(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  /// Closes it, and takes over another.
  void reset(int value) {
    close();
    value_ = value;
  }
  /// Gives it away.
  [[nodiscard]] int release() { return std::exchange(value_, -1); }
  void close();                                     ///< at most once
  [[nodiscard]] int get() const { return value_; }  ///< -1 once closed

 private:
  int value_;
};

/// A child that reads lines and answers with lines, in a directory of its own.
class WorkerProcess {
 public:
  /// \param arguments  the first is the path of the program
  explicit WorkerProcess(const std::vector<std::string>& arguments);
  /// Ends its input, gives it a second to end by itself (none after an interrupt), and kills what is left of its group.
  ~WorkerProcess();
  WorkerProcess(const WorkerProcess&) = delete;
  WorkerProcess& operator=(const WorkerProcess&) = delete;

  /// Writes a text and reads lines at the same time, so that neither side waits for a full pipe.
  /// \param longest_line  bytes of a line without an end that are taken, before it is refused
  /// \param take_line  called for each line without its end; true if it was the last. What else has been written is handed over too.
  /// \throws ModelError if it has written something before, a very long line, or has closed a stream and goes on; WorkerEnded if it has ended or the deadline has passed; io::Interrupted if a signal has come; what take_line throws.
  ///         In all these cases its group has been killed.
  void exchange(std::string_view text, std::chrono::steady_clock::time_point deadline,
                std::size_t longest_line, const std::function<bool(std::string_view line)>& take_line);

 private:
  bool take_lines(std::size_t longest_line, const std::function<bool(std::string_view line)>& take_line);
  [[noreturn]] void throw_ended();
  bool receive();
  bool send(std::string_view& text);

  io::ScratchDirectory directory_{"worker"};
  Descriptor to_;
  Descriptor from_;
  std::unique_ptr<Child> child_;
  std::string unread_;
};

}  // namespace models
