// A model of one's own, from measurements to a posterior (docs/own_model.md). A problem file, or
// the command line, says which parameters there are, what the model is (C++ of own_models.cpp; or
// another program, called once a batch of points, started once, or behind a server of UM-Bridge),
// what was measured, and where the results go. Without any it is the two-storey shear frame of
// shear_frame.hpp, whose storey stiffnesses are inferred from measured natural frequencies.
//
// Data: data/examples/, made by data/examples/simulate_frame.py; or the reader's own measurements.

#include <filesystem>
#include <optional>
#include <stdexcept>

#include "kept_run.hpp"
#include "models/ranks.hpp"
#include "own_figures.hpp"
#include "own_models.hpp"
#include "problem_options.hpp"
#include "run_progress.hpp"
#include "storage/checkpoint.hpp"
#include "summary.hpp"
#include "tmcmc/diagnostics.hpp"

using namespace examples;
using namespace command_line;

namespace {

const char* advice(tmcmc::StopReason stop) {
  switch (stop) {
    case tmcmc::StopReason::budget:
      return ": expected more --evaluations";
    case tmcmc::StopReason::step_too_small:
      return ": expected log-likelihoods on a smaller scale; -inf excludes a point";
    default:
      return "";
  }
}

/// The checkpoint of a run, counted from 1; empty for none. A device, which keeps nothing, is used
/// for all runs.
std::string checkpoint_of(const std::string& base, long run) {
  std::error_code ignored;
  const bool is_device =
      std::filesystem::exists(base, ignored) && !std::filesystem::is_regular_file(base, ignored);
  return base.empty() || run == 1 || is_device ? base : fmt::format("{}.{}", base, run);
}

/// Where the stages are stored: --checkpoint, or beside a file of samples.
std::string checkpoint_base(const ProblemOptions& problem, bool has_file) {
  const std::string base =
      problem.checkpoint.empty() && has_file ? problem.output + ".checkpoint" : problem.checkpoint;
  if (base == "-") {
    throw std::invalid_argument("--checkpoint: value '-': expected a file");
  }
  for (long run = 1; run <= problem.runs && !base.empty() && !problem.netcdf.empty(); ++run) {
    if (io::is_same_output(checkpoint_of(base, run), problem.netcdf)) {
      throw std::invalid_argument(
          fmt::format("--netcdf: value '{}': expected another file than the checkpoint",
                      io::printable_path(problem.netcdf)));
    }
  }
  return base;
}

void require_completed(const tmcmc::Result& result, const std::string& checkpoint) {
  if (result.stop != tmcmc::StopReason::completed) {  // not the posterior: nothing that looks like it
    storage::remove_checkpoint(checkpoint);
    throw std::runtime_error(fmt::format("ended at beta = {:.4g} after {} stages: {}{}", result.final.beta,
                                         result.stages.size(), tmcmc::describe(result.stop),
                                         advice(result.stop)));
  }
}

}  // namespace

int main(int argc, char** argv) {
  models::Ranks ranks(argc, argv);
  CLI::App app("Updates a model of one's own: a two-storey shear frame, or another program.", "own_model");
  Report report(app);
  if (ranks.rank() > 0) {
    report.be_silent();
  }
  ProblemOptions problem(app);

  return report.run(argc, argv, [&] {
    // 1. The model, which the ranks of mpirun share.
    const tmcmc::Options options = problem.sampler();
    RunProgress progress(problem.runs, problem.evaluations, !report.quiet() && ranks.rank() == 0);
    const auto count = [&](Eigen::Index rows) { progress.advance(rows * ranks.size()); };
    const auto note = [&](const std::string& text) { report("{}\n", text); };
    Model model = make_model(problem, {note, count});
    const auto shared = ranks.share(model.log_likelihood, model.compared.outputs);
    if (!shared) {
      return;  // this rank has evaluated for rank 0
    }
    model.compared.outputs = shared->outputs;

    // 2. All outputs are opened before the first call of the model.
    auto csv = open_csv(problem.output, sample_columns(model.prior, problem.runs));
    auto summary_csv = open_csv(problem.summary, summary_columns());
    std::optional<io::OutputFile> netcdf;
    if (!problem.netcdf.empty()) {
      netcdf.emplace(problem.netcdf);
    }
    const OwnFigures figures(problem.figures);
    const std::string checkpoint = checkpoint_base(problem, csv && !csv->in_place());

    // 3. The runs.
    storage::RunDescription run{options, {.seed = problem.seed}, model.prior, model.description};
    if (ranks.size() > 1 || problem.is_other_program()) {  // a call for each batch, which they share
      run.options.threads = 1;
      run.options.batch_rows = 0;
    }
    std::vector<tmcmc::Result> results;
    for (long r = 1; r <= problem.runs; ++r) {
      run.key.run = static_cast<std::uint32_t>(r - 1);
      progress.begin(r);
      const std::string kept = checkpoint_of(checkpoint, r);
      results.push_back(
          run_kept(run, shared->log_likelihood, kept, [&](const auto& stage) { progress.update(stage); }));
      require_completed(results.back(), kept);
    }

    // 4. The results, put in place one right after the other.
    const auto summary = statistics::summarise(results, model.prior);
    print_summary(report, summary, results);
    write_summary(summary_csv, summary);
    write_samples(csv, results);
    if (netcdf) {
      storage::write_inference_data(*netcdf, inference_data(results, model, problem.seed));
    }
    io::commit_all(csv, summary_csv, netcdf);
    figures.make(
        results, model, problem.predictive_draws, [&](auto points) { progress.begin_prediction(points); },
        report);
    for (long r = 1; r <= problem.runs; ++r) {
      storage::remove_checkpoint(checkpoint_of(checkpoint, r));
    }
  });
}
