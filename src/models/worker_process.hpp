/// \file
/// One running worker and the pipes to it; internal to Worker.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "io/descriptor.hpp"
#include "io/scratch_directory.hpp"
#include "models/child.hpp"

namespace models {

/// The worker has gone, or has been killed because the time was over.
struct WorkerEnded {
  /// How.
  ChildEnd end;
};

/// A pipe whose ends are closed with it.
struct Pipe {
  /// \throws std::system_error if there are no more descriptors.
  Pipe();
  /// The end to read from.
  io::Descriptor reading;
  /// The end to write to.
  io::Descriptor writing;
};

/// A child that reads lines and answers with lines, in a directory of its own.
class WorkerProcess {
 public:
  /// \param arguments  the first is the path of the program
  explicit WorkerProcess(const std::vector<std::string>& arguments);
  /// Ends its input, gives it a second to end by itself (none after an interrupt), and kills what
  /// is left of its group.
  ~WorkerProcess();
  WorkerProcess(const WorkerProcess&) = delete;
  WorkerProcess& operator=(const WorkerProcess&) = delete;

  /// Writes a text and reads lines at the same time, so that neither side waits for a full pipe.
  /// \param longest_line  bytes of a line without an end that are taken, before it is refused
  /// \param take_line  called for each line without its end; true if it was the last. What else has
  ///        been written is handed over too.
  /// \throws ModelError if it has written something before, a very long line, or has closed a
  ///         stream and goes on; WorkerEnded if it has ended or the deadline has passed;
  ///         io::Interrupted if a signal has come; what take_line throws. In all these cases its
  ///         group has been killed.
  void exchange(std::string_view text, std::chrono::steady_clock::time_point deadline,
                std::size_t longest_line, const std::function<bool(std::string_view line)>& take_line);

 private:
  bool take_lines(std::size_t longest_line, const std::function<bool(std::string_view line)>& take_line);
  [[noreturn]] void throw_ended();
  bool receive();
  bool send(std::string_view& text);

  io::ScratchDirectory directory_{"worker"};
  Pipe to_;
  Pipe from_;
  std::unique_ptr<Child> child_;
  std::string unread_;
};

}  // namespace models
