#include "tmcmc/independent_draws.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "errors/invalid_value.hpp"
#include "portable_math/sums.hpp"
#include "tmcmc/detail/resample.hpp"
#include "tmcmc/log_weights.hpp"

namespace tmcmc {

namespace {

/// Stages of Purpose::reference: the attempts of the joint fit count from 0.
constexpr std::uint32_t final_draws_stage = 2000;

constexpr double least_beta = 0.01;           // that one search has to reach
constexpr double share_of_a_good_fit = 0.65;  // of the first trial draws
constexpr double share_of_a_poor_fit = 0.1;   // below it there are more attempts
constexpr std::uint32_t most_attempts = 4;    // of the joint fit
constexpr std::uint32_t most_attempts_poor = 12;

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

/// Effective size that the criterion asks of a population of so many draws as a fit takes.
double effective_target(const IndependentDraws& settings, Index d) {
  const double population = std::max(200.0, 40.0 * static_cast<double>(d));
  if (const auto* size = std::get_if<EffectiveSampleSize>(&settings.criterion.rule)) {
    return population * size->fraction;
  }
  const double target = std::get<CoefficientOfVariation>(settings.criterion.rule).target;
  return population / (1.0 + target * target);
}

SearchOptions search_options(const IndependentDraws& settings, Index d) {
  constexpr double fewest = 2400.0;
  const auto all = static_cast<double>(settings.evaluations);
  return {.evaluations =
              static_cast<Index>(0.5 * std::min(std::max(settings.search_share * all, fewest), 0.5 * all)),
          .target = effective_target(settings, d),
          .enough = 10.0 * effective_target(settings, d),
          .prior_share = settings.prior_share,
          .fit = settings.fit,
          .threads = settings.threads,
          .batch_rows = settings.batch_rows};
}

/// The fit with a share of the tempered ones, if there are any, and one of the prior.
ReferenceDensity reference_of(const IndependentDraws& settings, const StudentMixture& fit,
                              const std::array<Search, 2>& searches) {
  const StudentMixture& a = searches[0].tempered;
  const StudentMixture& b = searches[1].tempered;
  if (a.size() == 0 && b.size() == 0) {
    return {.fitted = fit, .prior_share = settings.prior_share};
  }
  const StudentMixture tempered = a.size() > 0 && b.size() > 0 ? blend(a, 0.5, b) : (a.size() > 0 ? a : b);
  return {.fitted = blend(fit, 1.0 - settings.tempered_share, tempered), .prior_share = settings.prior_share};
}

/// Share of the posterior mass, at up to 2000 of the draws, where a search has made fewer than 20 draws per unit of mass.
double missed_mass(const Search& search, const ReferenceDraws& draws, const Eigen::VectorXd& weights,
                   double log_evidence, int threads) {
  constexpr Index most_points = 2000;
  const double log_fewest = portable_math::log(20.0);
  const Index n = draws.z.rows();
  const Index stride = (n + most_points - 1) / most_points;
  Population z((n + stride - 1) / stride, draws.z.cols());
  Eigen::VectorXd log_prior(z.rows());
  for (Index i = 0; i < z.rows(); ++i) {
    z.row(i) = draws.z.row(i * stride);
    log_prior[i] = draws.log_prior[i * stride];
  }
  const Eigen::VectorXd log_draws = log_draws_per_volume(search.draws, z, log_prior, threads);
  double missed = 0.0;
  double all = 0.0;
  for (Index i = 0; i < z.rows(); ++i) {
    const double weight = weights[i * stride];
    const double posterior = log_prior[i] + draws.log_likelihood[i * stride] - log_evidence;
    all += weight;
    missed += log_draws[i] < posterior + log_fewest ? weight : 0.0;
  }
  return all > 0.0 ? missed / all : 0.0;
}

std::vector<MeasurementWarning> warnings_of(const MeasuredPosterior& measured) {
  using Kind = MeasurementWarningKind;
  std::vector<MeasurementWarning> warnings;
  const auto warn = [&](Kind kind, const char* what, double value, const char* bound_is, double bound,
                        const char* advice) {
    std::ostringstream text;
    text.precision(3);
    text << what << " is " << value << ": " << bound_is << " " << bound << "; " << advice;
    warnings.push_back({kind, text.str()});
  };
  constexpr double most_missed = 0.25;
  constexpr double most_missed_by_both = 0.01;
  const double missed = std::max(measured.missed_mass[0], measured.missed_mass[1]);
  const double missed_by_both = measured.missed_mass[0] * measured.missed_mass[1];
  const char* advice = "another part may have been missed by both; take more evaluations or other seeds";
  if (!(missed <= most_missed)) {
    warn(Kind::fits_differ, "the posterior mass that one of two searches has missed", missed, "above",
         most_missed, advice);
  } else if (!(missed_by_both <= most_missed_by_both)) {
    warn(Kind::fits_differ, "the product of the posterior masses that each of two searches has missed",
         missed_by_both, "above", most_missed_by_both, advice);
  }
  constexpr double fewest_effective = 500.0;
  constexpr double least_share = 0.05;
  const auto n = static_cast<double>(measured.weights.size());
  const double least = std::max(fewest_effective, least_share * n);
  if (!(measured.effective_sample_size >= least)) {
    warn(Kind::low_overlap, "the effective number of draws", measured.effective_sample_size, "below", least,
         "the error is a lower bound; take more evaluations");
  }
  const double digits = portable_math::log(n) / portable_math::log(10.0);
  const double largest_shape = std::min(1.0 - 1.0 / digits, 0.7);
  if (!(measured.pareto_shape <= largest_shape)) {
    warn(Kind::heavy_weights, "the Pareto shape of the largest weights", measured.pareto_shape, "above",
         largest_shape, "the error is a lower bound; take more evaluations");
  }
  return warnings;
}

/// What a run of TMCMC on the remaining evaluations gives.
void take_over(const Problem& problem, const IndependentDraws& settings, const StreamKey& key,
               MeasuredPosterior& measured) {
  Options options = recommended_options(settings.evaluations - measured.evaluations);
  options.threads = settings.threads;
  options.batch_rows = settings.batch_rows;
  measured.tmcmc = run(problem, options, key);
  const Result& result = *measured.tmcmc;
  measured.points = result.final.points;
  measured.log_likelihood = result.final.log_likelihood;
  measured.weights = Eigen::VectorXd::Ones(result.final.points.rows());
  measured.evidence = result.evidence;
  measured.effective_sample_size = result.diagnostics.effective_sample_size.minCoeff();
  measured.evaluations += result.final.evaluations;
  std::ostringstream text;
  text.precision(3);
  text << "beta at the end of the better search is "
       << std::max(measured.search_beta[0], measured.search_beta[1]) << ": below " << least_beta
       << "; the result is that of TMCMC, take more evaluations";
  measured.warnings.push_back({MeasurementWarningKind::search_not_completed, text.str()});
  for (const Warning& warning : result.diagnostics.warnings) {
    measured.warnings.push_back({MeasurementWarningKind::tmcmc, warning.message});
  }
}

/// Whether the fit is good enough to be frozen, or attempts have to end.
bool is_frozen(const IndependentDraws& settings, double effective_share, std::uint32_t attempt) {
  if (attempt == 0) {
    return effective_share >= share_of_a_good_fit;
  }
  return effective_share >= settings.least_effective_share ||
         attempt + 1 >= (effective_share >= share_of_a_poor_fit ? most_attempts : most_attempts_poor);
}

}  // namespace

void IndependentDraws::validate() const {
  require(evaluations >= 2000, "evaluations", evaluations, "at least 2000");
  const double fraction = effective_target(*this, 1) / effective_target({}, 1);
  require(fraction > 0.0 && fraction <= 2.0, "criterion", fraction,
          "a positive CoV, or an effective sample size of a share in (0, 1]");
  require(search_share > 0.0 && search_share <= 0.5, "search_share", search_share, "a number in (0, 0.5]");
  require(least_effective_share >= 0.0 && least_effective_share < 1.0, "least_effective_share",
          least_effective_share, "a number in [0, 1)");
  require(prior_share >= 0.0 && prior_share < 1.0, "prior_share", prior_share, "a number in [0, 1)");
  require(tempered_share >= 0.0 && tempered_share < 1.0, "tempered_share", tempered_share,
          "a number in [0, 1)");
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
  MeasuredPosterior measured;
  const SearchOptions search = search_options(settings, problem.prior.dimension());
  std::array<Search, 2> searches;
  ReferenceDraws seen;  // by a fit
  for (std::uint32_t k = 0; k < 2; ++k) {
    searches[k] = search_posterior(problem, search, derived(key, k));
    measured.search_beta[k] = searches[k].beta();
    measured.evaluations += searches[k].draws.z.rows();
    seen.append(searches[k].draws, threads);
  }
  if (std::max(measured.search_beta[0], measured.search_beta[1]) < least_beta) {
    take_over(problem, settings, derived(key, 3), measured);
    return measured;
  }

  const auto draw = [&](Index n, std::uint32_t stage) {
    measured.evaluations += n;
    return draw_and_evaluate(problem, measured.reference, n, key, stage, threads, settings.batch_rows);
  };
  ReferenceDraws draws;
  for (std::uint32_t attempt = 0;; ++attempt) {
    measured.reference = reference_of(
        settings, fit_mixture(fit_points(seen, search.target), settings.fit, key, attempt), searches);
    draws = draw((settings.evaluations - measured.evaluations) / 8, attempt);
    const double effective = effective_sample_size(as_span(log_weights(draws)), 1.0);
    if (is_frozen(settings, effective / static_cast<double>(draws.z.rows()), attempt)) {
      break;
    }
    seen.append(draws, threads);
  }
  draws.append(draw(settings.evaluations - measured.evaluations, final_draws_stage), threads);

  const Eigen::VectorXd log_weight = log_weights(draws);
  const ImportanceEstimate estimate = importance_estimate(as_span(log_weight));
  measured.points = from_unbounded(draws.z, problem.prior);
  measured.log_likelihood = draws.log_likelihood;
  measured.weights = normalised_weights(as_span(log_weight));
  measured.evidence = {estimate.log_mean, estimate.standard_error};
  measured.effective_sample_size = estimate.effective_sample_size;
  measured.pareto_shape = estimate.pareto_shape;
  for (std::size_t k = 0; k < 2; ++k) {
    measured.missed_mass[k] = missed_mass(searches[k], draws, measured.weights, estimate.log_mean, threads);
  }
  measured.warnings = warnings_of(measured);
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
