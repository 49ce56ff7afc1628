#include "command_line/corner_tables.hpp"

#include "statistics/corner.hpp"
#include "statistics/summary.hpp"

namespace command_line {

CornerTables::CornerTables(const std::string& joint_path, const std::string& marginals_path,
                           const std::string& summary_path)
    : joint(open_csv(joint_path, {"x_parameter", "y_parameter", "x", "y", "density", "level"})),
      marginals(open_csv(marginals_path, {"parameter", "low", "high", "density"})),
      summary(open_csv(summary_path, {"parameter", "mean", "sd", "q025", "q25", "q50", "q75", "q975", "low",
                                      "high", "tick"})) {}

void CornerTables::write(const CornerSamples& samples, long bins, const Report* report) {
  const auto& [names, columns, weights] = samples;
  std::vector<statistics::Range> ranges;
  if (report != nullptr) {
    (*report)("{:<24} {:>12} {:>12} {:>12} {:>12} {:>12}\n", "", "mean", "sd", "2.5 %", "median", "97.5 %");
  }
  for (std::size_t p = 0; p < names.size(); ++p) {
    ranges.push_back(statistics::panel_range(columns[p], weights));
    const auto [mean, sd] =
        weights.empty() ? statistics::moments(columns[p]) : statistics::moments(columns[p], weights);
    std::vector<double> quantiles;
    for (const double level : {0.025, 0.25, 0.5, 0.75, 0.975}) {
      quantiles.push_back(statistics::weighted_quantile(columns[p], weights, level));
    }
    if (report != nullptr) {
      (*report)("{:<24} {:>12.5g} {:>12.3g} {:>12.5g} {:>12.5g} {:>12.5g}\n", names[p], mean, sd,
                quantiles[0], quantiles[2], quantiles[4]);
    }
    summary.row(names[p], mean, sd, quantiles, ranges[p].low, ranges[p].high,
                statistics::tick_spacing(ranges[p]));
  }
  const auto edge = [&](std::size_t p, double bin) {
    return ranges[p].low + (ranges[p].high - ranges[p].low) * bin / static_cast<double>(bins);
  };
  for (std::size_t x = 0; x < names.size(); ++x) {
    const auto density = statistics::marginal_density(columns[x], weights, ranges[x], bins);
    for (std::size_t b = 0; b < density.size(); ++b) {
      const auto bin = static_cast<double>(b);
      marginals.row(names[x], edge(x, bin), edge(x, bin + 1.0), density[b]);
    }
    for (std::size_t y = x + 1; y < names.size(); ++y) {
      const auto pair = statistics::pair_density(columns[x], columns[y], weights, ranges[x], ranges[y], bins);
      for (std::size_t i = 0; i < pair.level.size(); ++i) {
        const auto across = static_cast<double>(i % static_cast<std::size_t>(bins));
        const auto up = static_cast<double>(i / static_cast<std::size_t>(bins));
        joint.row(names[x], names[y], edge(x, across + 0.5), edge(y, up + 0.5), pair.density[i],
                  pair.level[i]);
      }
    }
  }
}

}  // namespace command_line
