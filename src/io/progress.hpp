#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <mutex>
#include <string>

namespace io {

/// A progress bar on standard error. It appears only if standard error is a terminal and the work
/// has lasted more than 1.5 s, is redrawn at most ten times a second, and disappears with the
/// object. Otherwise it does nothing.
class Progress {
 public:
  /// `label` stands before the bar, `total` is the number of steps; a total of 0 shows nothing.
  Progress(std::string label, std::size_t total, bool enabled);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Counts n more steps as done. Thread-safe; never waits for another thread to write to the
  /// terminal.
  /// \throws Interrupted and nothing else: work that shows its progress can be interrupted at each
  ///         step.
  void advance(std::size_t n = 1);

 private:
  using Clock = std::chrono::steady_clock;
  void draw(std::size_t done, Clock::duration elapsed);

  std::string label_;
  std::size_t total_;
  bool active_;
  Clock::time_point start_ = Clock::now();
  std::atomic<std::size_t> done_{0};
  // guards the two members below
  std::mutex mutex_;
  Clock::time_point last_draw_{};
  bool drawn_ = false;
};

}  // namespace io
