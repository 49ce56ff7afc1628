/// \file
/// Runs of every kind of option, and a comparison of results to the last bit.
#pragma once

#include <catch2/catch.hpp>
#include <string>
#include <utility>
#include <vector>

#include "tmcmc/problems.hpp"

namespace resumable {

/// One of each: moves, resampling, scale rules, stages that go on until they have mixed,
/// cross-fitting, budgets.
inline std::vector<std::pair<std::string, tmcmc::Options>> every_kind() {
  using tmcmc::Resampling;
  tmcmc::Options paper;
  paper.samples = 150;
  paper.scale_rule = tmcmc::FixedScale{0.8};
  std::vector<std::pair<std::string, tmcmc::Options>> kinds = {{"paper", paper}};
  const auto add = [&](const std::string& name, auto change) {
    kinds.emplace_back(name, paper);
    change(kinds.back().second);
  };
  add("redraw", [](auto& o) { o.proposal = tmcmc::RedrawnWalk{}; });
  add("growing chains", [](auto& o) { o.move = tmcmc::GrowingChains{}; });
  add("residual", [](auto& o) { o.resampling = Resampling::residual; });
  add("stratified", [](auto& o) { o.resampling = Resampling::stratified; });
  add("systematic", [](auto& o) { o.resampling = Resampling::systematic; });
  add("dimension", [](auto& o) { o.scale_rule = tmcmc::DimensionScale{}; });
  add("target acceptance", [](auto& o) { o.scale_rule = tmcmc::TargetAcceptance{}; });
  add("acceptance-linked", [](auto& o) { o.scale_rule = tmcmc::AcceptanceLinked{}; });
  add("effective sample size", [](auto& o) { o.criterion = tmcmc::effective_sample_size_rule(0.5); });
  add("mixing", [](auto& o) { o.move = tmcmc::ResampleMove{.mixing_correlation = 0.3}; });
  add("mixing, budget", [](auto& o) {
    o.move = tmcmc::ResampleMove{.mixing_correlation = 0.3};
    o.evaluation_budget = 9000;
  });
  add("unbounded, subsets, independent, cross-fit", [](auto& o) {
    o.proposal = tmcmc::MetropolisProposal{tmcmc::Coordinates::unbounded, true, 0.5};
    o.cross_fit = true;
  });
  add("waste-free, adapted scale", [](auto& o) {
    o.move = tmcmc::WasteFree{15};
    o.scale_rule = tmcmc::TargetAcceptance{};
  });
  add("not diagnosed", [](auto& o) { o.diagnose = false; });
  add("budget that ends early", [](auto& o) { o.evaluation_budget = 1000; });
  kinds.emplace_back("recommended", tmcmc::recommended_moves(2600));
  return kinds;
}

inline std::vector<double> numbers(const tmcmc::StageRecord& record) {
  const auto& [stage, beta, step, effective, variation, increment, acceptance, feasible, distinct,
               evaluations, redraws, steps, scale, drift, transition] = record;
  return {static_cast<double>(stage),
          beta,
          step,
          effective,
          variation,
          increment,
          acceptance,
          static_cast<double>(feasible),
          static_cast<double>(distinct),
          static_cast<double>(evaluations),
          static_cast<double>(redraws),
          static_cast<double>(steps),
          scale,
          drift,
          static_cast<double>(transition)};
}

inline void check_same_bits(const tmcmc::Result& a, const tmcmc::Result& b) {
  CHECK((a.final.points == b.final.points));
  CHECK((a.final.log_likelihood == b.final.log_likelihood));
  CHECK(a.final.beta == b.final.beta);
  CHECK(a.final.log_evidence == b.final.log_evidence);
  CHECK(a.final.stage == b.final.stage);
  CHECK(a.final.evaluations == b.final.evaluations);
  CHECK(a.final.proposal_scale == b.final.proposal_scale);
  CHECK(a.final.genealogy.chains == b.final.genealogy.chains);
  CHECK(a.final.genealogy.parents == b.final.genealogy.parents);
  REQUIRE(a.stages.size() == b.stages.size());
  for (std::size_t s = 0; s < a.stages.size(); ++s) {
    CHECK(numbers(a.stages[s]) == numbers(b.stages[s]));
  }
  CHECK(a.stop == b.stop);
  CHECK(a.evidence.log_evidence == b.evidence.log_evidence);
  CHECK(a.evidence.standard_error == b.evidence.standard_error);
  CHECK(a.diagnostics.effective_sample_size.size() == b.diagnostics.effective_sample_size.size());
  CHECK((a.diagnostics.effective_sample_size.array() == b.diagnostics.effective_sample_size.array()).all());
  REQUIRE(a.diagnostics.warnings.size() == b.diagnostics.warnings.size());
  for (std::size_t w = 0; w < a.diagnostics.warnings.size(); ++w) {
    CHECK(a.diagnostics.warnings[w].kind == b.diagnostics.warnings[w].kind);
    CHECK(a.diagnostics.warnings[w].message == b.diagnostics.warnings[w].message);
  }
}

/// A run, and what it carried from each stage to the next.
struct Whole {
  tmcmc::Result result;
  std::vector<tmcmc::Progress> progress;
};

inline Whole run_whole(const tmcmc::Options& options, const tmcmc::StreamKey& key = {.seed = 5}) {
  Whole whole;
  whole.result = tmcmc::run(problems::ridge(), options, key,
                            [&](const tmcmc::Progress& progress) { whole.progress.push_back(progress); });
  return whole;
}

}  // namespace resumable
