/// \file
/// Runs of a sampler that draws from the exact posterior: a lower limit for the p-box areas of any
/// other sampler.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "estimation/exact_posterior.hpp"
#include "pbox/pbox.hpp"

namespace replication {

/// The empirical distribution functions of the runs, for each parameter.
using Ecdfs = std::array<std::vector<pbox::Ecdf>, friction::parameter_count>;

/// R runs of N independent exact draws each.
/// \param seed, study  select the random streams, which differ from those of synthetic observations
[[nodiscard]] Ecdfs exact_runs(const estimation::ExactPosterior& posterior, std::uint64_t seed,
                               std::uint32_t study, long runs, long samples);

/// An area for each parameter, in its unit.
using Areas = std::array<double, friction::parameter_count>;

/// Areas (Eq. 25) of the p-boxes of exact_runs.
[[nodiscard]] Areas exact_areas(const estimation::ExactPosterior& posterior, std::uint64_t seed,
                                std::uint32_t study, long runs, long samples);

/// Quantile of the areas of each parameter over the studies.
/// \param probability  in [0, 1]
/// \throws errors::InvalidValue if there is no study.
[[nodiscard]] Areas area_quantiles(const std::vector<Areas>& studies, double probability);

/// Area (Eq. 25) of the p-box of `runs` sets of independent exact draws of one parameter.
[[nodiscard]] double exact_area(const estimation::TabulatedDensity& exact, std::uint64_t seed,
                                std::uint32_t study, long runs, long samples);

}  // namespace replication
