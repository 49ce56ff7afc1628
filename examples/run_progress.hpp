/// \file
/// What a run is doing, on the terminal.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

#include "tmcmc/sampler.hpp"

namespace examples {

/// One line on standard error, if that is a terminal, from half a second on and five times a second, whether or not a call of the
/// model has come back: run, stage, beta, log-likelihoods and time. It is gone when the object is.
class RunProgress {
 public:
  /// \param runs  their number
  /// \param evaluations  budget of each
  RunProgress(long runs, long evaluations, bool is_enabled);
  ~RunProgress();
  RunProgress(const RunProgress&) = delete;
  RunProgress& operator=(const RunProgress&) = delete;

  /// A run begins, counted from 1.
  void begin(long run);
  /// After the runs the model is evaluated again, so many times, for what the posterior predicts.
  void begin_prediction(tmcmc::Index evaluations);
  /// So many evaluations are done; from any thread.
  void advance(tmcmc::Index evaluations) { done_ += evaluations; }
  /// A stage has ended.
  void update(const tmcmc::Progress& progress);

 private:
  void draw() const;

  long runs_;
  long evaluations_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::atomic<long> done_ = 0;        // of the run or of the prediction
  std::atomic<long> prediction_ = 0;  // its evaluations; 0 during the runs
  std::atomic<long> run_ = 1;
  std::atomic<std::size_t> stage_ = 0;
  std::atomic<double> beta_ = 0.0;
  std::mutex mutex_;
  std::condition_variable_any wake_;
  std::jthread drawer_;  // last, so that it ends first
};

}  // namespace examples
