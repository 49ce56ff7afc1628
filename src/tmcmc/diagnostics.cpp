#include "tmcmc/diagnostics.hpp"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <numeric>
#include <sstream>

#include "names/names.hpp"
#include "portable_math/sums.hpp"
#include "tmcmc/evidence.hpp"

namespace tmcmc {

namespace {

/// Group of each row, from the group of its chain.
std::vector<Index> by_row(std::span<const Index> of_chain, Index rows) {
  std::vector<Index> groups(static_cast<std::size_t>(rows));
  for (std::size_t i = 0; i < groups.size(); ++i) {
    groups[i] = of_chain[i % of_chain.size()];
  }
  return groups;
}

std::vector<Index> groups_of(const Genealogy& genealogy, Index rows) {
  for (const auto& ancestors : genealogy.ancestors()) {
    if (effective_groups(ancestors) >= fewest_groups) {
      return by_row(ancestors, rows);
    }
  }
  std::vector<Index> chains(static_cast<std::size_t>(genealogy.chains));
  std::iota(chains.begin(), chains.end(), Index{0});
  return by_row(chains, rows);
}

class Warnings {
 public:
  /// Adds a warning if value < bound: "<what> is <value>: below <bound>; <advice>".
  void below(double value, double bound, WarningKind kind, const std::string& what, const char* advice) {
    add(value < bound, value, bound, kind, what, "below", advice);
  }
  void above(double value, double bound, WarningKind kind, const std::string& what, const char* advice) {
    add(value > bound, value, bound, kind, what, "above", advice);
  }
  [[nodiscard]] std::vector<Warning> take() { return std::move(list_); }

 private:
  void add(bool found, double value, double bound, WarningKind kind, const std::string& what,
           const char* relation, const char* advice) {
    if (found) {
      std::ostringstream message;
      message.precision(3);
      message << what << " is " << value << ": " << relation << " " << bound << "; " << advice;
      list_.push_back({kind, message.str()});
    }
  }

