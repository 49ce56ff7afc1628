/// \file
/// How a stage moves its samples.
#pragma once

#include <string_view>
#include <variant>

#include "tmcmc/option.hpp"
#include "tmcmc/types.hpp"

namespace tmcmc {

/// Resampling to N starts, a chain from each, and its last state kept (Ching and Chen 2007).
struct ResampleMove {
  /// On the command line and in checkpoints.
  static constexpr std::string_view name = "resample-move";

  /// Metropolis steps of each chain and stage; the least number with mixing_correlation.
  Index steps = 3;
  /// If positive, a stage goes on after `steps` steps until the correlation between the states of
  /// the chains and their starts is at most this in every parameter, or max_steps are done. 0:
  /// `steps` it is.
  double mixing_correlation = 0.0;
  /// Most steps of a stage that goes on.
  Index max_steps = 1000;
};

/// The paper's wording: N times a chain is picked with probability w_i and its current state moved
/// by one step; each updated state is kept. Biased at any N: the probability that a chain is picked
/// k times or more is not proportional to its weight, so that short chains, which have moved
/// little, count too much.
struct GrowingChains {
  /// On the command line and in checkpoints.
  static constexpr std::string_view name = "growing-chains";
};

/// Resampling to M starts, a chain of N/M - 1 steps from each, every state kept, the start included
/// (Dau and Chopin 2022): long chains, and no evaluation thrown away.
struct WasteFree {
  /// On the command line and in checkpoints.
  static constexpr std::string_view name = "waste-free";

  /// M; a divisor of the number of samples.
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
