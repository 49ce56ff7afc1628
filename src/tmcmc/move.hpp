/// \file
/// How a stage moves its samples.
#pragma once

#include <string_view>
#include <variant>

#include "tmcmc/option.hpp"
#include "tmcmc/types.hpp"

namespace tmcmc {

/// Resampling to N starts, then a chain from each, of which only the last state is kept (Ching and
/// Chen 2007).
struct ResampleMove {
  /// Name on the command line and in checkpoints.
  static constexpr std::string_view name = "resample-move";

  /// Metropolis steps of each chain per stage; with mixing_correlation the smallest number of
  /// steps.
  Index steps = 3;
  /// If positive, a stage continues after `steps` steps until the correlation between the states of
  /// the chains and their starts is at most this value in every parameter, or until max_steps steps
  /// are done. If 0, the stage takes `steps` steps.
  double mixing_correlation = 0.0;
  /// Largest number of steps of a stage that continues.
  Index max_steps = 1000;
};

/// The paper's wording: N times a chain is picked with probability w_i and its current state is
/// moved by one step; each updated state is kept. Biased for any N: the probability that a chain is
/// picked k times or more is not proportional to its weight, so that short chains, which have moved
/// little, count too much.
struct GrowingChains {
  /// Name on the command line and in checkpoints.
  static constexpr std::string_view name = "growing-chains";
};

/// Resampling to M starts, then a chain of N/M - 1 steps from each; every state is kept, including
/// the start (Dau and Chopin 2022). The chains are long, and no evaluation is thrown away.
struct WasteFree {
  /// Name on the command line and in checkpoints.
  static constexpr std::string_view name = "waste-free";

  /// Number of chains M; a divisor of the number of samples.
  Index chains = 50;
};

/// How a stage turns weighted samples into equally weighted ones.
using Move = std::variant<ResampleMove, GrowingChains, WasteFree>;

/// Calls visit(OptionInfo, pointer to the value) for each option of the move.
template <class AnyMove, class Visit>
void visit_move_options(AnyMove& move, Visit&& visit) {
  using enum OptionGroup;
  auto* resample_move = std::get_if<ResampleMove>(&move);
  auto* waste_free = std::get_if<WasteFree>(&move);
  const bool until_mixed = resample_move != nullptr && resample_move->mixing_correlation > 0.0;
  visit({"move", paper, named(), "How a stage moves its samples"}, &move);
  visit({"move_steps", paper, whole_from(1), "Metropolis steps of each chain and stage", "move",
         ResampleMove::name},
        member_of(resample_move, &ResampleMove::steps));
  visit({"mixing_correlation",
         beyond_the_paper,
         {.least = 0.0, .most = 1.0, .below_most = true},
         "Go on moving until states and starts correlate by at most this; 0: the steps are fixed",
         "move",
         ResampleMove::name},
        member_of(resample_move, &ResampleMove::mixing_correlation));
  visit({"max_move_steps", beyond_the_paper, whole_from(1),
         "Most steps of a stage that goes on until it has mixed", "mixing_correlation"},
        member_of(until_mixed ? resample_move : nullptr, &ResampleMove::max_steps));
  visit({"chains", beyond_the_paper, whole_from(1), "M, the number of chains of waste-free", "move",
         WasteFree::name},
        member_of(waste_free, &WasteFree::chains));
}

}  // namespace tmcmc
