/// \file
/// Options of the Metropolis proposals.
#pragma once

#include <array>
#include <string_view>
#include <type_traits>
#include <variant>

#include "tmcmc/option.hpp"
#include "tmcmc/types.hpp"

namespace tmcmc {

/// The centre m in Eq. 5.
enum class Centre {
  /// Weighted mean, as in Ching and Chen 2007.
  weighted_mean,
  /// Unweighted mean, as Eq. 5 is printed.
  plain_mean
};
constexpr std::array<std::string_view, 2> enumerator_names(std::type_identity<Centre>) {
  return {"weighted-mean", "plain-mean"};
}

/// Coordinates in which proposals are made.
enum class Coordinates {
  /// The parameters themselves; a proposal may fall outside the support of the prior.
  natural,
  /// u = log((x - lower) / (upper - x)) where the prior's support has two bounds, log(x - lower) or
  /// -log(upper - x) where it has one, x itself where it has none; the acceptance ratio includes
  /// the Jacobian, and no proposal falls outside the support.
  unbounded
};
constexpr std::array<std::string_view, 2> enumerator_names(std::type_identity<Coordinates>) {
  return {"natural", "unbounded"};
}

/// A proposal that leaves the tempered posterior invariant; proposals outside the support of the
/// prior are rejected. The defaults are the paper's random walk.
struct MetropolisProposal {
  /// Name on the command line and in checkpoints.
  static constexpr std::string_view name = "reject";

  /// The coordinates in which the proposal is drawn.
  Coordinates coordinates = Coordinates::natural;
  /// A proposal changes a random set of (whitened) coordinates: detail::MetropolisKernel.
  bool random_subsets = false;
  /// Share of the proposals that are drawn from the normal distribution fitted to the population
  /// instead of around the current state: detail::MetropolisKernel.
  double independent_fraction = 0.0;
};

/// A random walk in all parameters; a proposal outside the support of the prior is drawn again
/// until it is inside, without the corresponding correction of the acceptance ratio (published
/// scripts).
struct RedrawnWalk {
  /// Name on the command line and in checkpoints.
  static constexpr std::string_view name = "redraw";

  /// A proposal that is drawn again more often than this ends the run with an error.
  Index max_redraws = 100000;
};

/// Method by which a state is proposed.
using Proposal = std::variant<MetropolisProposal, RedrawnWalk>;

/// Proposals are scaled by this multiple of the population's covariance root (Eq. 5: gamma = 0.2).
struct FixedScale {
  /// Name on the command line and in checkpoints.
  static constexpr std::string_view name = "fixed";

  /// gamma.
  double scale = 0.2;
};

/// Scale 2.38 / sqrt(d), where d is the number of coordinates that a proposal changes (Roberts,
/// Gelman and Gilks 1997).
struct DimensionScale {
  /// Name on the command line and in checkpoints.
  static constexpr std::string_view name = "dimension";
};

/// The scale starts as in DimensionScale; after step k of a stage its logarithm grows by
/// (acceptance rate of the random walks - acceptance) / sqrt(k), and the next stage continues from
/// there (after Betz, Papaioannou and Straub 2016, who adapt after groups of chains). Not for
/// growing chains.
struct TargetAcceptance {
  /// Name on the command line and in checkpoints.
  static constexpr std::string_view name = "target-acceptance";

  /// The target acceptance rate.
  double acceptance = 0.3;
};

/// Scale 1/9 + 8/9 of the acceptance rate of the random walks in the preceding stage (Minson,
/// Simons and Beck 2013); 1 in the first stage.
struct AcceptanceLinked {
  /// Name on the command line and in checkpoints.
  static constexpr std::string_view name = "acceptance-linked";
};

/// Scale of a random walk, as a multiple of the population's covariance root.
using ScaleRule = std::variant<FixedScale, DimensionScale, TargetAcceptance, AcceptanceLinked>;

/// Calls visit(OptionInfo, pointer to the value) for each option of the scale rule.
template <class Rule, class Visit>
void visit_scale_options(Rule& rule, Visit&& visit) {
  using enum OptionGroup;
  visit({"scale_rule", beyond_the_paper, named(), "Scale of the random walks"}, &rule);
  visit({"proposal_scale", paper, positive_number(), "gamma of Eq. 5", "scale_rule", FixedScale::name},
        member_of(std::get_if<FixedScale>(&rule), &FixedScale::scale));
  visit({"target_acceptance",
         beyond_the_paper,
         {.least = 0.0, .most = 1.0, .above_least = true, .below_most = true},
         "Acceptance rate of the random walks that the scale aims at",
         "scale_rule",
         TargetAcceptance::name},
        member_of(std::get_if<TargetAcceptance>(&rule), &TargetAcceptance::acceptance));
}

/// Calls visit(OptionInfo, pointer to the value) for each option of the proposal.
template <class AnyProposal, class Visit>
void visit_proposal_options(AnyProposal& proposal, Visit&& visit) {
  using enum OptionGroup;
  auto* metropolis = std::get_if<MetropolisProposal>(&proposal);
  visit({"boundary", paper, named(), "Proposals outside the prior box"}, &proposal);
  visit({"max_redraws", computation, whole_from(1), "Most times that a proposal is drawn again", "boundary",
         RedrawnWalk::name},
        member_of(std::get_if<RedrawnWalk>(&proposal), &RedrawnWalk::max_redraws));
  visit({"coordinates", beyond_the_paper, named(),
         "Of the proposals: the parameters, or unbounded functions of them", "boundary",
         MetropolisProposal::name},
        member_of(metropolis, &MetropolisProposal::coordinates));
  visit({"random_subsets", beyond_the_paper, named(), "Change random sets of coordinates", "boundary",
         MetropolisProposal::name},
        member_of(metropolis, &MetropolisProposal::random_subsets));
  visit({"independent_fraction",
         beyond_the_paper,
         {.least = 0.0, .most = 1.0},
         "Share of independent proposals",
         "boundary",
         MetropolisProposal::name},
        member_of(metropolis, &MetropolisProposal::independent_fraction));
}

}  // namespace tmcmc
