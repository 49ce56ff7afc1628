/// \file
/// A log-likelihood that remembers what it has evaluated, so that a run that was stopped can be
/// repeated without paying for it again.
#pragma once

#include <mutex>
#include <string>
#include <unordered_map>

#include "tmcmc/result.hpp"

namespace tmcmc::detail {

/// Called with all that has been evaluated so far.
using EvaluationObserver = std::function<void(const Walkers& evaluated)>;

/// Values of points that are known are taken from memory; others are evaluated, in calls of at most
/// `rows` points, and remembered. Can be called from several threads.
class RecordedLikelihood {
 public:
  /// \param known     points with their log-likelihoods from an earlier run
  /// \param rows      of new points between two calls of the observer, and at most in one call
  /// \param observer  empty for none
  RecordedLikelihood(const LogLikelihood& log_likelihood, const Walkers& known, Index rows,
                     EvaluationObserver observer);

  /// As LogLikelihood.
  void operator()(const Eigen::Ref<const Eigen::MatrixXd>& points, Eigen::Ref<Eigen::VectorXd> values);

 private:
  void remember(const Population& points, const Eigen::VectorXd& values);

  const LogLikelihood& log_likelihood_;
  Index rows_;
  EvaluationObserver observer_;
  /// By the bytes of a point.
  std::unordered_map<std::string, double> known_;
  /// Guards what follows.
  std::mutex mutex_;
  /// With room for more rows; the first count_ are in use.
  Walkers evaluated_;
  Index count_ = 0;
  Index observed_ = 0;
};

}  // namespace tmcmc::detail
