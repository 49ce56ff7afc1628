/// \file
/// The proposals of a stage, fitted to the weighted population before it.
#pragma once

#include "tmcmc/detail/population_move.hpp"
#include "tmcmc/options.hpp"
#include "tmcmc/result.hpp"

namespace tmcmc::detail {

/// The kernels of a stage. With cross_fit the starts whose parent chain is even get a kernel that
/// was fitted to the odd chains, and vice versa, unless one half of the weights is too small for
/// its covariance. The caller sets beta.
/// \param weights  weights of the rows of `from`, with the sum weight_sum
/// \param ancestors  row of `from` from which each chain starts
/// \throws SamplingError if a covariance is not finite.
[[nodiscard]] StageKernels stage_kernels(const Prior& prior, const Options& options, const State& from,
                                         ConstDoubles weights, double weight_sum,
                                         std::span<const Index> ancestors);

}  // namespace tmcmc::detail
