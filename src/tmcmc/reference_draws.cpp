// Draws from reference densities, and the density that all of them together are from.

#include <limits>

#include "portable_math/multiversion.hpp"
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

}  // namespace tmcmc
