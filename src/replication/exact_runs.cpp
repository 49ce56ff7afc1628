#include "replication/exact_runs.hpp"

#include <algorithm>
#include <iterator>

#include "errors/invalid_value.hpp"
#include "statistics/summary.hpp"
#include "tmcmc/random.hpp"
#include "tmcmc/random_stream.hpp"

namespace replication {

Ecdfs exact_runs(const estimation::ExactPosterior& posterior, std::uint64_t seed, std::uint32_t study,
                 long runs, long samples) {
  constexpr std::uint32_t stage = 1;  // 0 is the noise of synthetic observations
  Ecdfs ecdfs;
  for (long run = 0; run < runs; ++run) {
    std::array<std::vector<double>, friction::parameter_count> columns;
    for (long row = 0; row < samples; ++row) {
      const auto words = tmcmc::random_words(
          {.seed = seed, .study = study, .run = static_cast<std::uint32_t>(run)},
          {.purpose = tmcmc::Purpose::data, .stage = stage, .row = static_cast<std::uint64_t>(row)});
      std::array<double, friction::parameter_count> uniforms{};
      std::transform(words.begin(), words.end(), uniforms.begin(), tmcmc::uniform_open);
      const auto point = posterior.draw(uniforms);
      for (std::size_t p = 0; p < point.size(); ++p) {
        columns[p].push_back(point[p]);
      }
    }
    for (std::size_t p = 0; p < columns.size(); ++p) {
      ecdfs[p].emplace_back(std::move(columns[p]));
    }
  }
  return ecdfs;
}

Areas exact_areas(const estimation::ExactPosterior& posterior, std::uint64_t seed, std::uint32_t study,
                  long runs, long samples) {
  const Ecdfs ecdfs = exact_runs(posterior, seed, study, runs, samples);
  Areas areas{};
  std::transform(ecdfs.begin(), ecdfs.end(), areas.begin(),
                 [](const auto& of_parameter) { return pbox::area_metric(of_parameter); });
  return areas;
}

Areas area_quantiles(const std::vector<Areas>& studies, double probability) {
  if (studies.empty()) {
    throw errors::InvalidValue("studies", studies.size(), "at least one");
  }
  Areas quantiles{};
  for (std::size_t p = 0; p < quantiles.size(); ++p) {
    std::vector<double> sorted;
    std::transform(studies.begin(), studies.end(), std::back_inserter(sorted),
                   [p](const Areas& areas) { return areas[p]; });
    std::sort(sorted.begin(), sorted.end());
    quantiles[p] = statistics::sample_quantile(sorted, probability);
  }
  return quantiles;
}

double exact_area(const estimation::TabulatedDensity& exact, std::uint64_t seed, std::uint32_t study,
                  long runs, long samples) {
  std::vector<pbox::Ecdf> ecdfs;
  for (long run = 0; run < runs; ++run) {
    tmcmc::RandomStream stream({.seed = seed, .study = study, .run = static_cast<std::uint32_t>(run)},
                               {.purpose = tmcmc::Purpose::data, .stage = 3});
    std::vector<double> draws(static_cast<std::size_t>(samples));
    for (double& x : draws) {
      x = exact.quantile(stream.uniform());
    }
    ecdfs.emplace_back(std::move(draws));
  }
  return pbox::area_metric(ecdfs);
}

}  // namespace replication
