/// \file
/// Separate modes of a posterior, from its samples.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "tmcmc/genealogy.hpp"
#include "tmcmc/result.hpp"

namespace tmcmc {

/// When modes count as separate.
struct ModeOptions {
  Index neighbours = 15;        ///< of each point in the graph; a mode has at least one more different points
  Index points = 3000;          ///< most points of the graph; beyond it, every so-manyth of the weight
  double least_weight = 0.005;  ///< of a mode; what is smaller belongs to its neighbour
  /// Distance of two modes, over the larger of their median distances to the last neighbour, from which they are separate
  /// whatever their shape.
  double widest_gap = 3.0;
  /// From this distance on they are separate if there is a valley too, along Fisher's discriminant: a stretch between the medians of both
  /// with less than a fifth of the density of the lower of the two.
  double least_gap = 1.0;

  /// \throws errors::InvalidValue naming field, value and what was expected.
  void validate() const;
};

/// One mode.
struct Mode {
  double weight = 0.0;                 ///< posterior probability
  double standard_error = 0.0;         ///< of the weight
  Index samples = 0;                   ///< in it
  Eigen::VectorXd mean;                ///< d, of its samples
  Eigen::VectorXd standard_deviation;  ///< d, of its samples
};

/// The modes of a posterior.
struct Modes {
  std::vector<Mode> modes;            ///< at least one, the heaviest first
  std::vector<Index> of_sample;       ///< n: the place of each sample's mode in `modes`
  std::vector<std::string> warnings;  ///< about weights that should not be believed; empty for one mode
};

/// Separate modes are parts of the posterior with next to no samples between them: the components of the graph of mutual nearest
/// neighbours (Brito et al. 1997), in coordinates in which neighbours lie at like distances in all directions (Art, Gnanadesikan and
/// Kettenring 1982), of which those are joined again between which there is neither a wide gap nor a
/// valley. Curved and skewed posteriors are one mode, and so is a pair of maxima with samples between them. A mode that the run has not
/// found has no samples and no row here.
///
/// The error of a weight is that of the mean of independent weighted draws; with a genealogy, that of the samples of a run, whose chains
/// are related (effective_sample_sizes()).
/// \param points  n x d, n at least 1, finite
/// \param weights  n, not negative, not all zero; empty for equal weights
/// \param genealogy  of the points, or none
/// \throws errors::InvalidValue for points or weights that are invalid.
[[nodiscard]] Modes find_modes(const Population& points, std::span<const double> weights = {},
                               const Genealogy* genealogy = nullptr, const ModeOptions& options = {});

/// The modes of a finished run: with its weights if they differ, else with its genealogy.
[[nodiscard]] Modes find_modes(const Result& result, const ModeOptions& options = {});

}  // namespace tmcmc
