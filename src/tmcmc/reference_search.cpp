#include "tmcmc/reference_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "portable_math/multiversion.hpp"
#include "tmcmc/detail/infinity.hpp"
#include "tmcmc/detail/metropolis_step.hpp"
#include "tmcmc/detail/separate_modes.hpp"
#include "tmcmc/log_weights.hpp"
#include "tmcmc/parallel.hpp"

namespace tmcmc {

using detail::require_valid;

namespace {

template <class Matrix>
Matrix stacked(const Matrix& a, const Matrix& b) {
  Matrix all(a.rows() + b.rows(), b.cols());
  for (Index j = 0; j < b.cols(); ++j) {
    if (a.rows() > 0) {
      all.col(j).head(a.rows()) = a.col(j);
    }
    all.col(j).tail(b.rows()) = b.col(j);
  }
  return all;
}

/// log_sum = log(exp(log_sum) + exp(shift + added)), at least one of them finite.
PORTABLE_MATH_MULTIVERSION
void log_add(double shift, const double* added, Index n, double* log_sum) {
  for (Index i = 0; i < n; ++i) {
    const double first = log_sum[i];
    const double second = shift + added[i];
    const double larger = first > second ? first : second;
    const double smaller = first > second ? second : first;
    log_sum[i] = larger + portable_math::log_positive(1.0 + portable_math::exp(smaller - larger));
  }
}

/// Adds count * reference to the mixture at the points.
void add_reference(const ReferenceDensity& reference, Index count, const Population& z,
                   const Eigen::VectorXd& log_prior, Eigen::VectorXd& log_mixture, int threads) {
  const Eigen::VectorXd density = log_density(reference, z, log_prior, threads);
  log_add(portable_math::log(static_cast<double>(count)), density.data(), density.size(), log_mixture.data());
}

Index feasible_draws(const ReferenceDraws& draws) {
  return (draws.log_likelihood.array() > -detail::infinity).count();
}

/// Points whose weights sum to their effective size, without those of less than a thousandth of the mean weight.
WeightedPoints weighted(const ReferenceDraws& draws, const Eigen::VectorXd& log_weight, double effective) {
  constexpr double least_weight = 1e-3;
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

/// The weights for L^beta p.
Eigen::VectorXd at_temperature(const ReferenceDraws& draws, const Eigen::VectorXd& log_weight, double beta) {
  Eigen::VectorXd tempered = log_weight;
  for (Index i = 0; i < tempered.size(); ++i) {
    if (draws.log_likelihood[i] > -detail::infinity) {
      tempered[i] -= (1.0 - beta) * draws.log_likelihood[i];
    }
  }
  return tempered;
}

}  // namespace

void ReferenceDraws::append(const ReferenceDraws& other, int threads) {
  if (references.empty()) {
    *this = other;
    return;
  }
  ReferenceDraws added = other;
  for (std::size_t r = 0; r < references.size(); ++r) {
    add_reference(references[r], counts[r], added.z, added.log_prior, added.log_mixture, threads);
  }
  for (std::size_t r = 0; r < other.references.size(); ++r) {
    add_reference(other.references[r], other.counts[r], z, log_prior, log_mixture, threads);
  }
  z = stacked(z, added.z);
  log_prior = stacked(log_prior, added.log_prior);
  log_likelihood = stacked(log_likelihood, added.log_likelihood);
  log_mixture = stacked(log_mixture, added.log_mixture);
  references.insert(references.end(), other.references.begin(), other.references.end());
  counts.insert(counts.end(), other.counts.begin(), other.counts.end());
}

void ReferenceDraws::append_of_same_density(const ReferenceDraws& other) {
  const auto before = static_cast<double>(counts.front());
  const auto added = static_cast<double>(other.counts.front());
  counts.front() += other.counts.front();
  z = stacked(z, other.z);
  log_prior = stacked(log_prior, other.log_prior);
  log_likelihood = stacked(log_likelihood, other.log_likelihood);
  const Eigen::VectorXd mine = log_mixture.array() + portable_math::log((before + added) / before);
  const Eigen::VectorXd others = other.log_mixture.array() + portable_math::log((before + added) / added);
  log_mixture = stacked(mine, others);
}

ReferenceDraws draw_and_evaluate(const Problem& problem, const ReferenceDensity& reference, Index n,
                                 const StreamKey& key, std::uint32_t stage, int threads, Index batch_rows) {
  ReferenceDraws draws{
      .z = sample(reference, problem.prior, n, key, stage, threads),
      .log_prior = {},
      .log_likelihood = Eigen::VectorXd::Constant(n, std::numeric_limits<double>::quiet_NaN()),
      .log_mixture = {},
      .references = {reference},
      .counts = {n}};
  draws.log_prior = log_prior_density(draws.z, problem.prior, threads);
  draws.log_mixture = log_density(reference, draws.z, draws.log_prior, threads).array() +
                      portable_math::log(static_cast<double>(n));
  const Population x = from_unbounded(draws.z, problem.prior);
  for_each_block(n, rows_per_call(n, threads, batch_rows), threads, [&](Index, Index begin, Index end) {
    problem.log_likelihood(x.middleRows(begin, end - begin),
                           draws.log_likelihood.segment(begin, end - begin));
  });
  require_valid(x, draws.log_likelihood);
  return draws;
}

Eigen::VectorXd log_weights(const ReferenceDraws& draws) {
  const double log_n = portable_math::log(static_cast<double>(draws.z.rows()));
  return (draws.log_prior + draws.log_likelihood - draws.log_mixture).array() + log_n;
}

Eigen::VectorXd log_draws_per_volume(const ReferenceDraws& draws, const Population& z,
                                     const Eigen::VectorXd& log_prior, int threads) {
  constexpr double nearly_nothing = -1e300;
  Eigen::VectorXd log_mixture = Eigen::VectorXd::Constant(z.rows(), nearly_nothing);
  for (std::size_t r = 0; r < draws.references.size(); ++r) {
    add_reference(draws.references[r], draws.counts[r], z, log_prior, log_mixture, threads);
  }
  return log_mixture;
}

WeightedPoints fit_points(const ReferenceDraws& draws, double fewest) {
  const Eigen::VectorXd log_weight = log_weights(draws);
  const double target = std::min(fewest, 0.5 * static_cast<double>(feasible_draws(draws)));
  const double power = tempering_power(as_span(log_weight), target);
  return weighted(draws, power * log_weight,
                  power > 0.0 ? effective_sample_size(as_span(log_weight), power) : 0.0);
}

TemperedPoints tempered_points(const ReferenceDraws& draws, double target) {
  constexpr Index fewest_feasible = 10;
  constexpr double least_beta = 1e-30;
  const Eigen::VectorXd log_weight = log_weights(draws);
  const Index feasible = feasible_draws(draws);
  if (feasible < fewest_feasible) {
    return {weighted(draws, log_weight, 0.0)};
  }
  const double wanted = std::min(target, 0.5 * static_cast<double>(feasible));
  const auto effective_at = [&](double beta) {
    return effective_sample_size(as_span(at_temperature(draws, log_weight, beta)), 1.0);
  };
  double low = effective_at(1.0) >= wanted ? 1.0 : 0.0;
  double high = 1.0;
  while (low == 0.0 && high > least_beta) {
    (effective_at(0.1 * high) >= wanted ? low : high) = 0.1 * high;
  }
  for (int i = 0; i < 8 && low > 0.0 && low < 1.0; ++i) {
    const double middle = std::sqrt(low * high);
    (effective_at(middle) >= wanted ? low : high) = middle;
  }
  const Eigen::VectorXd tempered = at_temperature(draws, log_weight, low);
  const double effective = effective_sample_size(as_span(tempered), 1.0);
  return {weighted(draws, tempered, effective), low, effective};
}

namespace {

/// Fits the draws so far: the number of components is chosen where they have grown by two fifths and where beta has come to 1.
void fit_round(const TemperedPoints& tempered, const SearchOptions& options, const StreamKey& key,
               std::uint32_t stage, Index& rows_at_choice, Search& search) {
  constexpr double growth = 1.4;
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
