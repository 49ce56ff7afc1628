/// \file
/// A log-likelihood that remembers its evaluations, so that a run that was stopped can be repeated
/// without evaluating the same points again.
#pragma once

#include <mutex>
#include <string>
#include <unordered_map>

#include "tmcmc/result.hpp"

namespace tmcmc::detail {

/// Called with all points that have been evaluated so far.
using EvaluationObserver = std::function<void(const Walkers& evaluated)>;

/// Values of known points are taken from memory; other points are evaluated, in calls of at most
/// `rows` points, and remembered. May be called concurrently.
class RecordedLikelihood {
 public:
  /// \param known  points with their log-likelihoods from an earlier run
  /// \param rows  number of new points between two calls of the observer, and largest number in one
  ///        call
  /// \param observer  may be empty
  RecordedLikelihood(const LogLikelihood& log_likelihood, const Walkers& known, Index rows,
                     EvaluationObserver observer);

  /// As LogLikelihood.
  void operator()(const Eigen::Ref<const Eigen::MatrixXd>& points, Eigen::Ref<Eigen::VectorXd> values);

 private:
  void remember(const Population& points, const Eigen::VectorXd& values);

  const LogLikelihood& log_likelihood_;
  Index rows_;
  EvaluationObserver observer_;
  /// Known values, by the bytes of a point.
  std::unordered_map<std::string, double> known_;
  /// Guards the members that follow.
  std::mutex mutex_;
  /// Evaluated points, with room for more rows; the first count_ rows are in use.
  Walkers evaluated_;
  Index count_ = 0;
  Index observed_ = 0;
};

}  // namespace tmcmc::detail
