#include <omp.h>

#include <algorithm>

#include "io/interrupt.hpp"
#include "names/names.hpp"
#include "options.hpp"

namespace experiments {

namespace {

/// Sets the target to the choice, if one was made.
template <class Enum>
void choose(const std::optional<std::string>& name, Enum& target) {
  target = name ? names::value_of<Enum>(*name).value_or(target) : target;
}

}  // namespace

void PhysicsOptions::add_to(CLI::App& app) {
  add_choice(app, "--reading", reading_name, names::all<replication::ReadingName>(),
             "Set of options: how text, published scripts and mathematics are read");
  add_driving_force_to(app);
  add_choice(app, "--limit", limit, names::all<friction::LimitRule>(),
             "S in the limit of continuous motion (Eq. 18)")
      ->group("Reading, option by option");
  add_choice(app, "--phase", phase, names::all<friction::PhaseRule>(),
             "Phase angle (Eq. 21): bin of a transform, or exact")
      ->group("Reading, option by option");
  app.add_option("--infeasible-log-likelihood", infeasible_log_likelihood,
                 "Log-likelihood where the motion is not continuous: a number, or -inf")
      ->transform(number([](double x) { return x < 0.0; }, "a negative number or -inf"))
      ->group("Reading, option by option");
}

void PhysicsOptions::add_driving_force_to(CLI::App& app) {
  app.add_option("--driving-force", driving_force_n, "k Y_b, N")->transform(positive());
}

replication::Reading PhysicsOptions::reading() const {
  replication::Reading r = replication::reading(replication::parse_reading(reading_name));
  choose(limit, r.physics.limit);
  choose(phase, r.physics.phase);
  r.infeasible_log_likelihood = infeasible_log_likelihood.value_or(r.infeasible_log_likelihood);
  r.physics.driving_force_n = driving_force_n;
  return r;
}

void TruthOptions::add_to(CLI::App& app) {
  app.add_option("--friction-force", truth.friction_force_n, "True friction force, N")
      ->transform(non_negative());
  app.add_option("--natural-frequency", truth.natural_frequency_hz, "True frequency, Hz")
      ->transform(positive());
  app.add_option("--phase-noise", truth.phase_noise_deg, "Standard deviation of the phase angle, deg")
      ->transform(non_negative());
  app.add_option("--frequency-ratio-noise", truth.frequency_ratio_noise,
                 "Standard deviation of the frequency ratio")
      ->transform(non_negative());
}

bool TruthOptions::is_given(const CLI::App& app) {
  const auto options = {"--friction-force", "--natural-frequency", "--phase-noise",
                        "--frequency-ratio-noise"};
  return std::any_of(options.begin(), options.end(),
                     [&](const char* option) { return app.get_option(option)->count() > 0; });
}

void TableOptions::add_to(CLI::App& app) {
  draws.interrupt = io::stop_if_interrupted;
  app.add_option("--tables", draws.tables, "Tables of iteration counts that are drawn for each p-value")
      ->transform(count(100));
}

void RunOptions::add_seed_to(CLI::App& app) {
  app.add_option("--seed", seed, "Seed of the random streams")->transform(experiments::seed());
}

void RunOptions::add_to(CLI::App& app, long least_runs) {
  app.add_option("--runs", runs, "Runs of each sampler")->transform(count(least_runs));
  add_seed_to(app);
  add_threads_to(app);
}

void RunOptions::add_threads_to(CLI::App& app) {
  app.add_option("--threads", threads, "Threads; 0: as many as the machine has. Results do not depend on it")
      ->transform(count(0, 4096));
}

replication::StudyOptions RunOptions::study_options() const {
  replication::StudyOptions options;
  options.runs = runs;
  options.seed = seed;
  options.threads = threads == 0 ? omp_get_max_threads() : threads;
  return options;
}

}  // namespace experiments
