#include "tmcmc/progress.hpp"

#include <algorithm>
#include <limits>
#include <string>

#include "errors/invalid_value.hpp"

namespace tmcmc {

namespace {

void require(bool condition, const std::string& field, const std::string& expected) {
  if (!condition) {
    throw errors::InvalidValue("progress." + field, "", expected);
  }
}

void require_size(std::size_t size, std::size_t expected, const std::string& field) {
  require(size == expected, field, std::to_string(expected) + " entries, not " + std::to_string(size));
}

void require_below(const std::vector<Index>& indices, std::size_t bound, const std::string& field) {
  require(std::all_of(indices.begin(), indices.end(),
                      [bound](Index index) { return index >= 0 && static_cast<std::size_t>(index) < bound; }),
          field, "numbers of chains below " + std::to_string(bound));
}

std::string entry(std::string field, std::size_t index) {
  return field.append("[").append(std::to_string(index)).append("]");
}

void require_points(const State& state, const Prior& prior, const Options& options) {
  const Index n = state.points.rows();
  require(state.points.cols() == prior.dimension(), "state.points",
          "one column for each of the " + std::to_string(prior.dimension()) + " parameters, not " +
              std::to_string(state.points.cols()));
  const bool varies = std::holds_alternative<IndependentDraws>(options.finish) || state.beta == 1.0 ||
                      (options.evaluation_budget > 0 && state.beta > 0.0);
  require(n >= 1 && (varies || n == options.samples), "state.points",
          std::to_string(options.samples) + " rows (options.samples), not " + std::to_string(n));
  require_size(static_cast<std::size_t>(state.log_likelihood.size()), static_cast<std::size_t>(n),
               "state.log_likelihood");
  require((state.log_likelihood.array() < std::numeric_limits<double>::infinity()).all(),
          "state.log_likelihood", "finite numbers or minus infinity");
  for (Index j = 0; j < state.points.cols(); ++j) {
    require((state.points.col(j).array() >= prior.lower()[j]).all() &&
                (state.points.col(j).array() <= prior.upper()[j]).all(),
            "state.points", "points inside the support of the prior");
  }
}

void require_descent(const Progress& progress, Index first_chains) {
  const auto stages = progress.stages.size();
  const Genealogy& genealogy = progress.state.genealogy;
  const auto& influence = progress.bridge.sums().influence;
  require_size(genealogy.parents.size(), stages, "state.genealogy.parents");
  require_size(influence.size(), stages == 0 ? 0 : stages + 1, "bridge.influence");
  if (stages == 0) {
    return;
  }
  require_size(influence.front().size(), static_cast<std::size_t>(first_chains), "bridge.influence[0]");
  require_size(influence.back().size(), static_cast<std::size_t>(genealogy.chains),
               entry("bridge.influence", stages));
  for (std::size_t t = 0; t < stages; ++t) {
    require_size(genealogy.parents[t].size(), influence[t + 1].size(), entry("state.genealogy.parents", t));
    require_below(genealogy.parents[t], influence[t].size(), entry("state.genealogy.parents", t));
  }
}

}  // namespace

void require_valid(const Progress& progress, const Prior& prior, const Options& options) {
  const State& state = progress.state;
  require(state.beta >= 0.0 && state.beta <= 1.0, "state.beta", "a number in [0, 1]");
  require(state.stage >= 0 && state.stage <= options.max_stages, "state.stage",
          "at most options.max_stages = " + std::to_string(options.max_stages) + ", not " +
              std::to_string(state.stage));
  require_size(progress.stages.size(), static_cast<std::size_t>(state.stage), "stages");
  require(state.beta == (progress.stages.empty() ? 0.0 : progress.stages.back().beta), "state.beta",
          "that of the last stage");
  if (std::holds_alternative<IndependentDraws>(options.finish)) {
    require(state.stage == 0 && state.evaluations <= options.evaluation_budget, "state.evaluations",
            "at most options.evaluation_budget = " + std::to_string(options.evaluation_budget) +
                " without a stage");
    require_points(state, prior, options);
    return;
  }
  require(state.evaluations >= options.samples, "state.evaluations",
          "at least options.samples = " + std::to_string(options.samples));
  require_points(state, prior, options);
  require(state.genealogy.chains >= 1 && state.points.rows() % state.genealogy.chains == 0,
          "state.genealogy.chains", "a divisor of the number of points");
  if (options.diagnose) {
    require_descent(progress, options.samples);
  }
}

}  // namespace tmcmc
