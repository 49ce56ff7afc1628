#include "tmcmc/detail/budget.hpp"

#include <algorithm>
#include <cmath>

#include "portable_math/elementary.hpp"

namespace tmcmc::detail {

namespace {

/// Growth of beta that is assumed after the first stage, since there is no earlier temperature to
/// compare with.
constexpr double first_growth = 2.0;

/// Number of stages after the one from `beta` to `next`, if log(beta) continues to grow by as much
/// as in this stage.
double stages_after(double beta, double next) {
  const double growth = portable_math::log(beta > 0.0 ? next / beta : first_growth);
  return std::max(std::ceil(-portable_math::log(next) / std::max(growth, 1e-3)), 1.0);
}

Index least_steps(const Options& options, const State& from, double next) {
  const Index chains = chains_of(options);
  const Index left = options.evaluation_budget - from.evaluations;
  if (next == 1.0 && options.evaluation_budget > 0) {
    return left / chains;
  }
  if (!std::holds_alternative<WasteFree>(options.move)) {
    const auto* resample_move = std::get_if<ResampleMove>(&options.move);
    return resample_move != nullptr ? resample_move->steps : 1;
  }
  const Index steps = options.samples / chains - 1;
  if (options.evaluation_budget == 0) {
    return steps;
  }
  const double share = static_cast<double>(left / chains) / (stages_after(from.beta, next) + 1.0);
  return std::clamp(static_cast<Index>(std::min(share, 1e15)), Index{1}, std::max(steps, Index{1}));
}

/// The largest number of steps, no more than the budget holds.
Index most_steps(const Options& options, const State& from, double next, Index least) {
  const auto* resample_move = std::get_if<ResampleMove>(&options.move);
  const bool goes_on = resample_move != nullptr && resample_move->mixing_correlation > 0.0;
  if (!goes_on || (next == 1.0 && options.evaluation_budget > 0)) {
    return least;
  }
  const Index most = std::max(least, resample_move->max_steps);
  return options.evaluation_budget == 0
             ? most
             : std::min(most, (options.evaluation_budget - from.evaluations) / chains_of(options));
}

}  // namespace

Index chains_of(const Options& options) {
  const auto* waste_free = std::get_if<WasteFree>(&options.move);
  return waste_free != nullptr ? waste_free->chains : options.samples;
}

StageSteps steps_of(const Options& options, const State& from, double next) {
  const Index least = least_steps(options, from, next);
  return {least, most_steps(options, from, next, least)};
}

bool fits_budget(const Options& options, const State& from, double next) {
  const Index steps = least_steps(options, from, next);
  return options.evaluation_budget == 0 ||
         (steps >= 1 && steps * chains_of(options) <= options.evaluation_budget - from.evaluations);
}

}  // namespace tmcmc::detail
