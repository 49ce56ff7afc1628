/// \file
/// Report of own_model on its runs.
#pragma once

#include <string>
#include <vector>

#include "command_line/report.hpp"
#include "own_models.hpp"
#include "statistics/posterior_summary.hpp"
#include "tmcmc/sampler.hpp"

namespace examples {

using statistics::ParameterSummary;

/// Prints the table, the log-evidence and the warnings.
void print_summary(const command_line::Report& report, const std::vector<ParameterSummary>& summary,
                   const std::vector<tmcmc::Result>& runs);

/// Columns of the CSV file of the summary, and its rows.
[[nodiscard]] const std::vector<std::string>& summary_columns();
void write_summary(command_line::OptionalCsv& csv, const std::vector<ParameterSummary>& summary);

/// Columns of the CSV file of the samples: the run if there are several, parameters,
/// log-likelihood.
[[nodiscard]] std::vector<std::string> sample_columns(const tmcmc::Prior& prior, long runs);
/// The rows of that file, of equal weight: for weighted samples as many as their effective number,
/// evenly spaced in the cumulative weight.
void write_samples(command_line::OptionalCsv& csv, const std::vector<tmcmc::Result>& runs);

/// Samples, stages and observations in the layout of ArviZ, runs as chains of the length of the
/// shortest, with equal weights as in the CSV file.
[[nodiscard]] storage::InferenceData inference_data(const std::vector<tmcmc::Result>& runs,
                                                    const Model& model, std::uint64_t seed);

}  // namespace examples
