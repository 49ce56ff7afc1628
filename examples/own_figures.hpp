/// \file
/// Figures for the runs of a user-defined model.
#pragma once

#include <string>
#include <vector>

#include "own_prediction.hpp"

namespace examples {

/// The tables of the figures, and the figures that gnuplot draws from them as PDF and PNG:
/// samples_corner, samples_marginals, samples_stages and, for a model with outputs,
/// samples_predictive. The directory is created if it does not exist; files with these names are
/// replaced.
class OwnFigures {
 public:
  /// \param directory  directory of the figures; empty: none are made
  /// \throws io::OutputError if a table cannot be opened there
  explicit OwnFigures(std::string directory);

  /// Writes the tables and draws the figures, after the other results are in place; the figure that
  /// evaluates the model again comes last. Without gnuplot only the tables are written, with a
  /// warning.
  /// \param runs  completed runs, at least one
  /// \param draws  number of posterior draws at which the model is evaluated; 0: no
  ///        samples_predictive
  /// \param begin  as in predict
  /// \throws io::OutputError; if the model fails or a signal is received, std::runtime_error or
  ///         io::Interrupted, which say that everything else is in place
  void make(const std::vector<tmcmc::Result>& runs, const Model& model, long draws,
            const std::function<void(tmcmc::Index)>& begin, const command_line::Report& report) const;

 private:
  [[nodiscard]] std::string path(const std::string& name) const { return directory_ + "/" + name; }
  [[nodiscard]] bool draw(const std::string& figure) const;

  // absolute
  std::string directory_;
};

}  // namespace examples
