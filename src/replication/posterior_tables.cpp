#include "replication/posterior_tables.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "pbox/pbox.hpp"

namespace replication {

namespace {

const estimation::TabulatedDensity& marginal(const estimation::ExactPosterior& posterior, std::size_t p) {
  return posterior.marginal(static_cast<friction::Parameter>(p));
}

/// Range that holds all but 2e-4 of the probability.
estimation::Interval drawn_range(const estimation::TabulatedDensity& exact) {
  return {exact.quantile(1e-4), exact.quantile(1.0 - 1e-4)};
}

}  // namespace

std::vector<ParameterEstimate> parameter_estimates(const estimation::ExactPosterior& posterior,
                                                   const estimation::LaplaceApproximation& laplace,
                                                   const estimation::LeastSquaresFit& fit) {
  const std::array<double, friction::parameter_count> least_squares = {
      fit.friction_force.estimate, fit.natural_frequency.estimate, fit.friction_force.noise_ml,
      fit.natural_frequency.noise_ml};
  std::vector<ParameterEstimate> all;
  for (std::size_t p = 0; p < friction::parameter_count; ++p) {
    const auto& exact = marginal(posterior, p);
    ParameterEstimate of{.mean = exact.mean(),
                         .standard_deviation = exact.standard_deviation(),
                         .quantiles = {},
                         .laplace_mode = laplace.mode[p],
                         .laplace_standard_deviation = laplace.standard_deviation[p],
                         .least_squares = least_squares[p]};
    std::transform(ParameterEstimate::levels.begin(), ParameterEstimate::levels.end(), of.quantiles.begin(),
                   [&](double level) { return exact.quantile(level); });
    all.push_back(of);
  }
  return all;
}

std::vector<QuantityError> errors_of(const GroupedColumns& runs,
                                     const estimation::ExactPosterior& posterior) {
  std::vector<double> exact;
  for (std::size_t p = 0; p < friction::parameter_count; ++p) {
    exact.push_back(marginal(posterior, p).mean());
    exact.push_back(marginal(posterior, p).standard_deviation());
  }
  exact.push_back(posterior.log_evidence());
  std::vector<QuantityError> errors;
  for (std::size_t s = 0; s < runs.samplers.size(); ++s) {
    for (std::size_t q = 0; q < exact.size(); ++q) {
      std::vector<double> estimates;
      for (const auto& run : runs.values[s][q]) {
        estimates.push_back(run.front());
      }
      const auto error = statistics::error_of(estimates, exact[q]);
      const bool is_mean = q % 2 == 0 && q + 1 < exact.size();
      const double sd = is_mean ? exact[q + 1] : std::numeric_limits<double>::quiet_NaN();
      errors.push_back({runs.samplers[s], estimated_quantities()[q], estimates.size(), exact[q], error,
                        sd * sd / (error.spread * error.spread)});
    }
  }
  return errors;
}

std::vector<MarginalPoint> marginal_points(const estimation::ExactPosterior& posterior,
                                           const estimation::LaplaceApproximation& laplace, long points) {
  std::vector<MarginalPoint> all;
  for (std::size_t p = 0; p < friction::parameter_count; ++p) {
    const auto& exact = marginal(posterior, p);
    const auto range = drawn_range(exact);
    for (const double x : statistics::evenly_spaced(range.lower, range.upper, points)) {
      all.push_back({p, x, exact.density(x), exact.cdf(x), laplace.marginal_density(p, x)});
    }
  }
  return all;
}

std::vector<PboxPoint> pbox_points(const GroupedColumns& samples, const estimation::ExactPosterior& posterior,
                                   long points) {
  std::vector<PboxPoint> all;
  for (std::size_t s = 0; s < samples.samplers.size(); ++s) {
    for (std::size_t p = 0; p < friction::parameter_count; ++p) {
      const auto box = pbox::envelope(samples.ecdfs(s, p));
      const auto& exact = marginal(posterior, p);
      const auto range = drawn_range(exact);
      for (const double x : statistics::evenly_spaced(range.lower, range.upper, points)) {
        const auto bounds = pbox::evaluate(box, x);
        all.push_back({samples.samplers[s], p, x, bounds.lower, bounds.upper, exact.cdf(x)});
      }
    }
  }
  return all;
}

std::vector<HistogramBin> sample_histograms(const GroupedColumns& samples,
                                            const estimation::ExactPosterior& posterior, long bins) {
  std::vector<HistogramBin> all;
  for (std::size_t s = 0; s < samples.samplers.size(); ++s) {
    for (std::size_t p = 0; p < friction::parameter_count; ++p) {
      const auto range = drawn_range(marginal(posterior, p));
      const double width = range.width() / static_cast<double>(bins);
      std::vector<double> pooled, weights;
      for (std::size_t run = 0; run < samples.values[s][p].size(); ++run) {
        const auto& of_run = samples.values[s][p][run];
        pooled.insert(pooled.end(), of_run.begin(), of_run.end());
        if (samples.weights.empty()) {
          weights.resize(pooled.size(), 1.0);
        } else {
          weights.insert(weights.end(), samples.weights[s][run].begin(), samples.weights[s][run].end());
        }
      }
      const double mass = std::accumulate(weights.begin(), weights.end(), 0.0) * width;
      const auto counts = statistics::histogram(pooled, weights, range.lower, range.upper, bins);
      for (std::size_t b = 0; b < counts.size(); ++b) {
        const double low = range.lower + width * static_cast<double>(b);
        all.push_back({samples.samplers[s], p, low, low + width, counts[b] / mass});
      }
    }
  }
  return all;
}

}  // namespace replication
