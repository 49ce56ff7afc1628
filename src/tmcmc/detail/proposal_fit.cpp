#include "tmcmc/detail/proposal_fit.hpp"

#include <vector>

#include "tmcmc/detail/proposal_covariance.hpp"
#include "tmcmc/unbounded_coordinates.hpp"

namespace tmcmc::detail {

namespace {

constexpr double optimal_scale = 2.38;  // times 1 / sqrt(d): Roberts, Gelman and Gilks (1997)

bool divides_by_sqrt_size(const ScaleRule& rule) {
  return std::holds_alternative<DimensionScale>(rule) || std::holds_alternative<TargetAcceptance>(rule);
}

/// The kernel as given by the options, without its scale.
MetropolisKernel unfitted_kernel(const Options& options) {
  MetropolisKernel kernel;
  if (const auto* redrawn = std::get_if<RedrawnWalk>(&options.proposal)) {
    kernel.boundary = Boundary::redraw;
    kernel.max_redraws = redrawn->max_redraws;
  } else {
    const auto& proposal = std::get<MetropolisProposal>(options.proposal);
    kernel.independent_fraction = proposal.independent_fraction;
    kernel.random_subsets = proposal.random_subsets;
    kernel.coordinates = proposal.coordinates;
  }
  kernel.divide_by_sqrt_size = divides_by_sqrt_size(options.scale_rule);
  return kernel;
}

MetropolisKernel kernel_of(const Prior& prior, const Options& options, const State& from,
                           ConstDoubles weights, double weight_sum) {
  MetropolisKernel kernel = unfitted_kernel(options);
  const auto* fixed = std::get_if<FixedScale>(&options.scale_rule);
  const double in_factor =
      fixed != nullptr ? fixed->scale : 1.0;  // the factor of the covariance holds the fixed scale
  Population unbounded;
  const bool natural = kernel.coordinates == Coordinates::natural;
  if (!natural) {
    unbounded = to_unbounded(from.points, prior);
  }
  const Population& points = natural ? from.points : unbounded;
  kernel.factor = cholesky_factor(
      proposal_covariance(points, weights, weight_sum, in_factor, options.centre, options.threads));
  kernel.factor_unit = 1.0 / in_factor;
  if (kernel.independent_fraction > 0.0) {
    kernel.centre = weighted_mean(points, weights, weight_sum, options.threads);
  }
  const double first_scale = kernel.divide_by_sqrt_size ? optimal_scale : 1.0;
  kernel.scale = fixed != nullptr || from.proposal_scale == 0.0 ? first_scale : from.proposal_scale;
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
