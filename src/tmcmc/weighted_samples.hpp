/// \file
/// Samples with weights: their effective size, and equally weighted samples drawn from them.
#pragma once

#include "tmcmc/resampling.hpp"
#include "tmcmc/result.hpp"

namespace tmcmc {

/// Effective number of independent draws behind the weighted mean m of each parameter,
///
///     sum w (x - m)^2 sum w / sum w^2 (x - m)^2,
///
/// the variance of the parameter divided by the variance of its mean. With equal weights it is n.
/// \param points   n x d, independent
/// \param weights  n, non-negative
/// \return  d entries; 0 for a constant parameter or where all weights are 0
[[nodiscard]] Eigen::VectorXd effective_sample_sizes(const Population& points,
                                                     const Eigen::VectorXd& weights);

/// n equally weighted points, n x d, drawn from the weighted samples of a run. The expected number
/// of copies of sample i is n w_i / sum(w).
/// \param scheme  residual resampling (Douc, Cappe and Moulines 2005) disturbs means least;
///        multinomial gives n independent draws, whose distribution functions vary as those of
///        independent samples do
/// \param key  key of the draws; a run that has used the same key stays independent of them
/// \throws errors::InvalidValue for n below 1, or a result whose weights are inconsistent with its
///         samples
[[nodiscard]] Population equally_weighted(const Result& result, Index n, const StreamKey& key,
                                          Resampling scheme = Resampling::residual);

}  // namespace tmcmc
