#include "tmcmc/options.hpp"

#include <string>
#include <type_traits>

#include "errors/invalid_value.hpp"
#include "tmcmc/option_table.hpp"

namespace tmcmc {

namespace {

void require(bool condition, std::string_view name, const Options& options, const std::string& expected) {
  if (!condition) {
    throw errors::InvalidValue("options." + std::string(name), option_value(options, name).value_or(""),
                               expected);
  }
}

void require_ranges(const Options& options) {
  std::size_t row = 0;
  visit_options(options, [&]<class T>(const OptionInfo& info, const T* value) {
    const std::string& expected = option_table()[row++].expected;
    if constexpr (std::is_arithmetic_v<T>) {
      require(value == nullptr || std::is_same_v<T, bool> || info.range.admits(static_cast<double>(*value)),
              info.name, options, expected);
    }
  });
}

}  // namespace

void Options::validate() const {
  require_ranges(*this);
  const bool grows = std::holds_alternative<GrowingChains>(move);
  if (const auto* waste_free = std::get_if<WasteFree>(&move)) {
    require(waste_free->chains < samples && samples % waste_free->chains == 0, "chains", *this,
            "a divisor of the number of samples, less than it");
  }
  if (const auto* resample_move = std::get_if<ResampleMove>(&move)) {
    require(resample_move->mixing_correlation == 0.0 || resample_move->max_steps >= resample_move->steps,
            "max_move_steps", *this,
            "at least the least number of steps, " + std::to_string(resample_move->steps));
  }
  require(!grows || !std::holds_alternative<TargetAcceptance>(scale_rule), "scale_rule", *this,
          "another rule with growing chains");
  require(!grows || !cross_fit, "cross_fit", *this, "no with growing chains");
  require(!grows || std::holds_alternative<NoFinish>(finish), "finish", *this, "none with growing chains");
  if (evaluation_budget > 0) {
    require(evaluation_budget > samples, "evaluation_budget", *this,
            "more than the number of samples, " + std::to_string(samples));
    require(!grows, "evaluation_budget", *this, "0 with growing chains");
  }
  if (const auto* draws = std::get_if<IndependentDraws>(&finish)) {
    require(evaluation_budget >= fewest_evaluations_of_independent_draws, "evaluation_budget", *this,
            "at least " + std::to_string(fewest_evaluations_of_independent_draws) +
                " with the finish independent");
    require(draws->fit.degrees_of_freedom % 2 == 0, "mixture_degrees_of_freedom", *this, "an even number");
  }
}

Options recommended_moves(Index evaluations, Index chains) {
  if (chains < 1) {
    throw errors::InvalidValue("options.chains", chains, "at least 1");
  }
  if (evaluations < 500 || evaluations / 26 < chains) {
    throw errors::InvalidValue("options.evaluation_budget", evaluations,
                               "at least 500 and 26 a chain for the recommended options");
  }
  Options options;
  options.samples = evaluations / (13 * chains) * chains;
  options.criterion = effective_sample_size_rule(0.5);
  options.resampling = Resampling::systematic;
  options.move = WasteFree{.chains = chains};
  options.scale_rule = DimensionScale{};
  options.proposal = MetropolisProposal{
      .coordinates = Coordinates::unbounded, .random_subsets = true, .independent_fraction = 0.5};
  options.evaluation_budget = evaluations;
  return options;
}

Options recommended_options(Index evaluations, Index chains) {
  constexpr Index fewest_measured = 3000;
  Options options = recommended_moves(evaluations, chains);
  if (evaluations >= fewest_measured) {
    options.finish = IndependentDraws{};
  }
  return options;
}

}  // namespace tmcmc
