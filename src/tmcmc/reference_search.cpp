#include "tmcmc/reference_search.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "tmcmc/detail/infinity.hpp"
#include "tmcmc/detail/separate_modes.hpp"
#include "tmcmc/log_weights.hpp"

namespace tmcmc {

namespace {

Index feasible_draws(const ReferenceDraws& draws) {
  return (draws.log_likelihood.array() > -detail::infinity).count();
}

/// Points whose weights sum to their effective size, without those of less than a hundredth of the mean weight.
WeightedPoints weighted(const ReferenceDraws& draws, const Eigen::VectorXd& log_weight, double effective) {
  constexpr double least_weight = 0.01;
  WeightedPoints data;
  if (!(effective > 0.0)) {
    return data;
  }
  const Eigen::VectorXd weights = normalised_weights(as_span(log_weight));
  double total = 0.0;
  for (Index i = 0; i < weights.size(); ++i) {
    if (weights[i] >= least_weight) {
      data.groups.push_back(i);
      total += weights[i];
    }
  }
  const auto n = static_cast<Index>(data.groups.size());
  data.points.resize(n, draws.z.cols());
  data.weights.resize(n);
  for (Index j = 0; j < draws.z.cols(); ++j) {
    for (Index i = 0; i < n; ++i) {
      data.points(i, j) = draws.z(data.groups[static_cast<std::size_t>(i)], j);
    }
  }
  for (Index i = 0; i < n; ++i) {
    data.weights[i] = weights[data.groups[static_cast<std::size_t>(i)]] * (effective / total);
  }
  return data;
}

/// The largest beta in (0, 1) at which the effective size is `wanted` or up to 3 % more: a bracket from 1 down in decades, and
/// interpolation of the logarithms in it. 0 if there is none.
/// \param at_one  effective size at 1, less than wanted
template <class Function>
double beta_of_size(const Function& effective_at, double wanted, double at_one) {
  constexpr double least_beta = 1e-30;
  constexpr double largest_excess = 1.03;
  constexpr int most_steps = 12;
  double high = 1.0;
  double at_high = at_one;
  double low = 0.1;
  double at_low = effective_at(low);
  while (at_low < wanted) {
    if (low < least_beta) {
      return 0.0;
    }
    high = low;
    at_high = at_low;
    low *= 0.1;
    at_low = effective_at(low);
  }
  using portable_math::log;
  for (int step = 0; step < most_steps && at_low > largest_excess * wanted; ++step) {
    const double aim = std::sqrt(largest_excess) * wanted;
    const double part = at_high > 0.0 ? log(at_low / aim) / log(at_low / at_high) : 0.5;
    const double middle = low * portable_math::exp(std::clamp(part, 0.1, 0.9) * log(high / low));
    const double at_middle = effective_at(middle);
    (at_middle >= wanted ? low : high) = middle;
    (at_middle >= wanted ? at_low : at_high) = at_middle;
  }
  return low;
}

}  // namespace

WeightedPoints fit_points(const ReferenceDraws& draws, double fewest) {
  const Eigen::VectorXd log_weight = log_weights(draws);
  const double target = std::min(fewest, 0.5 * static_cast<double>(feasible_draws(draws)));
  const double power = tempering_power(as_span(log_weight), target);
  return weighted(draws, power * log_weight,
                  power > 0.0 ? effective_sample_size(as_span(log_weight), power) : 0.0);
}

TemperedPoints tempered_points(const ReferenceDraws& draws, double target) {
  constexpr Index fewest_feasible = 10;
  const Eigen::VectorXd log_weight = log_weights(draws);
  const Index feasible = feasible_draws(draws);
  if (feasible < fewest_feasible) {
    return {weighted(draws, log_weight, 0.0)};
  }
  const double wanted = std::min(target, 0.5 * static_cast<double>(feasible));
  // An excluded draw keeps its weight of 0.
  const Eigen::VectorXd log_likelihood =
      (draws.log_likelihood.array() > -detail::infinity).select(draws.log_likelihood, 0.0);
  const auto at_temperature = [&](double beta) -> Eigen::VectorXd {
    return log_weight - (1.0 - beta) * log_likelihood;
  };
  const auto effective_at = [&](double beta) {
    return effective_sample_size(as_span(at_temperature(beta)), 1.0);
  };
  const double at_one = effective_at(1.0);
  const double beta = at_one >= wanted ? 1.0 : beta_of_size(effective_at, wanted, at_one);
  const Eigen::VectorXd tempered = at_temperature(beta);
  const double effective = effective_sample_size(as_span(tempered), 1.0);
  return {weighted(draws, tempered, effective), beta, effective};
}

namespace {

/// Fits the draws so far: the number of components is chosen where they have grown enough and where beta has come to 1.
void fit_round(const TemperedPoints& tempered, const SearchOptions& options, const StreamKey& key,
               std::uint32_t stage, Index& rows_at_choice, Search& search) {
  const double growth =
      options.target < 100.0 ? 1.4 : 2.0;  // few draws lose modes to fits of too few components
  constexpr int iterations_from_last_fit = 3;
  constexpr double tempered_below = 0.3;
  const Index rows = search.draws.z.rows();
  if (search.fit.size() == 0 || (tempered.beta == 1.0 && search.beta() < 1.0) ||
      static_cast<double>(rows) >= growth * static_cast<double>(rows_at_choice)) {
    search.fit = fit_mixture(tempered.points, options.fit, key, stage);
    rows_at_choice = rows;
  } else {
    MixtureFitOptions fit = options.fit;
    fit.most_iterations = iterations_from_last_fit;
    search.fit = improve_mixture(tempered.points, std::move(search.fit), fit);
  }
  search.most_modes = std::max(search.most_modes, detail::separate_modes(search.fit));
  if (tempered.beta < tempered_below) {
    search.tempered = search.fit;
  }
}

/// One search from the prior.
Search search_once(const Problem& problem, const SearchOptions& options, const StreamKey& key,
                   std::uint32_t stage) {
  constexpr double growth_at_posterior = 0.5;  // of the effective draws
  constexpr double early = 4.0;                // times the target: few draws for an easy problem
  Search search;
  search.target = options.target;
  const auto draw = [&](const ReferenceDensity& reference, Index n) {
    search.draws.append(
        draw_and_evaluate(problem, reference, n, key, stage++, options.threads, options.batch_rows),
        options.threads);
  };
  const ReferenceDensity prior{.prior_share = 1.0};
  draw(prior, std::min(std::max(2 * options.round, options.evaluations / 8), options.evaluations));
  Index rows_at_choice = 0;
  for (;;) {
    TemperedPoints tempered = tempered_points(search.draws, options.target);
    const bool is_fitted = tempered.beta > 0.0;
    if (is_fitted) {
      fit_round(tempered, options, key, stage, rows_at_choice, search);
    }
    const double effective = tempered.effective_sample_size;
    tempered.points = {};
    search.rounds.push_back(std::move(tempered));
    const bool is_early = effective >= early * options.target && options.target < options.most_target &&
                          search.draws.z.rows() < options.evaluations / 3;
    const bool is_enough = search.beta() == 1.0 && (effective >= options.enough || is_early);
    const Index round = search.beta() == 1.0
                            ? std::max(options.round, static_cast<Index>(growth_at_posterior * effective))
                            : options.round;
    const Index left = std::min(round, options.evaluations - search.draws.z.rows());
    if (is_enough || left <= 0) {
      return search;
    }
    draw(is_fitted ? ReferenceDensity{search.fit, options.prior_share} : prior, left);
  }
}

}  // namespace

Search search_posterior(const Problem& problem, SearchOptions options, const StreamKey& key) {
  constexpr std::uint32_t stages = 100000;      // of one search, at most
  constexpr double share_of_the_rest = 0.8;     // that a search with larger populations should need
  constexpr double least_factor = 1.3;          // by which populations grow
  constexpr double enough_of_repeats = 1000.0;  // effective draws
  Search search = search_once(problem, options, key, 0);
  auto used = static_cast<double>(search.draws.z.rows());
  for (std::uint32_t pass = 1; search.beta() == 1.0; ++pass) {
    const Index left = options.evaluations - search.draws.z.rows();
    const double factor =
        std::min(share_of_the_rest * static_cast<double>(left) / used, options.most_target / search.target);
    if (factor < least_factor) {
      break;
    }
    SearchOptions larger = options;
    larger.evaluations = left;
    larger.target = factor * search.target;
    larger.round =
        static_cast<Index>(factor * search.target / options.target * static_cast<double>(options.round));
    larger.enough = std::max(options.enough, std::min(factor * options.enough, enough_of_repeats));
    Search next = search_once(problem, larger, key, pass * stages);
    used = static_cast<double>(next.draws.z.rows());
    next.most_modes = std::max(next.most_modes, search.most_modes);
    search.draws.append(next.draws, options.threads);
    next.draws = std::move(search.draws);
    search = std::move(next);
  }
  if (search.beta() == 0.0 && feasible_draws(search.draws) == 0) {
    throw InfeasiblePriorError("none of the " + std::to_string(search.draws.z.rows()) +
                               " draws from the prior is feasible: the model excludes every one");
  }
  return search;
}

}  // namespace tmcmc
