/// \file
/// Comparison of models by their evidence, from runs that were written as NetCDF (inference_data.hpp).
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "tmcmc/result.hpp"

namespace storage {

/// What a file says of its run.
struct StoredEvidence {
  std::string path;           ///< of the file
  tmcmc::Evidence evidence;   ///< attributes log_evidence and log_evidence_standard_error
  std::string data_checksum;  ///< attribute data_checksum; empty if the run did not know its data
};

/// \throws io::InputError naming file, attribute and what was expected: no NetCDF-4, no log-evidence, or a run that did not reach
///         the posterior.
[[nodiscard]] StoredEvidence read_evidence(const std::filesystem::path& path);

/// Evidences of models for different data cannot be compared.
/// \throws io::InputError naming the first file whose data differ from those of the first one, or are not known.
void require_same_data(std::span<const StoredEvidence> runs);

/// A model among others.
struct ComparedModel {
  double log_evidence;            ///< log P(D | M), natural logarithm
  double log_evidence_error;      ///< its standard error
  double log_bayes_factor;        ///< log P(D | M) - log P(D | best), 0 for the one with the largest evidence
  double log_bayes_factor_error;  ///< standard error, the runs being independent; 0 for the best
  double probability;             ///< P(M | D), among the models compared
  double probability_error;       ///< standard error, to first order in those of the log-evidences
};

/// Posterior probabilities of models, P(M | D) = P(D | M) P(M) / sum (Kass and Raftery 1995).
/// \param evidences  of independent runs, at least one
/// \param prior_probabilities  one a model, positive, in any scale; empty for equal ones
/// \return  one a model, in the order given
/// \throws errors::InvalidValue for evidences that are not finite or probabilities that do not fit.
[[nodiscard]] std::vector<ComparedModel> compare(std::span<const tmcmc::Evidence> evidences,
                                                 std::span<const double> prior_probabilities = {});

}  // namespace storage
