#include "tmcmc/reference_search.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "tmcmc/detail/infinity.hpp"
#include "tmcmc/detail/separate_modes.hpp"
#include "tmcmc/detail/vector_sums.hpp"
#include "tmcmc/log_weights.hpp"

namespace tmcmc {

namespace {

Index feasible_draws(const ReferenceDraws& draws) {
  return (draws.log_likelihood.array() > -detail::infinity).count();
}

/// Points whose weights sum to their effective size, without points of less than a hundredth of the
/// mean weight.
WeightedPoints weighted(const ReferenceDraws& draws, const Eigen::VectorXd& log_weight, double effective) {
  constexpr double least_weight = 0.01;
  WeightedPoints data;
  if (!(effective > 0.0)) {
    return data;
  }
  const Eigen::VectorXd weights = normalised_weights(as_span(log_weight));
  data.groups.resize(static_cast<std::size_t>(weights.size()));
  std::size_t kept = 0;
  for (Index i = 0; i < weights.size(); ++i) {
    data.groups[kept] = i;
    kept += weights[i] >= least_weight ? 1 : 0;
  }
  data.groups.resize(kept);
  data.points = draws.z(data.groups, Eigen::all);
  data.weights = weights(data.groups);
  data.weights *= effective / detail::sum(data.weights.data(), data.weights.size());
  return data;
}

/// A temperature and the effective size at it.
struct Tried {
  double beta = 1.0;
  double effective = 0.0;
};

/// The largest beta in (0, 1] about `near` at which the effective size is `wanted` or up to 3 %
/// more, found by a bracket in growing steps and interpolation of the logarithms within it. 0 if
/// there is none.
template <class Function>
Tried beta_of_size(const Function& effective_at, double wanted, double near) {
  constexpr double least_beta = 1e-30;
  constexpr double largest_excess = 1.03;
  constexpr double widest_step = 10.0;
  constexpr int most_steps = 12;
  double step = near < 1.0 ? 1.5 : widest_step;
  const auto tried = [&](double beta) { return Tried{beta, effective_at(beta)}; };
  Tried high;
  Tried low = tried(near);
  while (low.effective >= wanted) {
    if (low.beta == 1.0) {
      return low;
    }
    high = tried(std::min(low.beta * step, 1.0));
    if (high.effective < wanted) {
      break;
    }
    low = high;
    step = std::min(step * step, widest_step);
  }
  while (low.effective < wanted) {
    if (low.beta < least_beta) {
      return {0.0, 0.0};
    }
    high = low;
    low = tried(low.beta / step);
    step = std::min(step * step, widest_step);
  }
  using portable_math::log;
  for (int k = 0; k < most_steps && low.effective > largest_excess * wanted; ++k) {
    const double aim = std::sqrt(largest_excess) * wanted;
    const double part =
        high.effective > 0.0 ? log(low.effective / aim) / log(low.effective / high.effective) : 0.5;
    const Tried middle =
        tried(low.beta * portable_math::exp(std::clamp(part, 0.1, 0.9) * log(high.beta / low.beta)));
    (middle.effective >= wanted ? low : high) = middle;
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

TemperedPoints tempered_points(const ReferenceDraws& draws, double target, double near) {
  constexpr Index fewest_feasible = 10;
  const Index feasible = feasible_draws(draws);
  if (feasible < fewest_feasible) {
    return {};
  }
  const Eigen::VectorXd at_prior = log_prior_weights(draws);
  Eigen::VectorXd tempered(at_prior.size());
  const auto temper = [&](double beta) { tempered = at_prior + beta * draws.log_likelihood; };
  const auto effective_at = [&](double beta) {
    temper(beta);
    return effective_sample_size(as_span(tempered), 1.0);
  };
  const double wanted = std::min(target, 0.5 * static_cast<double>(feasible));
  const Tried found = beta_of_size(effective_at, wanted, near);
  temper(found.beta);
  return {weighted(draws, tempered, found.effective), found.beta, found.effective};
}

namespace {

/// Fits the draws so far: the number of components is chosen anew when the draws have grown enough
/// and when beta has reached 1.
void fit_round(const TemperedPoints& tempered, const SearchOptions& options, const StreamKey& key,
               std::uint32_t stage, const std::function<void()>& look, Index& rows_at_choice,
               Search& search) {
  const double growth =
      options.target < 100.0 ? 1.4 : 2.0;  // few draws lose modes to fits of too few components
  constexpr int iterations_from_last_fit = 3;
  constexpr double tempered_below = 0.3;
  const Index rows = search.draws.evaluations();
  if (search.fit.size() == 0 || (tempered.beta == 1.0 && search.beta() < 1.0) ||
      static_cast<double>(rows) >= growth * static_cast<double>(rows_at_choice)) {
    search.fit = fit_mixture(tempered.points, options.fit, key, stage, look);
    rows_at_choice = rows;
  } else {
    MixtureFitOptions fit = options.fit;
    fit.most_iterations = iterations_from_last_fit;
    search.fit = improve_mixture(tempered.points, std::move(search.fit), fit, look);
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
        options.threads, problem.look);
  };
  const ReferenceDensity prior{.prior_share = 1.0};
  draw(prior, std::min(std::max(2 * options.round, options.evaluations / 8), options.evaluations));
  Index rows_at_choice = 0;
  for (;;) {
    TemperedPoints tempered =
        tempered_points(search.draws, options.target, search.beta() > 0.0 ? search.beta() : 1.0);
    const bool is_fitted = tempered.beta > 0.0;
    if (is_fitted) {
      fit_round(tempered, options, key, stage, problem.look, rows_at_choice, search);
    }
    const double effective = tempered.effective_sample_size;
    tempered.points = {};
    search.rounds.push_back(std::move(tempered));
    const bool is_early = effective >= early * options.target && options.target < options.most_target &&
                          search.draws.evaluations() < options.evaluations / 3;
    const bool is_enough = search.beta() == 1.0 && (effective >= options.enough || is_early);
    const Index round = search.beta() == 1.0
                            ? std::max(options.round, static_cast<Index>(growth_at_posterior * effective))
                            : options.round;
    const Index left = std::min(round, options.evaluations - search.draws.evaluations());
    if (is_enough || left <= 0) {
      return search;
    }
    ReferenceDensity fitted{search.fit, options.prior_share};
    fitted.fitted.wide_share = options.wide_share;
    draw(is_fitted ? fitted : prior, left);
  }
}

}  // namespace

Search search_posterior(const Problem& problem, SearchOptions options, const StreamKey& key) {
  constexpr std::uint32_t stages = 100000;      // of one search, at most
  constexpr double share_of_the_rest = 0.8;     // that a search with larger populations should need
  constexpr double least_factor = 1.3;          // by which populations grow
  constexpr double enough_of_repeats = 1000.0;  // effective draws
  Search search = search_once(problem, options, key, 0);
  auto used = static_cast<double>(search.draws.evaluations());
  for (std::uint32_t pass = 1; search.beta() == 1.0; ++pass) {
    const Index left = options.evaluations - search.draws.evaluations();
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
    used = static_cast<double>(next.draws.evaluations());
    next.most_modes = std::max(next.most_modes, search.most_modes);
    search.draws.append(next.draws, options.threads, problem.look);
    next.draws = std::move(search.draws);
    search = std::move(next);
  }
  if (search.beta() == 0.0 && feasible_draws(search.draws) == 0) {
    throw InfeasiblePriorError("none of the " + std::to_string(search.draws.evaluations()) +
                               " draws from the prior is feasible: the model excludes every one");
  }
  return search;
}

}  // namespace tmcmc
