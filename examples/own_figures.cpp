#include "own_figures.hpp"

#include <filesystem>
#include <limits>

#include "command_line/build_info.hpp"
#include "command_line/corner_tables.hpp"
#include "io/interrupt.hpp"
#include "models/child.hpp"

namespace examples {

namespace {

/// Samples of all runs, each of which has the same weight.
command_line::CornerSamples pooled(const std::vector<tmcmc::Result>& runs, const tmcmc::Prior& prior) {
  command_line::CornerSamples samples;
  samples.names = prior.names();
  samples.columns.resize(samples.names.size());
  for (const auto& run : runs) {
    const double total = run.weights.sum();
    for (Eigen::Index i = 0; i < run.final.points.rows(); ++i) {
      for (std::size_t j = 0; j < samples.names.size(); ++j) {
        samples.columns[j].push_back(run.final.points(i, static_cast<Eigen::Index>(j)));
      }
      samples.weights.push_back(run.weights[i] / total);
    }
  }
  return samples;
}

/// Writes the stages. The rounds of a search, of which a run of independent draws consists, have
/// neither acceptance rate nor evidence.
void write_stages(command_line::OptionalCsv& csv, const std::vector<tmcmc::Result>& runs) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const bool is_search = runs[r].measurement.has_value();
    double log_evidence = 0.0;
    for (const auto& stage : runs[r].stages) {
      log_evidence += stage.log_evidence_increment;
      csv.row(r + 1, stage.stage, stage.beta, stage.effective_sample_size,
              is_search ? nan : stage.acceptance_rate, is_search ? nan : log_evidence);
    }
  }
}

/// Calls predict(); if it fails, the message says which results are in place.
Prediction predict_last(const std::vector<tmcmc::Result>& runs, const Model& model, long draws,
                        const std::function<void(tmcmc::Index)>& begin) {
  const std::string kept = "all results but samples_predictive are in place";
  try {
    return predict(runs, model, draws, begin);
  } catch (io::Interrupted& interrupted) {
    interrupted.kept = kept;
    throw;
  } catch (const std::exception& error) {
    throw std::runtime_error(fmt::format("{}; {}", error.what(), kept));
  }
}

}  // namespace

OwnFigures::OwnFigures(std::string directory) : directory_(std::move(directory)) {
  if (!directory_.empty()) {
    directory_ = std::filesystem::absolute(directory_);
    std::error_code error;
    std::filesystem::create_directories(directory_, error);
    if (error) {
      throw io::OutputError(fmt::format("--figures: value '{}': {}: expected a directory that can be written",
                                        io::printable_path(directory_), error.message()));
    }
  }
}

/// Draws a figure and returns whether it was drawn; warns if not.
bool OwnFigures::draw(const std::string& figure) const {
  const std::string& source = command_line::source_directory();
  const auto end =
      models::run_child({source + "/figures/draw", figure, directory_, directory_}, source, 60.0);
  const bool is_drawn = end.kind == models::ChildEnd::Kind::exited && end.value == 0;
  if (!is_drawn) {
    command_line::warn(fmt::format(
        "{}: not drawn within a minute: expected gnuplot (make deps); the tables are there", path(figure)));
  }
  return is_drawn;
}

void OwnFigures::make(const std::vector<tmcmc::Result>& runs, const Model& model, long draws,
                      const std::function<void(tmcmc::Index)>& begin,
                      const command_line::Report& report) const {
  if (directory_.empty()) {
    return;
  }
  constexpr long bins = 30;
  command_line::CornerTables tables(path("corner.csv"), path("corner_marginals.csv"),
                                    path("corner_summary.csv"));
  auto stages = command_line::open_csv(path("stages.csv"), {"run", "stage", "beta", "effective_sample_size",
                                                            "acceptance_rate", "log_evidence"});
  tables.write(pooled(runs, model.prior), bins);
  write_stages(stages, runs);
  io::commit_all(tables.joint, tables.marginals, tables.summary, stages);
  bool is_drawn = draw("samples_corner") && draw("samples_marginals") && draw("samples_stages");
  if (model.compared.outputs && draws > 0) {
    const Prediction prediction = predict_last(runs, model, draws, begin);
    auto csv = command_line::open_csv(path("predictive.csv"), prediction_columns());
    write_prediction(csv, prediction);
    io::commit_all(csv);
    print_prediction(report, prediction);
    is_drawn = is_drawn && draw("samples_predictive");
  }
  if (is_drawn) {
    report("figures and their tables: {}\n", directory_);
  }
}

}  // namespace examples
