/// \file
/// Samples in a NetCDF-4 file in the layout of ArviZ's InferenceData, which `arviz.from_netcdf` and
/// `xarray.open_dataset(path, group="posterior")` read.
///
/// Groups and variables:
///
///     posterior       one variable a parameter, (chain, draw); attributes of the file are repeated here
///     sample_stats    lp (chain, draw), the joint log-likelihood; beta, effective_sample_size, acceptance_rate,
///                     log_evidence_increment and evaluations of the stages (stage)
///     log_likelihood  of each observation, (chain, draw, observation), under the name of the variable observed
///     observed_data   what was measured, (observation)
///     constant_data   what else the likelihood knows of each measurement, (observation)
///
/// The last three groups are present if the model provides them. The attribute data_checksum is a
/// CRC-64 of the numbers in observed_data, for read_evidence(). A run is one chain: the samples of
/// its population are exchangeable, and only the sampler knows their effective sample size
/// (attributes effective_sample_size_NAME). The file holds no time stamp: the same results give the
/// same bytes.
#pragma once

#include <Eigen/Core>
#include <string>
#include <utility>
#include <vector>

#include "io/files.hpp"

namespace storage {

/// Name and values.
using Column = std::pair<std::string, std::vector<double>>;

/// Contents of a file.
struct InferenceData {
  /// Names of the d parameters.
  std::vector<std::string> parameter_names = {};
  /// Units of the parameters, the attribute `units` of each variable; an empty text for no unit, an
  /// empty list if none has a unit.
  std::vector<std::string> parameter_units = {};
  /// Samples, n x d, chain by chain.
  Eigen::MatrixXd samples = {};
  /// Number of chains of equal length, for example independent runs; a divisor of n.
  Eigen::Index chains = 1;
  /// Log-likelihood of each sample for all observations together, n values.
  Eigen::VectorXd log_likelihood = {};
  /// Columns of equal length, the number of stages.
  std::vector<Column> stages = {};
  /// Columns of equal length, the number of observations; none if the likelihood is not based on
  /// known observations.
  std::vector<Column> observed = {};
  /// Columns of the same length as observed.
  std::vector<Column> constant = {};
  /// Log-likelihoods of single observations under the name of an observed variable, n x
  /// observations each.
  std::vector<std::pair<std::string, Eigen::MatrixXd>> pointwise_log_likelihood = {};
  /// Numeric attributes, such as log_evidence.
  std::vector<std::pair<std::string, double>> numbers = {};
  /// Text attributes, such as inference_library.
  std::vector<std::pair<std::string, std::string>> texts = {};
};

/// Refuses a name that a variable in the group of the posterior cannot have.
/// \throws errors::InvalidValue with the name as its value.
void require_parameter_name(const std::string& name);

/// Writes the whole file to an output that the caller has opened, and commits it.
/// \throws io::OutputError; errors::InvalidValue for lengths that do not agree or names that NetCDF
///         refuses.
void write_inference_data(io::OutputFile& output, const InferenceData& data);

}  // namespace storage
