// Verdicts on claims: each turns when its evidence does.

#include <catch2/catch.hpp>

#include "data/columns.hpp"
#include "errors/invalid_value.hpp"
#include "replication/claims.hpp"

namespace {

using Catch::Matchers::Contains;
using namespace replication;

/// Studies whose p-boxes reach from `low` to `high` in the friction force and hold the stated frequency.
std::vector<StudySummary> studies_with_ends(int enclosing, int missing) {
  std::vector<StudySummary> studies;
  for (int k = 0; k < enclosing + missing; ++k) {
    StudySummary s;
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
  CHECK(most.claim == Verdict::reproduced);
  CHECK_THAT(most.evidence, Contains("75 % of the studies") && Contains("P(F_mu > 1.086 N) = 0.2"));
  CHECK(judge_enclosure(studies_with_ends(1, 3), stated, 0.2).number == "not reproduced");
  CHECK(judge_enclosure(studies_with_ends(3, 1), stated, 0.02).claim == Verdict::not_supported);
  Truth other = stated;
  other.natural_frequency_hz = 3.3;
  CHECK(judge_enclosure(studies_with_ends(3, 1), other, 0.2).number == "not reproduced");
}

TEST_CASE("a contrast by chance, a real one, and a cause that is none", "[claims]") {
  const auto chance = contrast(0.4, 1.0, true, false);
  const auto real = contrast(0.001, 1.3, false, true);
  CHECK(judge_contrast(chance, "ratio").claim == Verdict::consistent_with_chance);
  CHECK(judge_contrast(real, "ratio").claim == Verdict::reproduced);
  CHECK_THAT(judge_contrast(real, "deviance").evidence,
             Contains("printed deviance 1.5") && Contains("1.300"));
  CHECK(judge_cause({chance, chance, chance}).claim == Verdict::contradicted);
  CHECK(judge_cause({chance, chance, real}).claim == Verdict::not_supported);
}

TEST_CASE("the most frequent number of iterations is the one of the text, or is not", "[claims]") {
  const PrintedCounts ten{"A", {{10, 30}, {11, 20}}};
  const PrintedCounts eleven{"B", {{10, 20}, {11, 30}}};
  CHECK(judge_mode({eleven, eleven}).claim == Verdict::reproduced);
  const auto judged = judge_mode({ten, eleven});
  CHECK(judged.claim == Verdict::internally_contradictory);
  CHECK_THAT(judged.evidence, Contains("10 (30 of A)") && Contains("11 (30 of B)"));
}

TEST_CASE("the stated force is tested by the likelihood ratio", "[claims]") {
  const auto at = [](double force_n) {
    return judge_stated_force(audit(test_data::table1(), {.friction_force_n = force_n}, 1.0, {}));
  };
  CHECK(at(1.086).claim == Verdict::contradicted);
  CHECK(at(0.98).claim == Verdict::reproduced);
  CHECK(at(3.0).claim == Verdict::contradicted);  // no continuous motion is no agreement either
  CHECK_THAT(at(1.086).evidence, Contains("on 10 observations"));
}

TEST_CASE("each claim has its judge, and other names have none", "[claims]") {
  const auto chance = contrast(0.4, 1.0, true, false);
  const Contrasts contrasts{chance, contrast(0.001, 1.3, false, true), chance};
  const auto studies = studies_with_ends(1, 0);
  const std::vector<PrintedCounts> counts = {{"A", {{11, 3}}}, {"B", {{11, 3}}}};
  const Audit of_table1 = audit(test_data::table1(), {}, 1.0, {});
  const ClaimEvidence evidence{studies, counts, contrasts, of_table1, {}, 0.2};
  const std::vector<Verdict> expected = {Verdict::reproduced,      Verdict::consistent_with_chance,
                                         Verdict::reproduced,      Verdict::consistent_with_chance,
                                         Verdict::not_supported,   Verdict::reproduced,
                                         Verdict::contradicted,    Verdict::contradicted,
                                         Verdict::cannot_be_tested};
  for (std::size_t i = 0; i < expected.size(); ++i) {
    std::string id = std::to_string(i + 1);
    id.insert(id.begin(), 'C');
    CAPTURE(id);
    CHECK(judge_claim(id, evidence).claim == expected[i]);
  }
  CHECK_THROWS_AS(judge_claim("C0", evidence), errors::InvalidValue);
  CHECK_THROWS_AS(judge_claim("", evidence), errors::InvalidValue);
}

TEST_CASE("a contrast needs both samplers and all four areas", "[claims]") {
  const std::vector<PrintedCounts> counts = {{"A", {{11, 3}}}, {"B", {{11, 3}}}};
  CHECK_THROWS_WITH(contrast_samplers({}, {}, {counts[0]}, 1), Contains("counts = 1"));
  CHECK_THROWS_WITH(contrast_samplers({}, {{"A", 0, "0.1"}, {"A", 1, "0.1"}, {"B", 1, "0.2"}}, counts, 1),
                    Contains("areas = B"));
}
