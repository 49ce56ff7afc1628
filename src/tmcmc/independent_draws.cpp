#include "tmcmc/independent_draws.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>

#include "errors/invalid_value.hpp"
#include "portable_math/sums.hpp"
#include "tmcmc/detail/metropolis_proposal.hpp"
#include "tmcmc/log_weights.hpp"
#include "tmcmc/resampling.hpp"

namespace tmcmc {

namespace {

/// Stages of Purpose::reference: the rounds of a pass and the attempts of the joint fit count from 0.
constexpr std::uint32_t tempered_fit_stage = 1000;
constexpr std::uint32_t final_draws_stage = 2000;

constexpr Index most_attempts = 4;  // of the joint fit

template <class T>
void require(bool condition, const char* field, T value, const char* expected) {
  if (!condition) {
    std::ostringstream text;
    text << value;
    throw errors::InvalidValue(std::string("independent_draws.") + field, text.str(), expected);
  }
}

/// A stream that is independent of the key's own.
StreamKey derived(const StreamKey& key, std::uint32_t number) {
  constexpr std::uint32_t derived_block = 3U << 24U;
  StreamKey result = key;
  result.seed = random_words(key, {.purpose = Purpose::reference, .row = number, .block = derived_block})[0];
  return result;
}

/// A TMCMC run with the fits that it leads to.
struct Pass {
  StreamKey key;
  Result result;
  WeightedPoints population;
  std::optional<StudentMixture> tempered;  // fitted to the population at beta near 1/4
  StudentMixture fit;
  ReferenceDraws draws;
  Index evaluations = 0;
};

Pass first_pass(const Problem& problem, const IndependentDraws& settings, const StreamKey& key) {
  Pass pass{.key = key, .result = {}, .population = {}, .tempered = {}, .fit = {}, .draws = {}};
  const double half = 0.5 * static_cast<double>(settings.evaluations);
  const auto share =
      static_cast<Index>(std::min(std::max(2000.0, settings.first_pass_share * half), 0.5 * half));
  Options options = recommended_options(std::max<Index>(share, 500));
  const Index samples = options.samples;
  const Index chains = std::clamp<Index>(samples / settings.steps_per_chain, 5, samples / 2);
  options.move = WasteFree{.chains = chains};
  options.samples = samples / chains * chains;
  options.threads = settings.threads;
  options.batch_rows = settings.batch_rows;
  Population quarter;
  double least_distance = std::numeric_limits<double>::infinity();
  pass.result = run(problem, options, key, [&](const Progress& progress) {
    const double beta = progress.state.beta;
    const double distance =
        beta > 0.0 && beta < 1.0 ? std::fabs(portable_math::log(beta / 0.25)) : least_distance;
    if (distance < least_distance) {
      least_distance = distance;
      quarter = progress.state.points;
    }
  });
  pass.evaluations = pass.result.final.evaluations;
  pass.population = fit_points(pass.result, problem.prior);
  if (quarter.rows() > 0) {
    pass.tempered =
        fit_mixture({to_unbounded(quarter, problem.prior), Eigen::VectorXd::Ones(quarter.rows()), {}}, 2,
                    settings.fit, key, tempered_fit_stage);
  }
  pass.fit = fit_mixture(pass.population, settings.fit, key, 0);
  return pass;
}

ReferenceDensity reference_of(const IndependentDraws& settings, const StudentMixture& fit,
                              const std::optional<StudentMixture>& tempered) {
  return {.fitted = tempered ? blend(fit, 1.0 - settings.tempered_share, *tempered) : fit,
          .prior_share = settings.prior_share};
}

/// Share of the posterior mass at points where the fit has less than a thousandth of the posterior's density.
double missed_mass(const StudentMixture& fit, const ReferenceDraws& draws, const Eigen::VectorXd& weights,
                   double log_evidence, int threads) {
  const Eigen::VectorXd density = log_density(fit, draws.z, threads);
  const double log_thousandth = -portable_math::log(1000.0);
  return portable_math::sum_of(static_cast<std::size_t>(weights.size()),
                               [&](std::size_t row) {
                                 const auto i = static_cast<Index>(row);
                                 const double posterior =
                                     draws.log_prior[i] + draws.log_likelihood[i] - log_evidence;
                                 return density[i] < posterior + log_thousandth ? weights[i] : 0.0;
                               }) /
         static_cast<double>(weights.size());
}

std::vector<MeasurementWarning> warnings_of(const MeasuredPosterior& measured, double effective_share,
                                            double least_effective_share) {
  using Kind = MeasurementWarningKind;
  std::vector<MeasurementWarning> warnings;
  const auto warn = [&](Kind kind, const std::string& what, double value, const char* bound_is, double bound,
                        const char* advice) {
    std::ostringstream text;
    text.precision(3);
    text << what << " is " << value << ": " << bound_is << " " << bound << "; " << advice;
    warnings.push_back({kind, text.str()});
  };
  constexpr double most_missed = 0.02;
  for (std::size_t p = 0; p < 2; ++p) {
    const std::string of_run = " of TMCMC run " + std::to_string(p + 1);
    const Result& run = measured.first_passes[p];
    if (run.stop != StopReason::completed) {
      warn(Kind::first_pass_not_completed, "beta at the end" + of_run, run.final.beta, "below", 1.0,
           "give the first passes more evaluations");
    }
    if (!(measured.missed_mass[p] <= most_missed)) {
      warn(Kind::fits_differ, "the posterior mass that the fit" + of_run + " has missed",
           measured.missed_mass[p], "above", most_missed,
           "another part of the posterior may have been missed by both; take more evaluations");
    }
  }
  if (!(effective_share >= least_effective_share)) {
    warn(Kind::low_overlap, "the effective share of the draws", effective_share, "below",
         least_effective_share, "the error is a lower bound; take more evaluations or the evidence of run()");
  }
  const double digits =
      portable_math::log(static_cast<double>(measured.weights.size())) / portable_math::log(10.0);
  const double largest_shape = std::min(1.0 - 1.0 / digits, 0.7);
  if (!(measured.pareto_shape <= largest_shape)) {
    warn(Kind::heavy_weights, "the Pareto shape of the largest weights", measured.pareto_shape, "above",
         largest_shape, "the error is a lower bound; take more evaluations or the evidence of run()");
  }
  return warnings;
}

/// The two TMCMC runs with their fits, each improved by rounds of its own.
std::array<Pass, 2> search(const Problem& problem, const IndependentDraws& settings, const StreamKey& key) {
  std::array<Pass, 2> passes;
  for (std::uint32_t p = 0; p < 2; ++p) {
    Pass& pass = passes[p];
    pass = first_pass(problem, settings, derived(key, p));
    const double left = static_cast<double>(settings.evaluations / 2 - pass.evaluations);
    const auto n =
        static_cast<Index>(std::min(std::max(600.0, settings.refinement_share * left), 0.35 * left) /
                           static_cast<double>(settings.refinement_rounds));
    for (Index round = 0; round < settings.refinement_rounds; ++round) {
      pass.draws.append(draw_and_evaluate(problem, reference_of(settings, pass.fit, pass.tempered), n,
                                          pass.key, static_cast<std::uint32_t>(round), settings.threads,
                                          settings.batch_rows));
      if (round + 1 < settings.refinement_rounds) {
        pass.fit = improve_mixture(join(pass.population, fit_points(pass.draws, settings.threads)), pass.fit,
                                   settings.fit);
      }
    }
    pass.evaluations += pass.draws.z.rows();
  }
  return passes;
}

std::optional<StudentMixture> blend_of(const std::optional<StudentMixture>& a,
                                       const std::optional<StudentMixture>& b) {
  return a && b ? blend(*a, 0.5, *b) : (a ? a : b);
}

}  // namespace

void IndependentDraws::validate() const {
  require(evaluations >= 2000, "evaluations", evaluations, "at least 2000");
  require(first_pass_share > 0.0 && first_pass_share <= 0.5, "first_pass_share", first_pass_share,
          "a number in (0, 0.5]");
  require(refinement_share > 0.0 && refinement_share <= 0.35, "refinement_share", refinement_share,
          "a number in (0, 0.35]");
  require(refinement_rounds >= 1 && refinement_rounds <= 10, "refinement_rounds", refinement_rounds,
          "a number from 1 to 10");
  require(least_effective_share >= 0.0 && least_effective_share < 1.0, "least_effective_share",
          least_effective_share, "a number in [0, 1)");
  require(prior_share >= 0.0 && prior_share < 1.0, "prior_share", prior_share, "a number in [0, 1)");
  require(tempered_share >= 0.0 && tempered_share < 1.0, "tempered_share", tempered_share,
          "a number in [0, 1)");
  require(steps_per_chain >= 2, "steps_per_chain", steps_per_chain, "at least 2");
  require(fit.degrees_of_freedom >= 2 && fit.degrees_of_freedom % 2 == 0, "fit.degrees_of_freedom",
          fit.degrees_of_freedom, "an even number of at least 2");
  require(fit.most_components >= 1, "fit.most_components", fit.most_components, "at least 1");
  require(fit.most_iterations >= 1, "fit.most_iterations", fit.most_iterations, "at least 1");
  require(threads >= 1, "threads", threads, "at least 1");
  require(batch_rows >= 0, "batch_rows", batch_rows, "a number of rows, or 0 for no limit");
}

MeasuredPosterior run_with_independent_draws(const Problem& problem, const IndependentDraws& settings,
                                             const StreamKey& key) {
  settings.validate();
  const int threads = settings.threads;
  auto passes = search(problem, settings, key);
  MeasuredPosterior measured;
  measured.evaluations = passes[0].evaluations + passes[1].evaluations;
  const auto draw = [&](Index n, std::uint32_t stage) {
    measured.evaluations += n;
    return draw_and_evaluate(problem, measured.reference, n, key, stage, threads, settings.batch_rows);
  };
  const WeightedPoints populations = join(passes[0].population, passes[1].population);
  const auto tempered = blend_of(passes[0].tempered, passes[1].tempered);
  ReferenceDraws seen = passes[0].draws;  // by a fit
  seen.append(passes[1].draws);
  ReferenceDraws draws;
  for (std::uint32_t attempt = 0; attempt < most_attempts; ++attempt) {
    if (attempt > 0) {
      seen.append(draws);
    }
    measured.reference = reference_of(
        settings, fit_mixture(join(populations, fit_points(seen, threads)), settings.fit, key, attempt),
        tempered);
    draws = draw((settings.evaluations - measured.evaluations) / 8, attempt);
    const double effective = effective_sample_size(as_span(log_weights(draws, threads)), 1.0);
    if (effective >= settings.least_effective_share * static_cast<double>(draws.z.rows())) {
      break;
    }
  }
  draws.append(draw(settings.evaluations - measured.evaluations, final_draws_stage));
  draws.references.resize(1);  // both are the same
  draws.counts = {draws.z.rows()};

  const Eigen::VectorXd log_weight = log_weights(draws, threads);
  const ImportanceEstimate estimate = importance_estimate(as_span(log_weight));
  measured.points = from_unbounded(draws.z, problem.prior);
  measured.log_likelihood = draws.log_likelihood;
  measured.weights = normalised_weights(as_span(log_weight));
  measured.evidence = {estimate.log_mean, estimate.standard_error};
  measured.effective_sample_size = estimate.effective_sample_size;
  measured.pareto_shape = estimate.pareto_shape;
  for (std::size_t p = 0; p < 2; ++p) {
    measured.missed_mass[p] = missed_mass(passes[p].fit, draws, measured.weights, estimate.log_mean, threads);
    measured.first_passes[p] = std::move(passes[p].result);
  }
  measured.warnings =
      warnings_of(measured, measured.effective_sample_size / static_cast<double>(draws.z.rows()),
                  settings.least_effective_share);
  return measured;
}

Population equally_weighted(const MeasuredPosterior& measured, Index n, const StreamKey& key) {
  require(n >= 1, "equally_weighted: n", n, "at least 1");
  std::vector<Index> rows(static_cast<std::size_t>(n));
  resample(Resampling::residual, as_span(measured.weights), derived(key, 2), 0, rows);
  Population points(n, measured.points.cols());
  for (Index i = 0; i < n; ++i) {
    points.row(i) = measured.points.row(rows[static_cast<std::size_t>(i)]);
  }
  return points;
}

}  // namespace tmcmc
