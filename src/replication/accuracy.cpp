#include "replication/accuracy.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "errors/invalid_value.hpp"
#include "statistics/summary.hpp"
#include "tmcmc/weighted_samples.hpp"

namespace replication {

using statistics::root_mean_square;

namespace {

constexpr tmcmc::Index resampled_points = 1000;  // as the paper's runs have
constexpr std::uint32_t resamplings = 10;

}  // namespace

std::vector<Eigen::VectorXd> paper_sized_areas(const std::vector<Run>& runs, std::uint32_t arm_index,
                                               const StudyOptions& options) {
  const bool is_weighted = std::any_of(runs.begin(), runs.end(),
                                       [](const Run& run) { return run.result.measurement.has_value(); });
  if (!is_weighted) {
    return {pbox_areas(runs, options.threads)};
  }
  std::vector<Eigen::VectorXd> areas;
  std::vector<Run> drawn(runs.size());
  for (std::uint32_t repeat = 0; repeat < resamplings; ++repeat) {
    for (std::size_t i = 0; i < runs.size(); ++i) {
      const tmcmc::StreamKey key{options.seed, options.study * resamplings + repeat, arm_index,
                                 static_cast<std::uint32_t>(i)};
      drawn[i].result.final.points =
          tmcmc::equally_weighted(runs[i].result, resampled_points, key, tmcmc::Resampling::multinomial);
      drawn[i].result.weights.setOnes(resampled_points);
    }
    areas.push_back(pbox_areas(drawn, options.threads));
  }
  return areas;
}

KnownPosterior known_posterior(const estimation::ExactPosterior& exact) {
  KnownPosterior truth;
  truth.mean.resize(friction::parameter_count);
  truth.standard_deviation.resize(friction::parameter_count);
  for (int p = 0; p < friction::parameter_count; ++p) {
    const auto& marginal = exact.marginal(static_cast<friction::Parameter>(p));
    truth.mean[p] = marginal.mean();
    truth.standard_deviation[p] = marginal.standard_deviation();
  }
  truth.log_evidence = exact.log_evidence();
  return truth;
}

Accuracy accuracy(const std::vector<Run>& runs, const KnownPosterior& truth) {
  const Eigen::Index d = truth.mean.size();
  if (runs.size() < 2 ||
      std::any_of(runs.begin(), runs.end(), [d](const Run& run) { return run.mean.size() != d; })) {
    throw errors::InvalidValue("runs", "", "at least two, of as many parameters as are known");
  }
  Accuracy result;
  const double count = static_cast<double>(runs.size());
  std::vector<double> bridge, weights, errors;
  for (const Run& run : runs) {
    const tmcmc::Result& r = run.result;
    const bool diagnosed = r.diagnostics.effective_sample_size.size() > 0;
    result.evaluations += static_cast<double>(r.final.evaluations) / count;
    result.most_evaluations = std::max(result.most_evaluations, r.final.evaluations);
    result.stages += static_cast<double>(r.stages.size()) / count;
    result.warned += r.diagnostics.warnings.empty() ? 0.0 : 1.0 / count;
    weights.push_back(r.final.log_evidence - truth.log_evidence);
    bridge.push_back(diagnosed ? r.evidence.log_evidence - truth.log_evidence : weights.back());
    errors.push_back(diagnosed ? r.evidence.standard_error : std::numeric_limits<double>::quiet_NaN());
  }
  result.evidence_bias = moments(bridge).mean;
  result.evidence_rms = root_mean_square(bridge);
  result.weight_evidence_rms = root_mean_square(weights);
  result.standard_error_rms = root_mean_square(errors);
  result.mean_bias.resize(d);
  result.mean_spread.resize(d);
  result.effective_size.resize(d);
  for (Eigen::Index j = 0; j < d; ++j) {
    std::vector<double> means;
    for (const Run& run : runs) {
      means.push_back((run.mean[j] - truth.mean[j]) / truth.standard_deviation[j]);
    }
    const Moments m = moments(means);
    result.mean_bias[j] = m.mean;
    result.mean_spread[j] = m.standard_deviation;
    result.effective_size[j] = 1.0 / (m.mean * m.mean + m.standard_deviation * m.standard_deviation);
  }
  return result;
}

std::vector<Configuration> configurations(const tmcmc::Options& published) {
  using tmcmc::Resampling;
  std::vector<Configuration> list;
  tmcmc::Options start = published;
  start.diagnose = true;
  start.criterion = tmcmc::effective_sample_size_rule(0.5);
  start.criterion.counted = published.criterion.counted;
  const auto add = [&](const std::string& family, const std::string& value, auto change) {
    list.push_back({family, value, start});
    change(list.back().options);
  };

  add("published", "N = 1000, N/2, 3 steps", [](auto&) {});
  for (const auto& [value, fraction] :
       {std::pair{"9 N/10", 0.9}, {"3 N/4", 0.75}, {"N/4", 0.25}, {"N/10", 0.1}}) {
    add("criterion", value, [f = fraction](auto& o) { o.criterion.rule = tmcmc::EffectiveSampleSize{f}; });
  }
  for (const tmcmc::Index n : {300, 3000, 10000}) {
    add("samples", std::to_string(n), [n](auto& o) { o.samples = n; });
  }
  for (const tmcmc::Index steps : {1, 2, 5, 10, 20}) {
    add("steps", std::to_string(steps), [steps](auto& o) { o.move = tmcmc::ResampleMove{.steps = steps}; });
  }
  add("steps", "until correlation 0.9",
      [](auto& o) { o.move = tmcmc::ResampleMove{.mixing_correlation = 0.9}; });
  for (const auto& [value, scale] : {std::pair{"0.1", 0.1}, {"0.4", 0.4}, {"0.8", 0.8}}) {
    add("scale", value, [s = scale](auto& o) { o.scale_rule = tmcmc::FixedScale{s}; });
  }
  add("scale", "2.38/sqrt(d)", [](auto& o) { o.scale_rule = tmcmc::DimensionScale{}; });
  add("scale", "acceptance 0.3", [](auto& o) { o.scale_rule = tmcmc::TargetAcceptance{}; });
  add("scale", "1/9 + 8/9 acceptance", [](auto& o) { o.scale_rule = tmcmc::AcceptanceLinked{}; });
  add("resampling", "residual", [](auto& o) { o.resampling = Resampling::residual; });
  add("resampling", "stratified", [](auto& o) { o.resampling = Resampling::stratified; });
  add("resampling", "systematic", [](auto& o) { o.resampling = Resampling::systematic; });

  // From here on the moves are improved one by one, each change on top of the previous ones.
  start.criterion.counted = tmcmc::Counted::feasible;
  start.resampling = Resampling::systematic;
  start.scale_rule = tmcmc::DimensionScale{};
  tmcmc::MetropolisProposal proposal{.coordinates = tmcmc::Coordinates::unbounded};
  start.proposal = proposal;
  add("moves", "unbounded, 2.38/sqrt(d)", [](auto&) {});
  proposal.random_subsets = true;
  start.proposal = proposal;
  add("moves", "+ random subsets", [](auto&) {});
  proposal.independent_fraction = 0.5;
  start.proposal = proposal;
  add("moves", "+ independent proposals", [](auto&) {});
  start.samples = 3200;
  for (const tmcmc::Index chains : {8, 16, 32, 64, 128}) {
    add("chains", "waste-free, " + std::to_string(chains) + " chains",
        [chains](auto& o) { o.move = tmcmc::WasteFree{chains}; });
  }
  for (const tmcmc::Index budget : {4000, 8000, 16000, 31000, 62000, 124000}) {
    list.push_back(
        {"better moves", std::to_string(budget) + " evaluations", tmcmc::recommended_moves(budget)});
  }
  // Last, the recommended options under either rule of the paper.
  for (const auto& [family, criterion] :
       {std::pair{"recommended", tmcmc::effective_sample_size_rule(0.5)},
        {"recommended CoV = 1", tmcmc::coefficient_of_variation_rule(1.0)}}) {
    for (const tmcmc::Index budget : {4000, 8000, 16000, 31000}) {
      list.push_back({family, std::to_string(budget) + " evaluations", tmcmc::recommended_options(budget)});
      list.back().options.criterion = criterion;
    }
  }
  for (Configuration& configuration : list) {
    configuration.options.infeasible_level = published.infeasible_level;
  }
  return list;
}

}  // namespace replication
