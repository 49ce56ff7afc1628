/// \file
/// Samples with weights: what they are worth, and equally weighted ones drawn from them.
#pragma once

#include "tmcmc/resampling.hpp"
#include "tmcmc/result.hpp"

namespace tmcmc {

/// Effective number of independent draws behind the weighted mean m of each parameter,
///
///     sum w (x - m)^2 sum w / sum w^2 (x - m)^2,
///
/// the variance of the parameter over that of its mean. Equal weights make it n.
/// \param points   n x d, independent
/// \param weights  n, non-negative
/// \return  d entries; 0 for a constant parameter or where all weights are 0
[[nodiscard]] Eigen::VectorXd effective_sample_sizes(const Population& points,
                                                     const Eigen::VectorXd& weights);

/// n equally weighted points, n x d, drawn from the weighted samples of a run. Sample i is expected n
/// w_i / sum(w) times.
/// \param scheme  residual resampling (Douc, Cappe and Moulines 2005) disturbs means least;
///                multinomial gives n independent draws, whose distribution functions spread as those
///                of independent samples do
/// \param key     a run that has drawn with it stays independent of the choice
/// \throws errors::InvalidValue for n below 1, or a result whose weights do not go with its samples
[[nodiscard]] Population equally_weighted(const Result& result, Index n, const StreamKey& key,
                                          Resampling scheme = Resampling::residual);

}  // namespace tmcmc
