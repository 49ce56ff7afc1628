/// \file
/// What a finished run says about its own quality.
#pragma once

#include <span>
#include <string>

#include "tmcmc/options.hpp"
#include "tmcmc/result.hpp"

namespace tmcmc {

/// Effective number of independent draws behind the mean of each parameter: the variance of a
/// parameter over the variance of its mean, the latter from sums over groups of related samples
/// (Chan and Lai 2013; Lee and Whiteley 2018). The groups are the descendants of one chain of an
/// earlier stage, of the earliest from which fewest_groups are left in effect; where there is none,
/// the chains themselves.
/// \return  one entry per parameter; 0 for a constant parameter or a single chain
[[nodiscard]] Eigen::VectorXd effective_sample_sizes(const Population& points, const Genealogy& genealogy);

/// What a kind of warning is about, in a few words.
[[nodiscard]] const char* describe(WarningKind kind);

/// How a run ended, in a few words that name the option behind it.
[[nodiscard]] const char* describe(StopReason stop);

/// Effective sample sizes and warnings of a run. Reads final, stages, stop and evidence of the
/// result.
/// \param names  of the parameters, for the warnings
[[nodiscard]] Diagnostics diagnose(const Result& result, const Options& options,
                                   std::span<const std::string> names);

}  // namespace tmcmc
