/// \file
/// The paper's problem, small enough for a test.
#pragma once

#include <utility>

#include "data/columns.hpp"
#include "estimation/exact_posterior.hpp"
#include "replication/study.hpp"

namespace test_data {

/// Table 2, with the natural frequency's lower bound of the reading.
inline tmcmc::BoxPrior table2(const replication::Reading& reading) {
  Eigen::Vector4d lower(0.01, 0.01, 0.001, 0.001);
  lower[friction::natural_frequency] = reading.natural_frequency_lower_hz.value_or(0.01);
  return {lower, Eigen::Vector4d(10.0, 10.0, 10.0, 1.0)};
}

inline tmcmc::Problem paper_problem(const replication::Reading& reading) {
  return replication::problem(reading, table1(), table2(reading));
}

/// The exact posterior of Table 1 under Table 2, with exact physics.
inline const estimation::ExactPosterior& paper_posterior() {
  static const estimation::ExactPosterior posterior(
      friction::Likelihood(table1(), {}), {{{0.01, 10.0}, {0.01, 10.0}, {0.001, 10.0}, {0.001, 1.0}}});
  return posterior;
}

inline replication::Reading small_reading(replication::ReadingName name, tmcmc::Index samples) {
  replication::Reading reading = replication::reading(name);
  reading.sampler.samples = samples;
  return reading;
}

}  // namespace test_data
