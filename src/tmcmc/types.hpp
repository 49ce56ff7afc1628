/// \file
/// Types shared by the parts of the sampler.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <span>
#include <stdexcept>

#ifdef TMCMC_EIGEN_MEMORY  // set for users of an installed library
static_assert(TMCMC_EIGEN_MEMORY == EIGEN_DEFAULT_ALIGN_BYTES + EIGEN_MALLOC_ALREADY_ALIGNED,
              "tmcmc was compiled for another instruction set or sanitizer than this file, so that Eigen's "
              "memory cannot pass between them: give both the same -m and -fsanitize flags");
#endif

namespace tmcmc {

/// Signed size of Eigen: rows, columns and counts.
using Index = Eigen::Index;

/// One row per sample, one column per parameter.
using Population = Eigen::MatrixXd;

/// Batch log-likelihood: fills log_likelihood[i] for row i of points. Minus infinity marks a point
/// that the model excludes; NaN, plus infinity and values that are not written are errors. A row's
/// value must not depend on the other rows of the batch. With more than one thread the function is
/// called from several threads at the same time.
using LogLikelihood = std::function<void(const Eigen::Ref<const Eigen::MatrixXd>& points,
                                         Eigen::Ref<Eigen::VectorXd> log_likelihood)>;

/// One number per sample, read only.
using ConstDoubles = std::span<const double>;

/// Thrown by a run that cannot continue: no feasible draw, a criterion that no step meets, a NaN
/// likelihood.
class SamplingError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Thrown if no draw from the prior is feasible: prior and model are incompatible.
class InfeasiblePriorError : public SamplingError {
 public:
  using SamplingError::SamplingError;
};

/// Non-owning view of the entries; v must outlive it.
[[nodiscard]] inline ConstDoubles as_span(const Eigen::VectorXd& v) {
  return {v.data(), static_cast<std::size_t>(v.size())};
}

}  // namespace tmcmc
