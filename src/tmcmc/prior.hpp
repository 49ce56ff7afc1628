/// \file
/// Independent uniform prior on a box (Table 2).
#pragma once

#include "tmcmc/random.hpp"
#include "tmcmc/types.hpp"

namespace tmcmc {

/// Uniform density on the box lower < x < upper. Another prior is a uniform one in other parameters: map the box by the
/// prior's quantile functions inside the log-likelihood.
class BoxPrior {
 public:
  /// \param lower,upper  one bound a parameter
  /// \throws std::invalid_argument unless both have the same positive length, and lower < upper with a finite
  ///         distance and at least one double between them.
  BoxPrior(Eigen::VectorXd lower, Eigen::VectorXd upper);

  /// d, the number of parameters.
  [[nodiscard]] Index dimension() const { return lower_.size(); }
  /// Lower bounds, d.
  [[nodiscard]] const Eigen::VectorXd& lower() const { return lower_; }
  /// Upper bounds, d.
  [[nodiscard]] const Eigen::VectorXd& upper() const { return upper_; }

  /// n independent draws, n x dimension, none on a bound. They do not depend on the threads.
  [[nodiscard]] Population sample(Index n, const StreamKey& key, int threads = 1) const;

 private:
  Eigen::VectorXd lower_;
  Eigen::VectorXd upper_;
};

}  // namespace tmcmc
