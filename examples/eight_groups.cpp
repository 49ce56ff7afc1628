// A hierarchical model: eight groups whose effects have a normal distribution of unknown centre,
// and of known spread, beside its closed form (eight_groups.hpp). The hierarchy is written as a
// prior of one's own: a log-density, a draw, names and units.

#include "eight_groups.hpp"

#include <cstdio>

#include "tmcmc/options.hpp"

int main() {
  constexpr double tau = 8.0;

  // 1. The problem: a prior of nine parameters and the likelihood of the measurements.
  const tmcmc::Problem problem{eight_groups::log_likelihood, eight_groups::prior(tau)};

  // 2. The recommended sampler: weighted independent draws.
  const tmcmc::Result result = tmcmc::run(problem, tmcmc::recommended_options(60000), {.seed = 1});
  const auto n = static_cast<double>(result.weights.size());  // the weights have a mean of 1

  // 3. Samples beside the closed form.
  const eight_groups::Exact exact = eight_groups::exact(tau);
  const auto& names = problem.prior.names();
  std::printf("%-10s %10s %10s %10s %10s\n", "", "mean", "sd", "exact", "exact sd");
  for (Eigen::Index j = 0; j < problem.prior.dimension(); ++j) {
    const auto column = result.final.points.col(j).array();
    const double mean = (result.weights.array() * column).sum() / n;
    const double sd = std::sqrt((result.weights.array() * (column - mean).square()).sum() / n);
    const auto k = static_cast<std::size_t>(j);
    std::printf("%-10s %10.2f %10.2f %10.2f %10.2f\n", names[k].c_str(), mean, sd,
                j == 0 ? exact.mu_mean : exact.theta_mean[k - 1],
                j == 0 ? exact.mu_sd : exact.theta_sd[k - 1]);
  }
  std::printf("log-evidence %.3f +- %.3f, exact %.3f\n", result.evidence.log_evidence,
              result.evidence.standard_error, exact.log_evidence);
  for (const tmcmc::Warning& warning : result.diagnostics.warnings) {
    std::printf("warning: %s\n", warning.message.c_str());
  }
}
