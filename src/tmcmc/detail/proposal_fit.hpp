/// \file
/// The proposals of a stage, fitted to the weighted population before it.
#pragma once

#include "tmcmc/detail/population_move.hpp"
#include "tmcmc/options.hpp"
#include "tmcmc/result.hpp"

namespace tmcmc::detail {

/// The kernels of a stage. With cross_fit the starts whose parent chain is even get a kernel that
/// was fitted to the odd chains, and the other way round; unless one half of the weights is too few
/// for its covariance. The caller sets their beta.
/// \param weights    of the rows of `from`, with the sum weight_sum
/// \param ancestors  row of `from` that each chain starts from
/// \throws SamplingError if a covariance is not finite.
[[nodiscard]] StageKernels stage_kernels(const Prior& prior, const Options& options, const State& from,
                                         ConstDoubles weights, double weight_sum,
                                         std::span<const Index> ancestors);

}  // namespace tmcmc::detail
