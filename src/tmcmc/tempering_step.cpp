#include "tmcmc/tempering_step.hpp"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <limits>

#include "portable_math/elementary.hpp"

namespace tmcmc {

namespace {

constexpr double log_step_tolerance = 1e-13;
constexpr double smallest_step = 1e-300;

/// Distance of the step beyond the criterion, on a scale that is nearly linear in log(step):
/// log(CoV / target), also expressed through N_eff. Increasing in the step.
class Excess {
 public:
  Excess(const WeightStatistics& statistics, const Criterion& criterion, Index counted)
      : statistics_(statistics), criterion_(criterion), counted_(static_cast<double>(counted)) {}

  double operator()(double step) {
    ++evaluations_;
    if (const auto* rule = std::get_if<CoefficientOfVariation>(&criterion_.rule)) {
      return portable_math::log(
          statistics_.coefficient_of_variation(step, criterion_.deviation, criterion_.counted) /
          rule->target);
    }
    return of_effective_size(statistics_.effective_sample_size(step));
  }

  /// The limit of small steps: the feasible samples have equal weights.
  [[nodiscard]] double of_feasible(Index feasible) const {
    if (const auto* rule = std::get_if<CoefficientOfVariation>(&criterion_.rule)) {
      const double n = criterion_.deviation == Deviation::sample ? counted_ - 1.0 : counted_;
      return portable_math::log(std::sqrt(counted_ / n * (counted_ / static_cast<double>(feasible) - 1.0)) /
                                rule->target);
    }
    return of_effective_size(static_cast<double>(feasible));
  }

  /// Whether the criterion is N_eff = N, which no step but 0 meets.
  [[nodiscard]] bool wants_equal_weights() const {
    const auto* rule = std::get_if<EffectiveSampleSize>(&criterion_.rule);
    return rule != nullptr && rule->fraction == 1.0;
  }

  [[nodiscard]] int evaluations() const { return evaluations_; }

 private:
  [[nodiscard]] double of_effective_size(double size) const {
    const double fraction = std::get<EffectiveSampleSize>(criterion_.rule).fraction;
    return 0.5 * portable_math::log(std::max(counted_ / size - 1.0, 0.0) / (1.0 / fraction - 1.0));
  }

  const WeightStatistics& statistics_;
  Criterion criterion_;
  double counted_;
  int evaluations_ = 0;
};

}  // namespace

Criterion coefficient_of_variation_rule(double target) {
  return {.rule = CoefficientOfVariation{target}};
}

Criterion effective_sample_size_rule(double fraction) {
  return {.rule = EffectiveSampleSize{fraction}};
}

TemperingStep choose_step(ConstDoubles log_likelihood, double remaining, const Criterion& criterion,
                          int threads) {
  const WeightStatistics statistics(log_likelihood, threads);
  const Index feasible = statistics.feasible();
  const Index counted =
      criterion.counted == Counted::all ? static_cast<Index>(log_likelihood.size()) : feasible;
  TemperingStep result;
  if (feasible == 0) {
    result.status = TemperingStatus::infeasible;
    return result;
  }
  Excess excess(statistics, criterion, counted);
  const auto finish = [&](double step, TemperingStatus status) {
    result.step = step;
    result.status = status;
    result.effective_sample_size = statistics.effective_sample_size(step);
    result.coefficient_of_variation =
        statistics.coefficient_of_variation(step, criterion.deviation, criterion.counted);
    result.evaluations = excess.evaluations() + 2;
    return result;
  };
  const double excess_remaining = excess(remaining);
  if (!(excess_remaining >
        0.0)) {  // a NaN: one sample with the N-1 deviation, or 0/0 in N_eff = N with equal weights
    return finish(remaining, TemperingStatus::final_step);
  }
  if (excess.wants_equal_weights()) {
    result.status = TemperingStatus::zero_step;
    result.evaluations = excess.evaluations();
    return result;
  }

  const double sd = statistics.log_likelihood_spread();
  double high = remaining;
  double excess_high = excess_remaining;
  double low = std::min(0.5 * remaining, sd > 0.0 ? 0.9 / sd : remaining);
  low = std::max(low, smallest_step);
  double excess_low = excess(low);
  while (excess_low < 0.0 && 4.0 * low < high) {  // a few steps up keep the bracket short
    const double next = 4.0 * low;
    const double excess_next = excess(next);
    if (excess_next >= 0.0) {
      high = next;
      excess_high = excess_next;
      break;
    }
    low = next;
    excess_low = excess_next;
  }
  for (double factor = 0.25; excess_low > 0.0; factor *= factor) {
    high = low;
    excess_high = excess_low;
    low = std::max(low * std::max(factor, 1e-6), smallest_step);
    excess_low = excess(low);
    if (low <= smallest_step && excess_low > 0.0) {
      result.status =
          excess.of_feasible(feasible) < 0.0 ? TemperingStatus::zero_step : TemperingStatus::unreachable;
      result.evaluations = excess.evaluations();
      return result;
    }
  }

  if (std::isinf(excess_low)) {  // CoV has underflowed to 0: any finite value of that sign will do
    excess_low = -40.0;
  }
  std::uintmax_t iterations = 200;
  const auto root = boost::math::tools::toms748_solve(
      [&](double log_step) { return std::max(excess(portable_math::exp(log_step)), -40.0); },
      portable_math::log(low), portable_math::log(high), excess_low, excess_high,
      [](double a, double b) {
        return std::fabs(b - a) <=
               std::max(log_step_tolerance, 8.0 * std::numeric_limits<double>::epsilon() * std::fabs(a));
      },
      iterations);
  if (std::fabs(root.second - root.first) > 1e-9) {
    throw SamplingError("the tempering step was not found to 1e-9 within 200 evaluations");
  }
  result.bracket_low = portable_math::exp(root.first);
  result.bracket_high = portable_math::exp(root.second);
  return finish(std::min(remaining, 0.5 * (result.bracket_low + result.bracket_high)),
                TemperingStatus::solved);
}

}  // namespace tmcmc
