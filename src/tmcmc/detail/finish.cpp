#include "tmcmc/detail/finish.hpp"

#include <algorithm>
#include <functional>
#include <sstream>

#include "tmcmc/detail/independent_draws.hpp"
#include "tmcmc/detail/recorded_likelihood.hpp"
#include "tmcmc/weighted_samples.hpp"

namespace tmcmc::detail {

namespace {

/// Number of calls of an observer in a run.
constexpr Index observations = 40;

/// The progress of a run after these evaluations.
Progress progress_of(const Walkers& evaluated) {
  Progress progress;
  static_cast<Walkers&>(progress.state) = evaluated;
  progress.state.evaluations = evaluated.points.rows();
  progress.state.genealogy.chains = evaluated.points.rows();
  return progress;
}

/// Warnings that apply to every weighted sample.
void warn_of_sizes(const Prior& prior, Result& result) {
  constexpr double fewest = 50.0;
  constexpr double largest_error = 1.0;
  const auto warn = [&](WarningKind kind, const std::string& what, double value, const char* bound) {
    std::ostringstream text;
    text.precision(3);
    text << what << " is " << value << ": " << bound << "; take more evaluations";
    result.diagnostics.warnings.push_back({kind, text.str()});
  };
  if (!(result.evidence.standard_error <= largest_error)) {
    warn(WarningKind::uncertain_evidence, "the standard error of the log-evidence",
         result.evidence.standard_error, "above 1");
  }
  for (Index j = 0; j < result.diagnostics.effective_sample_size.size(); ++j) {
    const double size = result.diagnostics.effective_sample_size[j];
    if (!(size >= fewest)) {
      warn(WarningKind::low_effective_size,
           "the effective sample size of " + prior.names()[static_cast<std::size_t>(j)], size, "below 50");
    }
  }
}

Result result_of(MeasuredPosterior measured, const Options& options, const Prior& prior) {
  Result result;
  if (measured.tmcmc) {
    result = std::move(*measured.tmcmc);
  } else {
    result.final.points = std::move(measured.points);
    result.final.log_likelihood = std::move(measured.log_likelihood);
    result.final.beta = 1.0;
    result.final.log_evidence = measured.evidence.log_evidence;
    result.final.genealogy.chains = result.final.points.rows();
    result.final.stage = static_cast<Index>(measured.rounds.size());
    result.weights = std::move(measured.weights);
    result.stages = std::move(measured.rounds);
    result.measurement = {measured.effective_sample_size, measured.pareto_shape, measured.search_beta,
                          measured.missed_mass};
    if (options.diagnose) {
      result.evidence = measured.evidence;
      result.diagnostics.effective_sample_size = effective_sample_sizes(result.final.points, result.weights);
      warn_of_sizes(prior, result);
    }
  }
  result.final.evaluations = measured.evaluations;
  if (options.diagnose) {
    auto& warnings = result.diagnostics.warnings;
    warnings.insert(warnings.begin(), measured.warnings.begin(), measured.warnings.end());
  }
  return result;
}

}  // namespace

Result run_independent_draws(const Problem& problem, const Options& options, const StreamKey& key,
                             const Progress& from, const Observer& observer) {
  if (!observer && from.state.points.rows() == 0) {
    return result_of(measure_posterior(problem, options, key), options, problem.prior);
  }
  EvaluationObserver keep;
  if (observer) {
    keep = [&](const Walkers& evaluated) { observer(progress_of(evaluated)); };
  }
  const Index rows = std::max<Index>(options.evaluation_budget / observations, 1);
  RecordedLikelihood recorded(problem.log_likelihood, from.state, rows, keep);
  return result_of(measure_posterior({std::ref(recorded), problem.prior, problem.look}, options, key),
                   options, problem.prior);
}

}  // namespace tmcmc::detail
