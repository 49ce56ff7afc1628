// Verdicts on claims: each turns when its evidence does.

#include <catch2/catch.hpp>

#include "data/columns.hpp"
#include "errors/invalid_value.hpp"
#include "replication/claims.hpp"

namespace {

using Catch::Matchers::Contains;
using namespace replication;

/// Studies whose p-boxes reach from `low` to `high` in the friction force and hold the stated
/// frequency.
std::vector<StudySummary> studies_with_ends(int enclosing, int missing) {
  std::vector<StudySummary> studies;
  for (int k = 0; k < enclosing + missing; ++k) {
    StudySummary s;
    s.sampler = "A";
    s.iterations = {{10, 45}, {11, 5}};
    s.areas = {0.1, 0.01};
    s.smallest = {0.9, 3.0};
    s.largest = {k < enclosing ? 1.2 : 1.0, 3.2};
    studies.push_back(s);
  }
  return studies;
}

ContrastVerdict contrast(double p, double ratio, bool equivalent, bool different) {
  ContrastVerdict c;
  c.printed = 1.5;
  c.p = {p, 1e-4};
  c.replicated = {ratio, {0.98 * ratio, 1.02 * ratio}, 0.1, equivalent, different};
  return c;
}

}  // namespace

TEST_CASE("the p-boxes hold the stated values in most studies, or do not", "[claims]") {
  const Truth stated;
  const auto most = judge_enclosure(studies_with_ends(3, 1), stated, 0.2);
  CHECK(most.number == "reproduced");
  CHECK(most.claim == Verdict::holds);
  CHECK_THAT(most.evidence, Contains("75 % of the studies") && Contains("P(F_mu > 1.086 N) = 0.2"));
  CHECK(judge_enclosure(studies_with_ends(1, 3), stated, 0.2).number == "not reproduced");
  CHECK(judge_enclosure(studies_with_ends(3, 1), stated, 0.02).claim == Verdict::true_and_uninformative);
  CHECK(judge_enclosure(studies_with_ends(1, 3), stated, 0.02).claim == Verdict::contradicted);
  Truth other = stated;
  other.natural_frequency_hz = 3.3;
  CHECK(judge_enclosure(studies_with_ends(3, 1), other, 0.2).number == "not reproduced");
}

TEST_CASE("a contrast by chance, a real one, and a cause that is none", "[claims]") {
  const auto chance = contrast(0.4, 1.0, true, false);
  const auto real = contrast(0.001, 1.3, false, true);
  CHECK(judge_contrast(chance, "ratio").claim == Verdict::contradicted);
  CHECK(judge_contrast(chance, "ratio").number == "ordinary by chance");
  CHECK(judge_contrast(real, "ratio").claim == Verdict::holds);
  CHECK(judge_contrast(real, "ratio").number == "very unlikely by chance");
  CHECK_THAT(judge_contrast(real, "deviance").evidence,
             Contains("printed deviance 1.5") && Contains("1.3000"));
  CHECK(judge_cause({chance, chance, chance}).claim == Verdict::contradicted);
  CHECK(judge_cause({chance, chance, real}).claim == Verdict::not_supported);
}

TEST_CASE("the most frequent number of iterations is the one of the text, one less, or another", "[claims]") {
  const PrintedColumn nine{"A", {}, {{9, 30}, {11, 20}}};
  const PrintedColumn ten{"A", {}, {{10, 30}, {11, 20}}};
  const PrintedColumn eleven{"B", {}, {{10, 20}, {11, 30}}};
  CHECK(judge_mode({eleven, eleven}).claim == Verdict::holds);
  CHECK(judge_mode({ten, ten}).claim == Verdict::off_by_one);
  CHECK(judge_mode({nine, ten}).claim == Verdict::internally_contradictory);
  const auto judged = judge_mode({ten, eleven});
  CHECK(judged.claim == Verdict::internally_contradictory);
  CHECK_THAT(judged.evidence, Contains("10 (30 of A)") && Contains("11 (30 of B)"));
}

