#include "tmcmc/reference_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "tmcmc/detail/infinity.hpp"
#include "tmcmc/detail/metropolis_step.hpp"
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

/// Adds count * reference to the mixture at the points.
void add_reference(const ReferenceDensity& reference, Index count, const Population& z,
                   const Eigen::VectorXd& log_prior, Eigen::VectorXd& log_mixture, int threads) {
  const Eigen::VectorXd density = log_density(reference, z, log_prior, threads);
  const double log_count = portable_math::log(static_cast<double>(count));
  for (Index i = 0; i < density.size(); ++i) {
    const double added = log_count + density[i];
    const double larger = std::max(log_mixture[i], added);
    const double smaller = std::min(log_mixture[i], added);
    log_mixture[i] = larger + portable_math::log(1.0 + portable_math::exp(smaller - larger));
  }
}

Index feasible_draws(const ReferenceDraws& draws) {
  return (draws.log_likelihood.array() > -detail::infinity).count();
}

/// Points whose weights sum to their effective size.
WeightedPoints weighted(const ReferenceDraws& draws, const Eigen::VectorXd& log_weight, double effective) {
  WeightedPoints data{draws.z, Eigen::VectorXd::Zero(draws.z.rows()), {}};
  if (effective > 0.0) {
    data.weights =
        normalised_weights(as_span(log_weight)) * (effective / static_cast<double>(draws.z.rows()));
  }
  for (Index i = 0; i < draws.z.rows(); ++i) {
    data.groups.push_back(i);
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
  for (int i = 0; i < 20 && low < 1.0; ++i) {
    const double middle = 0.5 * (low + high);
    (effective_at(middle) >= wanted ? low : high) = middle;
  }
  const Eigen::VectorXd tempered = at_temperature(draws, log_weight, low);
  const double effective = effective_sample_size(as_span(tempered), 1.0);
  return {weighted(draws, tempered, effective), low, effective};
}

Search search_posterior(const Problem& problem, const SearchOptions& options, const StreamKey& key) {
  constexpr Index rounds = 15;
  constexpr double tempered_below = 0.3;
  Search search;
  const Index each = std::max<Index>(options.evaluations / (rounds + 1), 1);
  std::uint32_t stage = 0;
  const auto draw = [&](const ReferenceDensity& reference, Index n) {
    search.draws.append(
        draw_and_evaluate(problem, reference, n, key, stage++, options.threads, options.batch_rows),
        options.threads);
  };
  const ReferenceDensity prior{.prior_share = 1.0};
  draw(prior, std::min(2 * each, options.evaluations));
  for (;;) {
    TemperedPoints tempered = tempered_points(search.draws, options.target);
    const bool is_fitted = tempered.beta > 0.0;
    if (is_fitted) {
      search.fit = fit_mixture(tempered.points, options.fit, key, stage);
      if (tempered.beta < tempered_below) {
        search.tempered = search.fit;
      }
    }
    tempered.points = {};
    search.rounds.push_back(std::move(tempered));
    const bool is_enough = search.beta() == 1.0 &&
                           effective_sample_size(as_span(log_weights(search.draws)), 1.0) >= options.enough;
    const Index left = std::min(each, options.evaluations - search.draws.z.rows());
    if (is_enough || left <= 0) {
      break;
    }
    draw(is_fitted ? ReferenceDensity{search.fit, options.prior_share} : prior, left);
  }
  if (search.beta() == 0.0 && feasible_draws(search.draws) == 0) {
    throw InfeasiblePriorError("none of the " + std::to_string(search.draws.z.rows()) +
                               " draws from the prior is feasible: the model excludes every one");
  }
  return search;
}

}  // namespace tmcmc
