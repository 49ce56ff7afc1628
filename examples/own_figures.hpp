/// \file
/// Figures of the runs of a model of one's own.
#pragma once

#include <string>
#include <vector>

#include "run.hpp"
#include "tmcmc/sampler.hpp"

namespace examples {

/// The tables of the figures, and the figures that gnuplot draws from them as PDF and PNG: samples_corner, samples_marginals and
/// samples_stages. The directory is made if it is not there; files of these names are replaced.
class OwnFigures {
 public:
  /// \param directory  empty: none are made
  /// \throws io::OutputError if a table cannot be opened there
  explicit OwnFigures(std::string directory);

  /// Writes the tables and draws, after the other results are in place. Without gnuplot the tables stay alone, with a warning.
  /// \param runs  completed, at least one
  /// \throws io::OutputError
  void make(const std::vector<tmcmc::Result>& runs, const tmcmc::Prior& prior,
            const experiments::Report& report) const;

 private:
  std::string directory_;  // absolute
};

}  // namespace examples
