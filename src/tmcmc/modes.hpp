/// \file
/// Separate modes of a posterior, from its samples.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "tmcmc/genealogy.hpp"
#include "tmcmc/result.hpp"

namespace tmcmc {

/// Settings that decide when modes count as separate.
struct ModeOptions {
  /// Of each point in the graph; a mode has at least one more distinct point.
  Index neighbours = 15;
  /// Most points of the graph; beyond it, points at equal steps of the weight.
  Index points = 3000;
  /// Smallest weight of a mode; a smaller one is joined to its neighbour.
  double least_weight = 0.005;
  /// Distance of two modes, divided by the larger of their median distances to the last neighbour,
  /// from which on they are separate whatever their shape.
  double widest_gap = 3.0;
  /// From this distance on two modes are separate if there is also a valley between them, along
  /// Fisher's discriminant: a stretch between the two medians with less than a fifth of the density
  /// of the lower mode.
  double least_gap = 1.0;

  /// \throws errors::InvalidValue naming field, value and what was expected.
  void validate() const;
};

/// One mode.
struct Mode {
  /// Posterior probability.
  double weight = 0.0;
  /// Standard error of the weight.
  double standard_error = 0.0;
  /// Number of samples in the mode.
  Index samples = 0;
  /// Mean of its samples, d.
  Eigen::VectorXd mean;
  /// Standard deviation of its samples, d.
  Eigen::VectorXd standard_deviation;
};

/// The modes of a posterior.
struct Modes {
  /// At least one, in descending order of weight.
  std::vector<Mode> modes;
  /// n: index in `modes` of each sample's mode.
  std::vector<Index> of_sample;
  /// About unreliable weights; empty for one mode.
  std::vector<std::string> warnings;
};

/// Separate modes are parts of the posterior with practically no samples between them. They are the
/// components of the graph of mutual nearest neighbours (Brito et al. 1997), in coordinates in
/// which neighbours lie at similar distances in all directions (Art, Gnanadesikan and Kettenring
/// 1982); components with neither a wide gap nor a valley between them are joined again. A curved
/// or skewed posterior is one mode, and so is a pair of maxima with samples between them. A mode
/// that the run has not found has no samples and no row here.
///
/// The error of a weight is that of the mean of independent weighted draws; if a genealogy is
/// given, it is that of the samples of a run, whose chains are related (effective_sample_sizes()).
/// \param points  n x d, n at least 1, finite
/// \param weights  n, not negative, not all zero; empty for equal weights
/// \param genealogy  genealogy of the points, or none
/// \throws errors::InvalidValue if points or weights are invalid.
[[nodiscard]] Modes find_modes(const Population& points, std::span<const double> weights = {},
                               const Genealogy* genealogy = nullptr, const ModeOptions& options = {});

/// The modes of a finished run: computed with its weights if they differ, otherwise with its
/// genealogy.
[[nodiscard]] Modes find_modes(const Result& result, const ModeOptions& options = {});

}  // namespace tmcmc