  std::vector<Warning> list_;
};

std::string of_stage(const char* what, const StageRecord& stage) {
  return what + (" of stage " + std::to_string(stage.stage));
}

/// The standard normal deviate with the same tail probability as the t value.
double normal_score(double t, double degrees_of_freedom) {
  constexpr double largest = 30.0;  // tail probabilities stay far above the smallest double
  const boost::math::students_t_distribution<double> student(degrees_of_freedom);
  const boost::math::normal_distribution<double> normal;
  const double size = std::min(std::fabs(t), largest);
  return std::copysign(boost::math::quantile(complement(normal, boost::math::cdf(complement(student, size)))),
                       t);
}

/// Checks for a drift of the log-likelihood along the chains. By chance both bounds together are
/// exceeded in less than 1 % of runs.
void check_equilibrium(const Result& result, const Options& options, Warnings& warnings) {
  constexpr double most_in_a_stage = 4.5;
  constexpr double most_in_all = 3.0;
  const auto* waste_free = std::get_if<WasteFree>(&options.move);
  if (waste_free == nullptr || waste_free->chains < 3 || result.stages.empty()) {
    return;
  }
  const StageRecord* largest = nullptr;
  double largest_score = 0.0;
  double sum = 0.0;
  for (const StageRecord& stage : result.stages) {
    const double score = normal_score(stage.equilibrium_t, static_cast<double>(waste_free->chains - 1));
    sum += score;
    if (largest == nullptr || score > largest_score) {
      largest = &stage;
      largest_score = score;
    }
  }
  const char* advice = "take longer chains (a larger budget, fewer chains) or smaller steps of beta";
  const double pooled = sum / std::sqrt(static_cast<double>(result.stages.size()));
  if (pooled > most_in_all) {
    warnings.above(pooled, most_in_all, WarningKind::not_in_equilibrium,
                   "the rise of the log-likelihood along the chains of all stages, in standard errors,",
                   advice);
  } else {
    warnings.above(largest_score, most_in_a_stage, WarningKind::not_in_equilibrium,
                   of_stage("the rise of the log-likelihood along the chains, in standard errors,", *largest),
                   advice);
  }
}

}  // namespace

const char* describe(StopReason stop) {
  return names::name_of(stop).data();
}

const char* describe(WarningKind kind) {
  return names::name_of(kind).data();
}

Diagnostics diagnose(const Result& result, const Options& options, std::span<const std::string> names) {
  Diagnostics diagnostics;
  diagnostics.effective_sample_size = effective_sample_sizes(result.final.points, result.final.genealogy);
  Warnings warnings;
  const double n = static_cast<double>(options.samples);
  if (result.stop != StopReason::completed) {
    warnings.below(result.final.beta, 1.0, WarningKind::not_completed,
                   std::string("the run ended early (") + describe(result.stop) + "), and beta",
                   "these are samples of a tempered posterior");
  }
  if (!result.stages.empty()) {
    warnings.below(static_cast<double>(result.stages.front().feasible), std::max(0.01 * n, 20.0),
                   WarningKind::few_feasible, "the number of feasible draws from the prior",
                   "take more samples or a tighter prior");
    const auto ancestors = [](const StageRecord& a, const StageRecord& b) {
      return a.distinct_ancestors < b.distinct_ancestors;
    };
    const StageRecord& fewest = *std::min_element(result.stages.begin(), result.stages.end(), ancestors);
    const auto* waste_free = std::get_if<WasteFree>(&options.move);
    const double starts = waste_free != nullptr ? static_cast<double>(waste_free->chains) : n;
    warnings.below(static_cast<double>(fewest.distinct_ancestors), std::max(0.05 * starts, 3.0),
                   WarningKind::few_ancestors, of_stage("the number of different ancestors", fewest),
                   "take smaller steps of beta or more samples");
    const auto acceptance = [](const StageRecord& a, const StageRecord& b) {
      return a.acceptance_rate < b.acceptance_rate;
    };
    const StageRecord& lowest = *std::min_element(result.stages.begin(), result.stages.end(), acceptance);
    warnings.below(lowest.acceptance_rate, 0.05, WarningKind::low_acceptance,
                   of_stage("the acceptance rate", lowest), "take a smaller proposal scale or more steps");
    warnings.above(result.evidence.standard_error, 1.0, WarningKind::uncertain_evidence,
                   "the standard error of the log-evidence", "take more samples or longer chains");
    const auto effective = [](const StageRecord& a, const StageRecord& b) {
      return a.effective_sample_size < b.effective_sample_size;
    };
    const StageRecord& least = *std::min_element(result.stages.begin(), result.stages.end(), effective);
    const auto d = static_cast<double>(result.final.points.cols());
    warnings.below(least.effective_sample_size / (0.5 * d * (d + 1.0)), 10.0, WarningKind::few_for_covariance,
                   of_stage("the effective sample size per entry of the proposal covariance", least),
                   "take more samples");
    check_equilibrium(result, options, warnings);
  }
  for (Index j = 0; j < diagnostics.effective_sample_size.size(); ++j) {
    warnings.below(diagnostics.effective_sample_size[j], 50.0, WarningKind::low_effective_size,
                   "the effective sample size of " + names[static_cast<std::size_t>(j)],
                   "take more or longer chains");
  }
  diagnostics.warnings = warnings.take();
  return diagnostics;
}

Eigen::VectorXd effective_sample_sizes(const Population& points, const Genealogy& genealogy) {
  const auto n = static_cast<std::size_t>(points.rows());
  const double size = static_cast<double>(n);
  const auto groups = groups_of(genealogy, points.rows());
  Eigen::VectorXd result(points.cols());
  std::vector<double> deviations(n);
  for (Index j = 0; j < points.cols(); ++j) {
    const double* x = points.col(j).data();
    const double mean = portable_math::sum_of(n, [=](std::size_t i) { return x[i]; }) / size;
    for (std::size_t i = 0; i < n; ++i) {
      deviations[i] = x[i] - mean;
    }
    const double squares =
        portable_math::sum_of(n, [&](std::size_t i) { return deviations[i] * deviations[i]; });
    const double variance_of_sum = grouped_variance(deviations, groups);
    result[j] = squares > 0.0 ? size * squares / variance_of_sum : 0.0;
  }
  return result;
}

}  // namespace tmcmc
