/// \file
/// Runs of a sampler that draws from the exact posterior: the floor below any other's p-boxes.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "estimation/exact_posterior.hpp"
#include "pbox/pbox.hpp"

namespace replication {

/// The runs' empirical distribution functions of each parameter.
using Ecdfs = std::array<std::vector<pbox::Ecdf>, friction::parameter_count>;

/// R runs of N independent exact draws each.
/// \param seed, study  of the random streams, which are not those of synthetic observations
[[nodiscard]] Ecdfs exact_runs(const estimation::ExactPosterior& posterior, std::uint64_t seed,
                               std::uint32_t study, long runs, long samples);

/// Areas (Eq. 25) of the p-boxes of exact_runs, one entry a parameter.
[[nodiscard]] std::array<double, friction::parameter_count> exact_areas(
    const estimation::ExactPosterior& posterior, std::uint64_t seed, std::uint32_t study, long runs,
    long samples);

/// Area (Eq. 25) of the p-box of `runs` sets of independent exact draws of one parameter.
[[nodiscard]] double exact_area(const estimation::TabulatedDensity& exact, std::uint64_t seed,
                                std::uint32_t study, long runs, long samples);

}  // namespace replication
