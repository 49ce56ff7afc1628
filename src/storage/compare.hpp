/// \file
/// Comparison of models by their evidence, from runs that were written as NetCDF
/// (inference_data.hpp).
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "tmcmc/result.hpp"

namespace storage {

/// The evidence and data of a run, as stored in its file.
struct StoredEvidence {
  /// Path of the file.
  std::string path;
  /// The attributes log_evidence and log_evidence_standard_error.
  tmcmc::Evidence evidence;
  /// Attribute data_checksum; empty if the file does not record the data.
  std::string data_checksum;
};

/// Reads the evidence from a file.
/// \throws io::InputError naming file, attribute and what was expected, if the file is not
///         NetCDF-4, has no log-evidence, or stores a run that did not reach the posterior.
[[nodiscard]] StoredEvidence read_evidence(const std::filesystem::path& path);

/// Requires that all runs used the same data: evidences of models for different data cannot be
/// compared.
/// \throws io::InputError naming the first file whose data are unknown or differ from the data of
///         the first file.
void require_same_data(std::span<const StoredEvidence> runs);

/// One of the models compared.
struct ComparedModel {
  /// log P(D | M), natural logarithm.
  double log_evidence;
  /// Standard error of log_evidence.
  double log_evidence_error;
  /// log P(D | M) - log P(D | best), 0 for the one with the largest evidence.
  double log_bayes_factor;
  /// Standard error for independent runs; 0 for the best.
  double log_bayes_factor_error;
  /// P(M | D), among the models compared.
  double probability;
  /// Standard error, to first order in the log-evidence errors.
  double probability_error;
};

/// Posterior probabilities of models, P(M | D) = P(D | M) P(M) / sum (Kass and Raftery 1995).
/// \param evidences  evidences from independent runs, at least one
/// \param prior_probabilities  one per model, positive, in any scale; empty for equal probabilities
/// \return  one entry per model, in the order given
/// \throws errors::InvalidValue for evidences that are not finite or for invalid prior
///         probabilities.
[[nodiscard]] std::vector<ComparedModel> compare(std::span<const tmcmc::Evidence> evidences,
                                                 std::span<const double> prior_probabilities = {});

}  // namespace storage
