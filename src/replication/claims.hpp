/// \file
/// Verdicts on the claims C1 to C9 of the paper (data/published/claims.csv), each with its evidence.
#pragma once

#include <string>
#include <vector>

#include "replication/audit.hpp"
#include "replication/published.hpp"

namespace replication {

/// Whether the printed number behind a claim comes out again, and whether the claim is supported, are two things.
struct JudgedClaim {
  std::string number;    ///< name_of(Typicality), or why there is no such verdict
  Verdict claim;         ///< on the claim itself
  std::string evidence;  ///< the statistic behind it, as a sentence
};

/// The comparisons of the two samplers behind C2 to C5.
struct Contrasts {
  ContrastVerdict friction_force;     ///< ratio of areas, second sampler over first
  ContrastVerdict natural_frequency;  ///< likewise
  ContrastVerdict iterations;         ///< two-sample deviance of the counts
};

/// \param areas  of friction force and natural frequency (parameters 0 and 1) of both samplers, as printed
/// \param counts  of the first and the second sampler, as printed
/// \param seed  of the bootstrap
/// \throws errors::InvalidValue unless there are counts of two samplers and both areas of each, and studies of both.
[[nodiscard]] Contrasts contrast_samplers(const std::vector<StudySummary>& studies,
                                          const std::vector<PrintedArea>& areas,
                                          const std::vector<PrintedCounts>& counts, std::uint64_t seed,
                                          const TableDraws& draws = {});

/// C1: the share of studies whose p-boxes hold both stated values; and how likely the posterior makes the stated force.
/// \param exceedance  P(F_mu > stated force) of the exact posterior
[[nodiscard]] JudgedClaim judge_enclosure(const std::vector<StudySummary>& studies, const Truth& stated,
                                          double exceedance);

/// C2 to C4: a contrast of the samplers.
/// \param what  the printed statistic: "ratio" or "deviance"
[[nodiscard]] JudgedClaim judge_contrast(const ContrastVerdict& contrast, const std::string& what);

/// C5: a cause of worse mixing must make some quantity worse.
[[nodiscard]] JudgedClaim judge_cause(const Contrasts& contrasts);

/// C6: whether the most frequent number of iterations in Table 4 is the 11 of the text.
[[nodiscard]] JudgedClaim judge_mode(const std::vector<PrintedCounts>& printed);

/// C7: the likelihood-ratio test of the stated force, with the stated noise.
/// \param audit  whose first test of the friction force is that of the stated one
[[nodiscard]] JudgedClaim judge_stated_force(const Audit& audit);

/// Everything that the claims are judged by.
struct ClaimEvidence {
  const std::vector<StudySummary>& studies;  ///< replicated studies of both samplers
  const std::vector<PrintedCounts>& counts;  ///< Table 4 as printed
  const Contrasts& contrasts;                ///< verdicts on the differences of the samplers
  const Audit& audit;                        ///< of the observations of Table 1
  Truth stated;                              ///< values that the paper states
  double exceedance = 0.0;                   ///< P(F_mu > stated force) of the exact posterior
};

/// \param id  "C1" to "C9"
/// \throws errors::InvalidValue for another one.
[[nodiscard]] JudgedClaim judge_claim(const std::string& id, const ClaimEvidence& evidence);

}  // namespace replication
