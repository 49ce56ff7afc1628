#include "tmcmc/reference_search.hpp"

#include <algorithm>
#include <limits>

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

}  // namespace

void ReferenceDraws::append(const ReferenceDraws& other) {
  z = stacked(z, other.z);
  log_prior = stacked(log_prior, other.log_prior);
  log_likelihood = stacked(log_likelihood, other.log_likelihood);
  references.insert(references.end(), other.references.begin(), other.references.end());
  counts.insert(counts.end(), other.counts.begin(), other.counts.end());
}

ReferenceDraws draw_and_evaluate(const Problem& problem, const ReferenceDensity& reference, Index n,
                                 const StreamKey& key, std::uint32_t stage, int threads, Index batch_rows) {
  ReferenceDraws draws{
      .z = sample(reference, problem.prior, n, key, stage, threads),
      .log_prior = {},
      .log_likelihood = Eigen::VectorXd::Constant(n, std::numeric_limits<double>::quiet_NaN()),
      .references = {reference},
      .counts = {n}};
  draws.log_prior = log_prior_density(draws.z, problem.prior, threads);
  const Population x = from_unbounded(draws.z, problem.prior);
  for_each_block(n, rows_per_call(n, threads, batch_rows), threads, [&](Index, Index begin, Index end) {
    problem.log_likelihood(x.middleRows(begin, end - begin),
                           draws.log_likelihood.segment(begin, end - begin));
  });
  require_valid(x, draws.log_likelihood);
  return draws;
}

Eigen::VectorXd log_weights(const ReferenceDraws& draws, int threads) {
  const Index n = draws.z.rows();
  Eigen::VectorXd largest;
  std::vector<Eigen::VectorXd> densities;
  for (std::size_t r = 0; r < draws.references.size(); ++r) {
    densities.push_back(log_density(draws.references[r], draws.z, draws.log_prior, threads));
    largest = r == 0 ? densities[0] : Eigen::VectorXd(largest.cwiseMax(densities[r]));
  }
  Eigen::VectorXd result = draws.log_prior + draws.log_likelihood;
  for (Index i = 0; i < n; ++i) {
    double sum = 0.0;
    for (std::size_t r = 0; r < densities.size(); ++r) {
      sum += static_cast<double>(draws.counts[r]) / static_cast<double>(n) *
             portable_math::exp(densities[r][i] - largest[i]);
    }
    result[i] -= largest[i] + portable_math::log(sum);
  }
  return result;
}

WeightedPoints fit_points(const Result& result, const Prior& prior) {
  constexpr double independent_share = 0.1;
  const Index n = result.final.points.rows();
  WeightedPoints data{
      to_unbounded(result.final.points, prior), Eigen::VectorXd::Constant(n, independent_share), {}};
  for (Index i = 0; i < n; ++i) {
    data.groups.push_back(i % result.final.genealogy.chains);
  }
  return data;
}

WeightedPoints fit_points(const ReferenceDraws& draws, int threads) {
  const auto n = static_cast<double>(draws.z.rows());
  Eigen::VectorXd log_weight = log_weights(draws, threads);
  const double fewest = std::min({std::max(100.0, 20.0 * static_cast<double>(draws.z.cols())), 0.5 * n});
  const double power = tempering_power(as_span(log_weight), fewest);
  WeightedPoints data{draws.z, Eigen::VectorXd::Zero(draws.z.rows()), {}};
  if (power > 0.0) {
    const double effective = effective_sample_size(as_span(log_weight), power);
    for (double& value : log_weight) {
      value *= power;
    }
    data.weights = normalised_weights(as_span(log_weight)) * (effective / n);
  }
  for (Index i = 0; i < draws.z.rows(); ++i) {
    data.groups.push_back(i);
  }
  return data;
}

WeightedPoints join(const WeightedPoints& a, const WeightedPoints& b) {
  WeightedPoints all{stacked(a.points, b.points), stacked(a.weights, b.weights), a.groups};
  // An even shift keeps the parity that the halves of a fit go by.
  const Index shift =
      a.groups.empty() ? 0 : (*std::max_element(a.groups.begin(), a.groups.end()) / 2 + 1) * 2;
  for (const Index group : b.groups) {
    all.groups.push_back(group + shift);
  }
  return all;
}

}  // namespace tmcmc
