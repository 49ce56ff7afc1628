/// \file
/// Readings of the paper. Its text, its authors' published scripts and correct mathematics differ
/// in places; each difference is one option of the library, and a reading is a set of options.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "friction/likelihood.hpp"
#include "tmcmc/sampler.hpp"

namespace replication {

/// A complete set of options: sampler, physics, likelihood and prior.
struct Reading {
  /// All options but kind and target of the criterion, set by the samplers compared.
  tmcmc::Options sampler;
  /// Rules of the phase model: Eqs. 18 and 21.
  friction::Physics physics;
  /// Value where the motion is not continuous.
  double infeasible_log_likelihood = 0.0;
  /// Lower prior bound of the natural frequency, Hz, where it differs from Table 2.
  std::optional<double> natural_frequency_lower_hz;
};

/// The available readings.
enum class ReadingName {
  /// The authors' published scripts, with N_eff = N/2 for TMCMC-II: the default of the
  /// reproduction.
  as_published,
  /// The text of the paper, as far as it can be run.
  as_worded,
  /// Correct mathematics.
  corrected
};
constexpr std::array<std::string_view, 3> enumerator_names(std::type_identity<ReadingName>) {
  return {"as_published", "as_worded", "corrected"};
}

/// The options of a reading, as listed in the README.
[[nodiscard]] Reading reading(ReadingName name);

/// The sampling problem of a reading: the likelihood of the observations and the prior.
/// \throws errors::InvalidValue for invalid observations or physics.
[[nodiscard]] tmcmc::Problem problem(const Reading& reading, const friction::Observations& observations,
                                     const tmcmc::BoxPrior& prior);

/// The same physics with the limit and the phase of the corrected reading.
[[nodiscard]] friction::Physics with_exact_rules(friction::Physics physics);

/// The reading with a name.
/// \throws errors::InvalidValue naming the available readings.
[[nodiscard]] ReadingName parse_reading(const std::string& name);

/// One of the samplers that a study compares: a name and complete options.
struct Arm {
  /// Name of the sampler in tables and files.
  std::string name;
  /// Complete, criterion included.
  tmcmc::Options options;
};

/// The paper's two samplers: TMCMC (CoV = cov_target, Eq. 6) and TMCMC-II (N_eff = ess_fraction N,
/// Eq. 9).
[[nodiscard]] std::vector<Arm> paper_arms(const Reading& reading, double cov_target = 1.0,
                                          double ess_fraction = 0.5);

}  // namespace replication
