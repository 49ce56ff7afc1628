// A model of one's own, from measurements to a posterior: the storey stiffnesses of a two-storey shear frame from measured
// natural frequencies (docs/own_model.md says how to put another in its place). The model is the C++ of shear_frame.hpp,
// or any other program with the parameters of the file of the prior: called once a batch of points (--command), started once
// (--worker), or behind a server of UM-Bridge (--um-bridge).
//
// Data: data/examples/, made by data/examples/simulate_frame.py; or the reader's own measurements.

#include <cmath>
#include <optional>
#include <stdexcept>

#include "frame_model.hpp"
#include "inputs.hpp"
#include "kept_run.hpp"
#include "models/ranks.hpp"
#include "storage/checkpoint.hpp"
#include "storage/inference_data.hpp"
#include "tmcmc/diagnostics.hpp"

using namespace examples;
using namespace experiments;

namespace {

/// The recommended sampler with chains enough that a batch is worth the start of a program.
tmcmc::Options sampler_options(long evaluations, int threads) {
  constexpr long chains = 100;
  tmcmc::Options options = tmcmc::recommended_options(evaluations, chains);
  options.threads = threads;
  return options;
}

void report_result(const Report& report, const Model& model, const tmcmc::Result& result) {
  const auto n = static_cast<double>(result.final.points.rows());
  for (Eigen::Index j = 0; j < result.final.points.cols(); ++j) {
    const auto column = result.final.points.col(j).array();
    const double mean = column.mean();
    const double sd = std::sqrt((column - mean).square().sum() / (n - 1.0));
    report("{} = {:.5g} +- {:.2g} (effective sample size {:.0f})\n",
           model.parameter_names[static_cast<std::size_t>(j)], mean, sd,
           result.diagnostics.effective_sample_size[j]);
  }
  report("log-evidence {:.3f} +- {:.3f}; {} stages, {} evaluations\n", result.evidence.log_evidence,
         result.evidence.standard_error, result.stages.size(), result.final.evaluations);
  for (const auto& warning : result.diagnostics.warnings) {
    report("warning: {}\n", warning.message);
  }
}

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

}  // namespace

int main(int argc, char** argv) {
  models::Ranks ranks(argc, argv);
  CLI::App app("Updates a model of one's own: a two-storey shear frame, or another program.", "own_model");
  Report report(app);
  if (ranks.rank() > 0) {
    report.be_silent();
  }
  ModelOptions model_options{.observations = example("frame_observations.csv"),
                             .prior = {.marginals = example("frame_prior.csv"), .correlations = {}}};
  std::string output, netcdf_path, checkpoint_path;
  long evaluations = 31000;
  std::optional<long> parallel;
  RunOptions run_options;
  add_output(app, output, "CSV: a row a sample, with its log-likelihood");
  add_output(app, "--netcdf", netcdf_path, "Samples, stages and observations in the layout of ArviZ");
  add_output(
      app, "--checkpoint", checkpoint_path,
      "Progress after each stage; the same command goes on from it. Without it: the name of --output with "
      ".checkpoint, if --output is a file");
  add_input(app, "--observations", model_options.observations,
            "CSV with columns mode (1 or 2), frequency_hz. With another program: a file that it reads; the "
            "checkpoint of a run with other contents is refused. With --um-bridge: columns observation, "
            "standard_deviation, which the model's outputs are compared with; without it the output is the "
            "log-likelihood");
  add_input(
      app, "--prior", model_options.prior.marginals,
      "CSV with columns parameter, lower, upper (uniform), or parameter, distribution and a column for each "
      "argument. With another program: the parameters, of any names");
  add_input(app, "--prior-correlation", model_options.prior.correlations,
            "Matrix of correlations: CSV with a first column parameter (correlations of the parameters) or "
            "normal_score, and a column for each parameter; without it they are independent");
  app.add_option("--evaluations", evaluations, "Budget of log-likelihoods")->transform(count(2600));
  app.add_option("--command", model_options.command,
                 "Program that computes the log-likelihoods: PROGRAM points.csv log_likelihoods.csv")
      ->type_name("PROGRAM");
  app.add_option("--worker", model_options.worker,
                 "Program that keeps running: n and n points as lines in, n log-likelihoods as lines out")
      ->type_name("PROGRAM");
  app.add_option("--um-bridge", model_options.um_bridge, "Server of the UM-Bridge protocol, with --model")
      ->type_name("URL");
  app.add_option("--model", model_options.model, "Model of the UM-Bridge server")->type_name("NAME");
  app.add_option("--parallel", parallel, "Calls of the program at a time; without it as many as --threads")
      ->transform(count(1, 4096));
  app.add_option("--batch", model_options.batch,
                 "Most points of a call of the program; 0: all that there are for each call at a time")
      ->transform(count(0));
  app.add_option("--timeout", model_options.timeout_seconds,
                 "Most seconds of one call of the program; 0: no limit")
      ->transform(number([](double x) { return x >= 0.0 && std::isfinite(x); }, "a number of at least 0"));
  run_options.add_seed_to(app);
  run_options.add_threads_to(app);

  return report.run(argc, argv, [&] {
    model_options.for_netcdf = !netcdf_path.empty();
    model_options.has_own_observations = model_options.observations != example("frame_observations.csv");
    const int threads = run_options.study_options().threads;
    model_options.parallel = parallel ? static_cast<int>(*parallel) : threads;
    model_options.note = [&](const std::string& text) { report("{}\n", text); };
    const Model model = make_model(model_options);
    const auto shared = ranks.share(model.log_likelihood);
    if (!shared) {
      return;  // this rank has evaluated for rank 0
    }
    auto columns = model.parameter_names;
    columns.emplace_back("log_likelihood");
    auto csv = open_csv(output, columns);
    std::optional<io::OutputFile> netcdf_file;
    if (!netcdf_path.empty()) {
      netcdf_file.emplace(netcdf_path);
    }
    const std::string checkpoint =
        checkpoint_path.empty() && csv && !csv->in_place() ? output + ".checkpoint" : checkpoint_path;
    if (checkpoint == "-") {
      throw std::invalid_argument("--checkpoint: value '-': expected a file");
    }
    if (!checkpoint.empty() && netcdf_file && io::is_same_output(checkpoint, netcdf_path)) {
      throw std::invalid_argument(
          fmt::format("--netcdf: value '{}': expected another file than the checkpoint",
                      io::printable_path(netcdf_path)));
    }

    storage::RunDescription run{
        sampler_options(evaluations, threads), {.seed = run_options.seed}, model.prior, model.description};
    if (ranks.size() > 1 || is_other_program(model_options)) {  // a call for each batch, which they share
      run.options.threads = 1;
      run.options.batch_rows = 0;
    }
    const auto result = run_kept(run, *shared, checkpoint);
    if (result.stop != tmcmc::StopReason::completed) {  // not the posterior: nothing that looks like it
      storage::remove_checkpoint(checkpoint);
      throw std::runtime_error(fmt::format("ended at beta = {:.4g} after {} stages: {}{}", result.final.beta,
                                           result.stages.size(), tmcmc::describe(result.stop),
                                           advice(result.stop)));
    }
    report_result(report, model, result);
    for (Eigen::Index i = 0; i < result.final.points.rows(); ++i) {
      csv.row(Eigen::VectorXd(result.final.points.row(i)), result.final.log_likelihood[i]);
    }
    if (netcdf_file) {
      storage::write_inference_data(*netcdf_file, inference_data(result, model, run_options.seed));
    }
    io::commit_all(csv, netcdf_file);
    storage::remove_checkpoint(checkpoint);
  });
}
