/// \file
/// Samples in a NetCDF-4 file in the layout of ArviZ's InferenceData, which `arviz.from_netcdf` and
/// `xarray.open_dataset(path, group="posterior")` read.
///
/// Groups and variables:
///
///     posterior      one variable a parameter, (chain, draw); attributes of the file are repeated here
///     sample_stats   log_likelihood (chain, draw); beta, effective_sample_size, acceptance_rate, log_evidence_increment and
///                    evaluations of the stages (stage)
///     observed_data  one variable a column of the observations, (observation)
///
/// There is one chain: the samples of a population are exchangeable, and their effective sample size is known to the sampler
/// alone (attributes effective_sample_size_NAME). The file holds no time: the same results give the same bytes.
#pragma once

#include <Eigen/Core>
#include <string>
#include <utility>
#include <vector>

#include "io/files.hpp"

namespace netcdf {

/// Name and values.
using Column = std::pair<std::string, std::vector<double>>;

/// What a file holds.
struct InferenceData {
  std::vector<std::string> parameter_names;                ///< d
  Eigen::MatrixXd samples;                                 ///< n x d
  Eigen::VectorXd log_likelihood;                          ///< n
  std::vector<Column> stages;                              ///< of the same length each
  std::vector<Column> observations;                        ///< of the same length each
  std::vector<std::pair<std::string, double>> numbers;     ///< attributes, such as log_evidence
  std::vector<std::pair<std::string, std::string>> texts;  ///< attributes, such as inference_library
};

/// Writes the whole file into an output that the caller has opened, and commits.
/// \throws io::OutputError; std::invalid_argument for lengths that do not agree or names that NetCDF refuses.
void write_inference_data(io::OutputFile& output, const InferenceData& data);

}  // namespace netcdf
