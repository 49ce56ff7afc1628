#include "replication/noise_priors.hpp"

#include "friction/likelihood.hpp"
#include "replication/columns.hpp"

namespace replication {

std::vector<NoisePrior> noise_priors(const tmcmc::Prior& box) {
  std::vector<NoisePrior> priors;
  for (const char* noise : {"uniform", "log_uniform", "half_normal"}) {
    std::vector<tmcmc::Parameter> parameters;
    for (std::size_t p = 0; p < parameter_columns.size(); ++p) {
      const double low = box.lower()[static_cast<Eigen::Index>(p)];
      const double high = box.upper()[static_cast<Eigen::Index>(p)];
      const bool is_noise = p == friction::phase_noise || p == friction::frequency_ratio_noise;
      auto marginal = tmcmc::Marginal::uniform(low, high);
      if (is_noise && noise == std::string("log_uniform")) {
        marginal = tmcmc::Marginal::log_uniform(low, high);
      } else if (is_noise && noise == std::string("half_normal")) {
        marginal = tmcmc::Marginal::half_normal(0.5 * high);
      }
      parameters.push_back({parameter_columns[p], "", marginal});
    }
    priors.push_back({noise, tmcmc::Prior(parameters)});
  }
  return priors;
}

}  // namespace replication
