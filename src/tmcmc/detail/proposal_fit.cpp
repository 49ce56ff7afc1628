#include "tmcmc/detail/proposal_fit.hpp"

#include <vector>

#include "tmcmc/detail/proposal_covariance.hpp"
#include "tmcmc/unbounded_coordinates.hpp"

namespace tmcmc::detail {

namespace {

constexpr double optimal_scale = 2.38;  // times 1 / sqrt(d): Roberts, Gelman and Gilks (1997)

double initial_scale(const Options& options) {
  switch (options.scale_rule) {
    case ScaleRule::dimension:
    case ScaleRule::target_acceptance:
      return optimal_scale;
    case ScaleRule::fixed:  // the factor of the covariance holds the scale
    case ScaleRule::acceptance_linked:
      break;
  }
  return 1.0;
}

MetropolisKernel kernel_of(const Prior& prior, const Options& options, const State& from,
                           ConstDoubles weights, double weight_sum) {
  MetropolisKernel kernel;
  const bool fixed = options.scale_rule == ScaleRule::fixed;
  const double in_factor = fixed ? options.proposal_scale : 1.0;
  Population unbounded;
  const bool natural = options.coordinates == Coordinates::natural;
  if (!natural) {
    unbounded = to_unbounded(from.points, prior);
  }
  const Population& points = natural ? from.points : unbounded;
  kernel.factor = cholesky_factor(
      proposal_covariance(points, weights, weight_sum, in_factor, options.centre, options.threads));
  kernel.factor_unit = 1.0 / in_factor;
  if (options.independent_fraction > 0.0) {
    kernel.centre = weighted_mean(points, weights, weight_sum, options.threads);
  }
  kernel.scale = fixed || from.proposal_scale == 0.0 ? initial_scale(options) : from.proposal_scale;
  kernel.divide_by_sqrt_size =
      options.scale_rule == ScaleRule::dimension || options.scale_rule == ScaleRule::target_acceptance;
  kernel.independent_fraction = options.independent_fraction;
  kernel.random_subsets = options.random_subsets;
  kernel.coordinates = options.coordinates;
  kernel.boundary = options.boundary;
  kernel.max_redraws = options.max_redraws;
  kernel.stage = static_cast<std::uint32_t>(from.stage + 1);
  return kernel;
}

}  // namespace

StageKernels stage_kernels(const Prior& prior, const Options& options, const State& from,
                           ConstDoubles weights, double weight_sum, std::span<const Index> ancestors) {
  StageKernels stage;
  if (options.cross_fit) {
    const Index chains = from.genealogy.chains;
    std::vector<double> half(weights.size());
    for (Index parity = 0; parity < 2; ++parity) {
      double sum = 0.0;
      double squares = 0.0;
      for (std::size_t i = 0; i < weights.size(); ++i) {
        half[i] = static_cast<Index>(i) % chains % 2 == parity ? 0.0 : weights[i];
        sum += half[i];
        squares += half[i] * half[i];
      }
      if (sum * sum <= 4.0 * static_cast<double>(prior.dimension()) * squares) {
        stage = {};
        break;
      }
      stage.kernels.push_back(kernel_of(prior, options, from, half, sum));
      auto& rows = stage.rows.emplace_back();
      for (std::size_t c = 0; c < ancestors.size(); ++c) {
        if (ancestors[c] % chains % 2 == parity) {
          rows.push_back(static_cast<Index>(c));
        }
      }
    }
  }
  if (stage.kernels.empty()) {
    stage.kernels.push_back(kernel_of(prior, options, from, weights, weight_sum));
  }
  return stage;
}

}  // namespace tmcmc::detail
