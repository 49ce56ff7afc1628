/// \file
/// Figures of the runs of a model of one's own.
#pragma once

#include <string>
#include <vector>

#include "own_prediction.hpp"

namespace examples {

/// The tables of the figures, and the figures that gnuplot draws from them as PDF and PNG: samples_corner, samples_marginals,
/// samples_stages and, of a model with outputs, samples_predictive. The directory is made if it is not there; files of these names are replaced.
class OwnFigures {
 public:
  /// \param directory  empty: none are made
  /// \throws io::OutputError if a table cannot be opened there
  explicit OwnFigures(std::string directory);

  /// Writes the tables and draws, after the other results are in place; last what evaluates the model again. Without gnuplot the tables
  /// stay alone, with a warning.
  /// \param runs  completed, at least one
  /// \param draws  of the posterior at which the model is evaluated; 0: no samples_predictive
  /// \param begin  as in predict
  /// \throws io::OutputError; if the model fails or a signal comes, std::runtime_error and io::Interrupted, which say that all else is
  ///         in place
  void make(const std::vector<tmcmc::Result>& runs, const Model& model, long draws,
            const std::function<void(tmcmc::Index)>& begin, const experiments::Report& report) const;

 private:
  [[nodiscard]] std::string path(const std::string& name) const { return directory_ + "/" + name; }
  [[nodiscard]] bool draw(const std::string& figure) const;

  std::string directory_;  // absolute
};

}  // namespace examples
