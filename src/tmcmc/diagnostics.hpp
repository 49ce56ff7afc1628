/// \file
/// Diagnostics of a finished run.
#pragma once

#include <span>
#include <string>

#include "tmcmc/options.hpp"
#include "tmcmc/result.hpp"

namespace tmcmc {

/// Effective number of independent draws behind the mean of each parameter: the variance of a
/// parameter divided by the variance of its mean. The latter is estimated from sums over groups of
/// related samples (Chan and Lai 2013; Lee and Whiteley 2018). The groups are the descendants of
/// the chains of an earlier stage, the earliest from which an effective number of fewest_groups is
/// left; if there is no such stage, the groups are the chains themselves.
/// \return  one entry per parameter; 0 for a constant parameter or a single chain
[[nodiscard]] Eigen::VectorXd effective_sample_sizes(const Population& points, const Genealogy& genealogy);

/// The subject of a kind of warning, in a few words.
[[nodiscard]] const char* describe(WarningKind kind);

/// How a run ended, in a few words that name the option responsible.
[[nodiscard]] const char* describe(StopReason stop);

/// Effective sample sizes and warnings of a run. Uses final, stages, stop and evidence of the
/// result.
/// \param names  names of the parameters, for the warnings
[[nodiscard]] Diagnostics diagnose(const Result& result, const Options& options,
                                   std::span<const std::string> names);

}  // namespace tmcmc
