#include "replication/reading.hpp"

#include <limits>

#include "errors/invalid_value.hpp"
#include "names/names.hpp"

namespace replication {

Reading reading(ReadingName name) {
  Reading r;
  r.sampler.diagnose = false;  // the published samplers have none, and studies of many runs need the time
  switch (name) {
    case ReadingName::as_published:
      r.sampler.criterion.deviation = tmcmc::Deviation::sample;
      r.sampler.criterion.counted = tmcmc::Counted::all;
      r.sampler.proposal = tmcmc::RedrawnWalk{};
      r.physics.limit = friction::LimitRule::grid;
      r.physics.phase = friction::PhaseRule::discrete_bin;
      r.infeasible_log_likelihood = -1e10;
      r.natural_frequency_lower_hz = 0.001;
      break;
    case ReadingName::as_worded:
      r.sampler.criterion.counted = tmcmc::Counted::all;
      r.sampler.move = tmcmc::GrowingChains{};
      r.sampler.centre = tmcmc::Centre::plain_mean;
      r.physics.limit = friction::LimitRule::grid;
      r.physics.phase = friction::PhaseRule::discrete_bin;
      r.infeasible_log_likelihood = -1e10;
      break;
    case ReadingName::corrected:
      r.infeasible_log_likelihood = -std::numeric_limits<double>::infinity();
      break;
  }
  return r;
}

tmcmc::Problem problem(const Reading& reading, const friction::Observations& observations,
                       const tmcmc::BoxPrior& prior) {
  return {friction::Likelihood(observations, reading.physics, reading.infeasible_log_likelihood), prior};
}

friction::Physics with_exact_rules(friction::Physics physics) {
  const auto exact = reading(ReadingName::corrected).physics;
  physics.limit = exact.limit;
  physics.phase = exact.phase;
  return physics;
}

ReadingName parse_reading(const std::string& name) {
  const auto found = names::value_of<ReadingName>(name);
  if (!found) {
    throw errors::InvalidValue("reading", name, names::one_of(names::all<ReadingName>()));
  }
  return *found;
}

std::vector<Arm> paper_arms(const Reading& reading, double cov_target, double ess_fraction) {
  Arm tmcmc{"TMCMC", reading.sampler};
  tmcmc.options.infeasible_level = reading.infeasible_log_likelihood;
  tmcmc.options.criterion.rule = tmcmc::CoefficientOfVariation{cov_target};
  Arm tmcmc_ii{"TMCMC-II", tmcmc.options};
  tmcmc_ii.options.criterion.rule = tmcmc::EffectiveSampleSize{ess_fraction};
  return {tmcmc, tmcmc_ii};
}

}  // namespace replication