TEST_CASE("a largest number of iterations that most studies exceed", "[claims]") {
  const PrintedColumn ten{"A", {}, {{10, 50}, {11, 0}}};
  const PrintedColumn eleven{"B", {}, {{10, 41}, {11, 9}}};
  const auto judged = judge_maximum(studies_with_ends(4, 0), {ten, eleven});
  CHECK(judged.claim == Verdict::contradicted);
  CHECK(judged.number == "unlikely by chance");  // 0.9^50 = 0.005, but of four studies
  CHECK_THAT(judged.evidence, Contains("100 % of the replicated studies of A"));
  CHECK(judge_maximum(studies_with_ends(4, 0), {eleven, ten}).claim == Verdict::internally_contradictory);
  auto without = studies_with_ends(4, 0);
  for (auto& s : without) s.iterations = {{10, 50}};
  CHECK(judge_maximum(without, {ten, eleven}).claim == Verdict::holds);
  CHECK(judge_maximum(without, {ten, eleven}).number == "ordinary by chance");
}

TEST_CASE("evidence of mixing: iterations by their correlation, variability by the floor", "[claims]") {
  CHECK(judge_iterations_as_evidence({0.06, 0.53}).claim == Verdict::does_not_follow);
  CHECK(judge_iterations_as_evidence({0.6, 0.001}).claim == Verdict::holds);
  CHECK(judge_variability(0.12, 0.0075).claim == Verdict::holds);
  CHECK(judge_variability(0.008, 0.0075).claim == Verdict::not_supported);
}

TEST_CASE("the stated noise levels are tested by chi^2", "[claims]") {
  const auto at = [](double phase, double ratio) {
    return judge_noise(
        audit(test_data::table1(), {.phase_noise_deg = phase, .frequency_ratio_noise = ratio}, 1.0, {}));
  };
  CHECK(at(2.0, 0.01).claim == Verdict::not_rejected);
  CHECK(at(1.0, 0.01).claim == Verdict::contradicted);
  CHECK(at(2.0, 0.003).claim == Verdict::contradicted);
}

TEST_CASE("the stated force is tested by the likelihood ratio", "[claims]") {
  const auto at = [](double force_n) {
    return judge_stated_force(audit(test_data::table1(), {.friction_force_n = force_n}, 1.0, {}));
  };
  CHECK(at(1.086).claim == Verdict::contradicted);
  CHECK(at(0.98).claim == Verdict::not_rejected);
  CHECK(at(3.0).claim == Verdict::contradicted);  // no continuous motion is no agreement either
  CHECK_THAT(at(1.086).evidence,
             Contains("on 10 observations") && Contains("46.2 at 1.086 N (p = 1.3e-06)") &&
                 Contains("0.9815 N; likelihood ratio 30.9") && Contains("F = 18.1, p = 0.0021; if Table 1"));
}

TEST_CASE("each claim has its judge, and other names have none", "[claims]") {
  const auto chance = contrast(0.4, 1.0, true, false);
  const Contrasts contrasts{chance, contrast(0.001, 1.3, false, true), chance};
  const auto studies = studies_with_ends(4, 0);
  const std::vector<PrintedColumn> printed = {{"A", {0.1, 0.01}, {{10, 50}}},
                                              {"B", {0.2, 0.01}, {{10, 45}, {11, 5}}}};
  const Audit of_table1 = audit(test_data::table1(), {}, 1.0, {});
  const ClaimEvidence evidence{studies, printed, contrasts, of_table1, {}, 0.2, {0.06, 0.5}, 0.01};
  const std::vector<Verdict> expected = {
      Verdict::holds,         Verdict::contradicted,    Verdict::holds,
      Verdict::contradicted,  Verdict::not_supported,   Verdict::off_by_one,
      Verdict::contradicted,  Verdict::contradicted,    Verdict::cannot_be_tested,
      Verdict::contradicted,  Verdict::does_not_follow, Verdict::holds,
      Verdict::holds_in_part, Verdict::holds_in_part,   Verdict::not_rejected};
  REQUIRE(claim_ids().size() == expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    CAPTURE(claim_ids()[i]);
    CHECK(judge_claim(claim_ids()[i], evidence).claim == expected[i]);
  }
  CHECK_THROWS_AS(judge_claim("C0", evidence), errors::InvalidValue);
  CHECK_THROWS_AS(judge_claim("", evidence), errors::InvalidValue);
}

TEST_CASE("a contrast needs both samplers", "[claims]") {
  CHECK_THROWS_WITH(contrast_samplers({}, {{"A", {0.1, 0.01}, {{11, 3}}}}, 1), Contains("printed = 1"));
}
