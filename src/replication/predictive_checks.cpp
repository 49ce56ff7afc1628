#include "replication/predictive_checks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "friction/angle.hpp"
#include "tmcmc/parallel.hpp"
#include "tmcmc/random_stream.hpp"

namespace replication {

namespace {

friction::Observations without(friction::Observations o, std::size_t row) {
  for (auto* column : {&o.nominal_ratio, &o.measured_ratio, &o.driving_frequency_hz, &o.phase_deg}) {
    column->erase(column->begin() + static_cast<std::ptrdiff_t>(row));
  }
  return o;
}

}  // namespace

std::vector<estimation::PredictiveDraw> predictive_draws(const estimation::ExactPosterior& posterior,
                                                         const PredictiveDrawing& drawing,
                                                         std::uint32_t stream) {
  std::vector<estimation::PredictiveDraw> draws(static_cast<std::size_t>(drawing.draws));
  const auto draw_block = [&](tmcmc::Index, tmcmc::Index begin, tmcmc::Index end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
      tmcmc::RandomStream random({.seed = drawing.seed},
                                 {.purpose = tmcmc::Purpose::statistics, .stage = stream, .row = i});
      std::array<double, friction::parameter_count> uniforms{};
      std::generate(uniforms.begin(), uniforms.end(), [&] { return random.uniform(); });
      draws[i] = {posterior.draw(uniforms), random.normal(), random.normal()};
    }
  };
  tmcmc::for_each_block(drawing.draws, 100, drawing.threads, draw_block);
  if (drawing.observer) {
    drawing.observer();
  }
  return draws;
}

estimation::Interval curve_range(const std::vector<double>& measured) {
  const auto [low, high] = std::minmax_element(measured.begin(), measured.end());
  const double margin = 0.1 * (*high > *low ? *high - *low : *high);
  return {std::max(*low - margin, 0.5 * *low), *high + margin};
}

std::vector<CutOff> cut_offs(const estimation::ExactPosterior& posterior) {
  std::vector<CutOff> found;
  for (std::size_t p = 0; p < friction::parameter_count; ++p) {
    const auto parameter = static_cast<friction::Parameter>(p);
    const auto& marginal = posterior.marginal(parameter);
    double largest = 0.0;
    for (const double x : marginal.nodes()) {
      largest = std::max(largest, marginal.density(x));
    }
    for (const double bound : {marginal.lower(), marginal.upper()}) {
      if (marginal.density(bound) > 0.1 * largest) {
        found.push_back({parameter, bound});
      }
    }
  }
  return found;
}

std::vector<RowPrediction> predict_rows(const friction::Observations& measured,
                                        const std::vector<estimation::PredictiveDraw>& draws,
                                        const PosteriorOf& posterior_of, const friction::Physics& physics,
                                        const PredictiveDrawing& drawing) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<RowPrediction> rows;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    const double r = measured.measured_ratio[i];
    const double phase = measured.phase_deg[i];
    const double frequency = measured.driving_frequency_hz[i];
    const double nominal = measured.nominal_ratio[i];
    const auto phases = estimation::phase_band(draws, r, physics);
    RowPrediction row{{phases.median + friction::angle_residual_deg(phase, phases.median), phases,
                       estimation::phase_probability(draws, r, phase, physics), nan},
                      {nominal, estimation::ratio_band(draws, frequency),
                       estimation::ratio_probability(draws, frequency, nominal), nan}};
    if (measured.size() > 1) {
      const auto others =
          predictive_draws(posterior_of(without(measured, i)), drawing, static_cast<std::uint32_t>(i + 1));
      row.phase.left_out = estimation::phase_probability(others, r, phase, physics);
      row.ratio.left_out = estimation::ratio_probability(others, frequency, nominal);
    }
    rows.push_back(row);
  }
  return rows;
}

Coverage coverage_95(const std::vector<double>& probabilities) {
  Coverage coverage{0, 0, 0.0};
  for (const double p : probabilities) {
    coverage.measurements += std::isnan(p) ? 0 : 1;
    coverage.inside += p >= 0.025 && p <= 0.975 ? 1 : 0;
  }
  const auto n = static_cast<double>(coverage.measurements);
  for (long k = 0; k <= coverage.inside; ++k) {
    const auto x = static_cast<double>(k);
    coverage.probability += std::exp(std::lgamma(n + 1.0) - std::lgamma(x + 1.0) - std::lgamma(n - x + 1.0) +
                                     x * std::log(0.95) + (n - x) * std::log(0.05));
  }
  coverage.probability = std::min(coverage.probability, 1.0);
  return coverage;
}

}  // namespace replication
