/// \file
/// The progress of a run, shown on the terminal.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

#include "tmcmc/sampler.hpp"

namespace examples {

/// One line on standard error, if that is a terminal, shown after half a second and updated five
/// times a second, whether or not a call of the model has returned: run, stage, beta,
/// log-likelihoods and time. It disappears with the object.
class RunProgress {
 public:
  /// \param runs  number of runs
  /// \param evaluations  budget of each run
  RunProgress(long runs, long evaluations, bool is_enabled);
  ~RunProgress();
  RunProgress(const RunProgress&) = delete;
  RunProgress& operator=(const RunProgress&) = delete;

  /// Marks the beginning of a run, counted from 1.
  void begin(long run);
  /// Announces that after the runs the model is evaluated so many more times, for the posterior
  /// prediction.
  void begin_prediction(tmcmc::Index evaluations);
  /// Adds a number of completed evaluations; may be called from any thread.
  void advance(tmcmc::Index evaluations) { done_ += evaluations; }
  /// Marks the end of a stage.
  void update(const tmcmc::Progress& progress);

 private:
  void draw() const;

  long runs_;
  long evaluations_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  // of the run or of the prediction
  std::atomic<long> done_ = 0;
  // its evaluations; 0 during the runs
  std::atomic<long> prediction_ = 0;
  std::atomic<long> run_ = 1;
  std::atomic<std::size_t> stage_ = 0;
  std::atomic<double> beta_ = 0.0;
  std::mutex mutex_;
  std::condition_variable_any wake_;
  // last, so that it ends first
  std::jthread drawer_;
};

}  // namespace examples
