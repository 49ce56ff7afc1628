#include <omp.h>

#include "command_line.hpp"
#include "io/interrupt.hpp"
#include "names/names.hpp"

namespace experiments {

namespace {

/// Sets the target to the choice, if one was made.
template <class Enum>
void choose(const std::optional<std::string>& name, Enum& target) {
  target = name ? names::value_of<Enum>(*name).value_or(target) : target;
}

}  // namespace

void PhysicsOptions::add_to(Program& program) {
  program.add_choice("--reading", reading_name, names::all<replication::ReadingName>(),
                     "Set of options: how text, published scripts and mathematics are read");
  add_driving_force_to(program);
  program.add_choice("--limit", limit, names::all<friction::LimitRule>(),
                     "S in the limit of continuous motion (Eq. 18)");
  program.add_choice("--phase", phase, names::all<friction::PhaseRule>(),
                     "Phase angle (Eq. 21): bin of a transform, or exact");
  program.add_number("--infeasible-log-likelihood", infeasible_log_likelihood,
                     number([](double x) { return x < 0.0; }, "a negative number or -inf"),
                     "Log-likelihood where the motion is not continuous: a number, or -inf",
                     "Reading, option by option");
}

void PhysicsOptions::add_driving_force_to(Program& program) {
  program.add_number("--driving-force", driving_force_n, positive(), "k Y_b, N");
}

replication::Reading PhysicsOptions::reading() const {
  replication::Reading r = replication::reading(replication::parse_reading(reading_name));
  choose(limit, r.physics.limit);
  choose(phase, r.physics.phase);
  r.infeasible_log_likelihood = infeasible_log_likelihood.value_or(r.infeasible_log_likelihood);
  r.physics.driving_force_n = driving_force_n;
  return r;
}

void TableOptions::add_to(Program& program) {
  draws.interrupt = io::stop_if_interrupted;
  program.add_number("--tables", draws.tables, count(100),
                     "Tables of iteration counts that are drawn for each p-value");
}

void RunOptions::add_seed_to(Program& program) {
  program.add_number("--seed", seed, experiments::seed(), "Seed of the random streams");
}

void RunOptions::add_to(Program& program, long least_runs) {
  program.add_number("--runs", runs, count(least_runs), "Runs of each sampler");
  add_seed_to(program);
  add_threads_to(program);
}

void RunOptions::add_threads_to(Program& program) {
  program.add_number("--threads", threads, count(0, 4096),
                     "Threads; 0: as many as the machine has. Results do not depend on it");
}

replication::StudyOptions RunOptions::study_options() const {
  replication::StudyOptions options;
  options.runs = runs;
  options.seed = seed;
  options.threads = threads == 0 ? omp_get_max_threads() : threads;
  return options;
}

}  // namespace experiments
