// Draws from reference densities, and the joint density of all of them.

#include <limits>
#include <numeric>

#include "portable_math/multiversion.hpp"
#include "tmcmc/detail/infinity.hpp"
#include "tmcmc/detail/metropolis_step.hpp"
#include "tmcmc/parallel.hpp"
#include "tmcmc/reference_search.hpp"

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

/// result = log_own + log(fitted + prior_draws exp(log_prior - log_own)): log(sum_r n_r q_r).
PORTABLE_MATH_MULTIVERSION
void log_mixture(Index n, double prior_draws, const double* fitted, const double* log_prior,
                 const double* log_own, double* result) {
  for (Index i = 0; i < n; ++i) {
    const double prior = portable_math::exp(log_prior[i] - log_own[i]);
    result[i] = log_own[i] + portable_math::log(fitted[i] + prior_draws * prior);
  }
}

/// result = n (1 - s exp(log_prior - log_own)), for draws from one density: n (1 - s) f over their
/// density f (1 - s) + s p.
PORTABLE_MATH_MULTIVERSION
void relative_to_own(Index rows, double n, double prior_share, const double* log_prior, const double* log_own,
                     double* result) {
  for (Index i = 0; i < rows; ++i) {
    result[i] = n * (1.0 - prior_share * portable_math::exp(log_prior[i] - log_own[i]));
  }
}

/// sum_r n_r s_r: the number of draws that come from the prior.
double prior_draws(const ReferenceDraws& draws) {
  double result = 0.0;
  for (std::size_t r = 0; r < draws.references.size(); ++r) {
    result += static_cast<double>(draws.counts[r]) * draws.references[r].prior_share;
  }
  return result;
}

/// Adds n_r (1 - s_r) f_r, divided by the points' own density, for each of the references.
void add_references(const std::vector<ReferenceDensity>& references, const std::vector<Index>& counts,
                    const Population& z, const Eigen::VectorXd& log_own, Eigen::VectorXd& fitted, int threads,
                    const std::function<void()>& look) {
  for (std::size_t r = 0; r < references.size(); ++r) {
    const double draws = static_cast<double>(counts[r]) * (1.0 - references[r].prior_share);
    if (draws > 0.0) {
      if (look) {
        look();
      }
      add_relative_density(references[r].fitted, portable_math::log(draws), z, log_own, fitted, threads);
    }
  }
}

/// The draws that the model does not exclude.
ReferenceDraws without_excluded(const ReferenceDraws& draws) {
  std::vector<Index> rows;
  for (Index i = 0; i < draws.z.rows(); ++i) {
    if (draws.log_likelihood[i] > -detail::infinity) {
      rows.push_back(i);
    }
  }
  return {.z = draws.z(rows, Eigen::all),
          .log_prior = draws.log_prior(rows),
          .log_likelihood = draws.log_likelihood(rows),
          .log_own = draws.log_own(rows),
          .fitted = draws.fitted(rows),
          .references = draws.references,
          .counts = draws.counts};
}

}  // namespace

Index ReferenceDraws::evaluations() const {
  return std::accumulate(counts.begin(), counts.end(), Index{0});
}

void ReferenceDraws::append(const ReferenceDraws& other, int threads, const std::function<void()>& look) {
  ReferenceDraws added = without_excluded(other);
  add_references(references, counts, added.z, added.log_own, added.fitted, threads, look);
  add_references(other.references, other.counts, z, log_own, fitted, threads, look);
  z = stacked(z, added.z);
  log_prior = stacked(log_prior, added.log_prior);
  log_likelihood = stacked(log_likelihood, added.log_likelihood);
  log_own = stacked(log_own, added.log_own);
  fitted = stacked(fitted, added.fitted);
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
  log_own = stacked(log_own, other.log_own);
  const Eigen::VectorXd mine = fitted * ((before + added) / before);
  const Eigen::VectorXd others = other.fitted * ((before + added) / added);
  fitted = stacked(mine, others);
}

ReferenceDraws draw_and_evaluate(const Problem& problem, const ReferenceDensity& reference, Index n,
                                 const StreamKey& key, std::uint32_t stage, int threads, Index batch_rows) {
  ReferenceDraws draws{
      .z = sample(reference, problem.prior, n, key, stage, threads),
      .log_prior = {},
      .log_likelihood = Eigen::VectorXd::Constant(n, std::numeric_limits<double>::quiet_NaN()),
      .log_own = {},
      .fitted = Eigen::VectorXd(n),
      .references = {reference},
      .counts = {n}};
  draws.log_prior = log_prior_density(draws.z, problem.prior, threads);
  draws.log_own = log_density(reference, draws.z, draws.log_prior, threads);
  relative_to_own(n, static_cast<double>(n), reference.prior_share, draws.log_prior.data(),
                  draws.log_own.data(), draws.fitted.data());
  const Population x = from_unbounded(draws.z, problem.prior);
  for_each_block(n, rows_per_call(n, threads, batch_rows), threads, [&](Index, Index begin, Index end) {
    problem.log_likelihood(x.middleRows(begin, end - begin),
                           draws.log_likelihood.segment(begin, end - begin));
  });
  require_valid(x, draws.log_likelihood);
  return draws;
}

Eigen::VectorXd log_prior_weights(const ReferenceDraws& draws) {
  const double log_n = portable_math::log(static_cast<double>(draws.evaluations()));
  Eigen::VectorXd result(draws.z.rows());
  log_mixture(result.size(), prior_draws(draws), draws.fitted.data(), draws.log_prior.data(),
              draws.log_own.data(), result.data());
  return (draws.log_prior - result).array() + log_n;
}

Eigen::VectorXd log_weights(const ReferenceDraws& draws) {
  return log_prior_weights(draws) + draws.log_likelihood;
}

Eigen::VectorXd log_draws_per_volume(const ReferenceDraws& draws, const Population& z,
                                     const Eigen::VectorXd& log_prior, const Eigen::VectorXd& log_own,
                                     int threads, const std::function<void()>& look) {
  Eigen::VectorXd fitted = Eigen::VectorXd::Zero(z.rows());
  add_references(draws.references, draws.counts, z, log_own, fitted, threads, look);
  Eigen::VectorXd result(z.rows());
  log_mixture(result.size(), prior_draws(draws), fitted.data(), log_prior.data(), log_own.data(),
              result.data());
  return result;
}

}  // namespace tmcmc
