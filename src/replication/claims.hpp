/// \file
/// Verdicts on the claims C1 to C15 of the paper (data/published/claims.csv), each with its
/// evidence.
#pragma once

#include <string>
#include <vector>

#include "replication/audit.hpp"
#include "replication/published.hpp"
#include "replication/run_worth.hpp"

namespace replication {

/// A judged claim. How likely the printed number behind the claim is, and whether the claim is
/// borne out, are two separate questions.
struct JudgedClaim {
  /// name_of(Chance), or the reason why none applies.
  std::string number;
  /// Verdict on the claim itself.
  Verdict claim;
  /// The statistic behind the verdict, as a sentence.
  std::string evidence;
};

/// The comparisons of the two samplers behind C2 to C5.
struct Contrasts {
  /// Ratio of areas, second sampler over first.
  ContrastVerdict friction_force;
  /// Ratio of areas, second sampler over first.
  ContrastVerdict natural_frequency;
  /// Two-sample deviance of the counts.
  ContrastVerdict iterations;
};

/// \param printed  columns of the first and the second sampler
/// \param seed  seed of the bootstrap
/// \throws errors::InvalidValue unless there are two columns, and studies of both samplers.
[[nodiscard]] Contrasts contrast_samplers(const std::vector<StudySummary>& studies,
                                          const std::vector<PrintedColumn>& printed, std::uint64_t seed,
                                          const TableDraws& draws = {});

/// C1: the share of studies whose p-boxes contain both stated values, and the posterior probability
/// of the stated force. Where nearly every study contains a value that the posterior puts beyond
/// its central 95 %, the claim is true whatever the samplers do.
/// \param exceedance  P(F_mu > stated force) of the exact posterior
[[nodiscard]] JudgedClaim judge_enclosure(const std::vector<StudySummary>& studies, const Truth& stated,
                                          double exceedance);

/// C2 to C4: a contrast of the samplers.
/// \param what  the printed statistic: "ratio" or "deviance"
[[nodiscard]] JudgedClaim judge_contrast(const ContrastVerdict& contrast, const std::string& what);

/// C5: a cause of worse mixing must make at least one quantity worse.
[[nodiscard]] JudgedClaim judge_cause(const Contrasts& contrasts);

/// C6: whether the most frequent number of iterations in Table 4 is the 11 of the text, or the 10
/// transitions after beta_0.
[[nodiscard]] JudgedClaim judge_mode(const std::vector<PrintedColumn>& printed);

/// C7: the likelihood-ratio test of the stated force, with the stated noise.
/// \param audit  audit whose first test of the friction force is the test of the stated force
[[nodiscard]] JudgedClaim judge_stated_force(const Audit& audit);

/// C10: whether runs of the first sampler take no more iterations than printed.
[[nodiscard]] JudgedClaim judge_maximum(const std::vector<StudySummary>& studies,
                                        const std::vector<PrintedColumn>& printed);

/// C11: whether the runs with more iterations are also the runs with a larger error.
[[nodiscard]] JudgedClaim judge_iterations_as_evidence(const RankCorrelation& correlation);

/// C12: whether runs vary more than independent draws from the posterior would.
/// \param area, floor  median p-box areas of the friction force, N: over the studies, and of
///        independent draws
[[nodiscard]] JudgedClaim judge_variability(double area, double floor);

/// C15: chi^2 of the observations with the stated noise levels.
[[nodiscard]] JudgedClaim judge_noise(const Audit& audit);

/// The evidence by which the claims are judged.
struct ClaimEvidence {
  /// Replicated studies of both samplers.
  const std::vector<StudySummary>& studies;
  /// Tables 3 and 4 as printed.
  const std::vector<PrintedColumn>& printed;
  /// Verdicts on the differences of the samplers.
  const Contrasts& contrasts;
  /// Audit of Table 1, with the exact phase and limit.
  const Audit& audit;
  /// Values stated in the paper.
  Truth stated;
  /// P(F_mu > stated force) of the exact posterior.
  double exceedance = 0.0;
  /// Over runs: iterations against the distance of the mean from the exact mean.
  RankCorrelation iterations_and_error;
  /// Median p-box area of independent draws, N.
  double floor_n = 0.0;
};

/// The identifiers "C1" to "C15", in this order.
[[nodiscard]] const std::vector<std::string>& claim_ids();

/// \param id  one of claim_ids()
/// \throws errors::InvalidValue for any other id.
[[nodiscard]] JudgedClaim judge_claim(const std::string& id, const ClaimEvidence& evidence);

/// A number behind the verdicts.
struct Statistic {
  /// Name of the quantity.
  std::string quantity;
  /// Value of the quantity.
  double value = 0.0;
  /// Monte Carlo standard error; NaN where there is none.
  double standard_error = 0.0;
};

/// The numbers on which the evidence and the report are based, apart from the contrasts.
/// \param joint  tests of the printed tables as a whole
/// \param exact_mean, exact_sd  exact mean and standard deviation of the friction force, N
[[nodiscard]] std::vector<Statistic> claim_statistics(const ClaimEvidence& evidence, const JointTests& joint,
                                                      double exact_mean, double exact_sd);

}  // namespace replication
