#include <cctype>
#include <stdexcept>

#include "command_line.hpp"

namespace experiments {

namespace {

const std::vector<std::string> deviation_names = {"population", "sample"};
const std::vector<std::string> counted_names = {"all", "feasible"};
const std::vector<std::string> move_names = {"resample-move", "growing-chains", "waste-free"};
const std::vector<std::string> centre_names = {"weighted-mean", "plain-mean"};
const std::vector<std::string> boundary_names = {"reject", "redraw"};
const std::vector<std::string> sampler_names = {"published", "recommended"};
const std::vector<std::string> resampling_names = {"multinomial", "residual", "stratified", "systematic"};
const std::vector<std::string> scale_rule_names = {"fixed", "dimension", "target-acceptance",
                                                   "acceptance-linked"};
const std::vector<std::string> no_yes = {"no", "yes"};
const std::vector<std::string> coordinates_names = {"natural", "unbounded"};

constexpr long recommended_evaluations = 31000;  // those of the published setting

Check fraction() {
  return number([](double x) { return x >= 0.0 && x < 1.0; }, "a number in [0, 1)");
}

template <class T>
void replace(const std::optional<T>& value, auto& target) {
  if (value) {
    target = *value;
  }
}

/// An option that would change nothing is a mistake.
template <class T>
void require_effect(const char* option, const std::optional<T>& value, bool has_effect, const char* with) {
  if (value && !has_effect) {
    throw std::invalid_argument(fmt::format("{}: value '{}': expected only with {}", option, *value, with));
  }
}

/// A message about fields of tmcmc::Options, as one about the options that set them: options.move_steps is --move-steps.
std::string about_options(std::string message) {
  const std::string prefix = "options.";
  for (auto at = message.find(prefix); at != std::string::npos; at = message.find(prefix, at)) {
    message.replace(at, prefix.size(), "--");
    for (at += 2; at < message.size() &&
                  (std::islower(static_cast<unsigned char>(message[at])) != 0 || message[at] == '_');
         ++at) {
      message[at] = message[at] == '_' ? '-' : message[at];
    }
  }
  return message;
}

}  // namespace

void SamplerOptions::add_to(Program& program) {
  const std::string of_reading = "Reading, option by option";
  const std::string group = "Sampler beyond the paper";
  program.add_choice("--deviation", deviation, deviation_names,
                     "Standard deviation in the CoV (Eq. 6): N or N-1");
  program.add_choice("--counted", counted, counted_names, "Samples that the criterion counts");
  program.add_choice("--move", move, move_names, "How a stage moves its samples");
  program.add_choice("--centre", centre, centre_names, "Mean in the proposal covariance (Eq. 5)");
  program.add_choice("--boundary", boundary, boundary_names, "Proposals outside the prior box");
  program.add_number("--move-steps", move_steps, count(),
                     "Metropolis steps a chain and stage (resample-move)", of_reading);
  program.add_number("--proposal-scale", proposal_scale, positive(), "gamma of Eq. 5", of_reading);
  program.add_number("--cov-target", cov_target, positive(), "Criterion of TMCMC (Eq. 6)", of_reading);
  program.add_number("--ess-fraction", ess_fraction,
                     number([](double x) { return x > 0.0 && x <= 1.0; }, "a number in (0, 1]"),
                     "Criterion of TMCMC-II as a fraction of N (Eq. 9)", of_reading);
  program.add_number("--max-stages", max_stages, count(), "Most stages a run may take", of_reading);
  program.add_number("--minimum-step", minimum_step, fraction(), "Smallest step of beta", of_reading);
  program.add_number("--samples", samples, count(2),
                     "N, samples a run (1000; recommended: what the budget gives)");

  program.add_choice("--sampler", sampler, sampler_names,
                     "Sampler of the reading, or the recommended one; both criteria stay", group);
  program.add_choice("--resampling", resampling, resampling_names, "Choice of the starts", group);
  program.add_number("--chains", chains, count(), "M, chains of waste-free", group);
  program.add_number("--mixing-correlation", mixing_correlation, fraction(),
                     "Go on moving until states and starts correlate by this at most (resample-move)", group);
  program.add_number("--max-move-steps", max_move_steps, count(), "Most steps with --mixing-correlation",
                     group);
  program.add_choice("--scale-rule", scale_rule, scale_rule_names, "Scale of the random walks", group);
  program.add_number("--target-acceptance", target_acceptance,
                     number([](double x) { return x > 0.0 && x < 1.0; }, "a number between 0 and 1"),
                     "Of the random walks, with --scale-rule target-acceptance", group);
  program.add_choice("--coordinates", coordinates, coordinates_names,
                     "Of the proposals: parameters or logits", group);
  program.add_choice("--random-subsets", random_subsets, no_yes, "Change random sets of coordinates", group);
  program.add_number("--independent-fraction", independent_fraction,
                     number([](double x) { return x >= 0.0 && x <= 1.0; }, "a number in [0, 1]"),
                     "Share of independent proposals", group);
  program.add_choice("--cross-fit", cross_fit, no_yes, "Fit the proposals of half the chains to the others",
                     group);
  program.add_number("--evaluation-budget", evaluation_budget, count(),
                     fmt::format("Log-likelihoods a run (recommended: {})", recommended_evaluations), group);
  program.add_flag("--diagnose", diagnose, "Error of the log-evidence, effective sample sizes, warnings",
                   group);
}

void SamplerOptions::apply(replication::Reading& reading) const {
  tmcmc::Options& o = reading.sampler;
  try {
    if (sampler == "recommended") {
      o = tmcmc::recommended_options(evaluation_budget.value_or(recommended_evaluations));
    }
    o.diagnose = diagnose;
    choose(deviation, deviation_names, o.criterion.deviation);
    choose(counted, counted_names, o.criterion.counted);
    choose(resampling, resampling_names, o.resampling);
    choose(move, move_names, o.move);
    choose(centre, centre_names, o.centre);
    choose(boundary, boundary_names, o.boundary);
    choose(scale_rule, scale_rule_names, o.scale_rule);
    choose(coordinates, coordinates_names, o.coordinates);
    choose(random_subsets, no_yes, o.random_subsets);
    choose(cross_fit, no_yes, o.cross_fit);
    replace(samples, o.samples);
    replace(chains, o.chains);
    replace(move_steps, o.move_steps);
    replace(mixing_correlation, o.mixing_correlation);
    replace(max_move_steps, o.max_move_steps);
    replace(proposal_scale, o.proposal_scale);
    replace(target_acceptance, o.target_acceptance);
    replace(independent_fraction, o.independent_fraction);
    replace(evaluation_budget, o.evaluation_budget);
    replace(max_stages, o.max_stages);
    replace(minimum_step, o.minimum_step);
    o.validate();
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(about_options(error.what()));
  }
  require_effect("--chains", chains, o.move == tmcmc::MoveKind::waste_free, "--move waste-free");
  require_effect("--max-move-steps", max_move_steps, o.mixing_correlation > 0.0, "--mixing-correlation");
  require_effect("--target-acceptance", target_acceptance,
                 o.scale_rule == tmcmc::ScaleRule::target_acceptance, "--scale-rule target-acceptance");
  require_effect("--proposal-scale", proposal_scale, o.scale_rule == tmcmc::ScaleRule::fixed,
                 "--scale-rule fixed");
}

}  // namespace experiments
