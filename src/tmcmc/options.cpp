#include "tmcmc/options.hpp"

#include <cmath>
#include <sstream>

namespace tmcmc {

namespace {

template <class T>
void require(bool condition, const char* field, T value, const char* expected) {
  if (!condition) {
    std::ostringstream message;
    message << std::boolalpha << "options." << field << " = " << value << ": expected " << expected;
    throw std::invalid_argument(message.str());
  }
}

}  // namespace

void Options::validate() const {
  criterion.validate();
  require(samples >= 2, "samples", samples, "at least 2");
  require(move_steps >= 1, "move_steps", move_steps, "at least 1");
  require(mixing_correlation >= 0.0 && mixing_correlation < 1.0, "mixing_correlation", mixing_correlation,
          "a number in [0, 1)");
  require(max_move_steps >= 1, "max_move_steps", max_move_steps, "at least 1");
  if (mixing_correlation > 0.0) {
    require(move == MoveKind::resample_move, "mixing_correlation", mixing_correlation,
            "0 unless move is resample_move");
    require(max_move_steps >= move_steps, "max_move_steps", max_move_steps, "at least options.move_steps");
  }
  if (move == MoveKind::waste_free) {
    require(chains >= 1 && chains < samples && samples % chains == 0, "chains", chains,
            "a divisor of the number of samples, less than it");
  }
  require(proposal_scale > 0.0 && std::isfinite(proposal_scale), "proposal_scale", proposal_scale,
          "a positive number");
  require(target_acceptance > 0.0 && target_acceptance < 1.0, "target_acceptance", target_acceptance,
          "a number between 0 and 1");
  require(scale_rule != ScaleRule::target_acceptance || move != MoveKind::growing_chains, "scale_rule",
          "target_acceptance", "another rule with growing chains");
  require(independent_fraction >= 0.0 && independent_fraction <= 1.0, "independent_fraction",
          independent_fraction, "a number in [0, 1]");
  require(!cross_fit || move != MoveKind::growing_chains, "cross_fit", cross_fit,
          "false with growing chains");
  if (boundary == Boundary::redraw) {
    require(coordinates == Coordinates::natural && !random_subsets && independent_fraction == 0.0, "boundary",
            "redraw", "reject, since only random walks in all natural coordinates can be redrawn");
  }
  require(max_redraws >= 1, "max_redraws", max_redraws, "at least 1");
  require(max_stages >= 1, "max_stages", max_stages, "at least 1");
  require(minimum_step >= 0.0 && minimum_step < 1.0, "minimum_step", minimum_step, "a number in [0, 1)");
  require(!std::isnan(infeasible_level), "infeasible_level", infeasible_level, "a number or minus infinity");
  require(evaluation_budget >= 0, "evaluation_budget", evaluation_budget,
          "a number of evaluations, or 0 for no limit");
  if (evaluation_budget > 0) {
    require(evaluation_budget > samples, "evaluation_budget", evaluation_budget, "more than options.samples");
    require(move != MoveKind::growing_chains, "evaluation_budget", evaluation_budget,
            "0 with growing chains");
  }
  require(threads >= 1, "threads", threads, "at least 1");
  require(batch_rows >= 0, "batch_rows", batch_rows, "a number of rows, or 0 for no limit");
}

Options recommended_options(Index evaluations, Index chains) {
  require(chains >= 1, "chains", chains, "at least 1");
  require(evaluations >= 500 && evaluations / 26 >= chains, "evaluation_budget", evaluations,
          "at least 500 and 26 a chain for the recommended options");
  Options options;
  options.samples = evaluations / (13 * chains) * chains;
  options.criterion = effective_sample_size_rule(0.5);
  options.resampling = Resampling::systematic;
  options.move = MoveKind::waste_free;
  options.chains = chains;
  options.scale_rule = ScaleRule::dimension;
  options.coordinates = Coordinates::unbounded;
  options.random_subsets = true;
  options.independent_fraction = 0.5;
  options.evaluation_budget = evaluations;
  return options;
}

}  // namespace tmcmc
