#include "storage/settings.hpp"

#include <fmt/format.h>

#include <array>
#include <concepts>
#include <stdexcept>

#include "io/csv.hpp"

namespace storage {

namespace {

std::string text(bool value) {
  return value ? "yes" : "no";
}

template <std::integral Integer>
std::string text(Integer value) {
  return std::to_string(value);
}

std::string text(double value) {
  return io::format_number(value);
}

std::string text(const Eigen::VectorXd& values) {
  std::string all;
  for (const double value : values) {
    all += all.empty() ? "" : " ";
    all += io::format_number(value);
  }
  return all;
}

/// The names of an enum stand in the order of its values.
template <class Enum, std::size_t n>
std::string text(Enum value, const std::array<const char*, n>& names) {
  return names.at(static_cast<std::size_t>(value));
}

constexpr std::array kinds = {"coefficient_of_variation", "effective_sample_size"};
constexpr std::array deviations = {"population", "sample"};
constexpr std::array counts = {"all", "feasible"};
constexpr std::array resamplings = {"multinomial", "residual", "stratified", "systematic"};
constexpr std::array moves = {"resample_move", "growing_chains", "waste_free"};
constexpr std::array scale_rules = {"fixed", "dimension", "target_acceptance", "acceptance_linked"};
constexpr std::array centres = {"weighted_mean", "plain_mean"};
constexpr std::array coordinate_names = {"natural", "unbounded"};
constexpr std::array boundaries = {"reject", "redraw"};

}  // namespace

Settings settings(const tmcmc::Options& options) {
  // Every field by name: one that is added to the options does not compile until it is listed here.
  const auto& [samples, criterion, resampling, move, move_steps, mixing_correlation, max_move_steps, chains,
               scale_rule, proposal_scale, target_acceptance, centre, coordinates, random_subsets,
               independent_fraction, cross_fit, boundary, max_redraws, infeasible_level, max_stages,
               minimum_step, evaluation_budget, diagnose, threads, batch_rows] = options;
  const auto& [kind, target, deviation, counted] = criterion;
  static_cast<void>(max_stages);
  static_cast<void>(threads);
  static_cast<void>(batch_rows);
  return {{"samples", text(samples)},
          {"criterion.kind", text(kind, kinds)},
          {"criterion.target", text(target)},
          {"criterion.deviation", text(deviation, deviations)},
          {"criterion.counted", text(counted, counts)},
          {"resampling", text(resampling, resamplings)},
          {"move", text(move, moves)},
          {"move_steps", text(move_steps)},
          {"mixing_correlation", text(mixing_correlation)},
          {"max_move_steps", text(max_move_steps)},
          {"chains", text(chains)},
          {"scale_rule", text(scale_rule, scale_rules)},
          {"proposal_scale", text(proposal_scale)},
          {"target_acceptance", text(target_acceptance)},
          {"centre", text(centre, centres)},
          {"coordinates", text(coordinates, coordinate_names)},
          {"random_subsets", text(random_subsets)},
          {"independent_fraction", text(independent_fraction)},
          {"cross_fit", text(cross_fit)},
          {"boundary", text(boundary, boundaries)},
          {"max_redraws", text(max_redraws)},
          {"infeasible_level", text(infeasible_level)},
          {"minimum_step", text(minimum_step)},
          {"evaluation_budget", text(evaluation_budget)},
          {"diagnose", text(diagnose)}};
}

Settings settings(const RunDescription& run) {
  if (run.model.find_first_of("\n\r") != std::string::npos) {
    throw std::invalid_argument(
        fmt::format("description of the model '{}': expected one line", io::printable(run.model)));
  }
  Settings all = settings(run.options);
  const auto& [seed, study, arm, index] = run.key;
  all.emplace_back("seed", text(seed));
  all.emplace_back("study", text(study));
  all.emplace_back("arm", text(arm));
  all.emplace_back("run", text(index));
  all.emplace_back("prior.lower", text(run.prior.lower()));
  all.emplace_back("prior.upper", text(run.prior.upper()));
  if (!run.prior.is_box()) {
    all.emplace_back("prior", run.prior.text());
  }
  all.emplace_back("model", run.model);
  return all;
}

}  // namespace storage
