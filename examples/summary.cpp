#include "summary.hpp"

#include <algorithm>
#include <cmath>

#include "command_line/build_info.hpp"
#include "tmcmc/diagnostics.hpp"
#include "tmcmc/modes.hpp"

namespace examples {

using statistics::equal_draws;
using statistics::equal_rows;
using statistics::mean_evidence;
using tmcmc::Index;

namespace {

/// Prints the separate modes of a run, if there are several.
void print_modes(const command_line::Report& report, const std::vector<ParameterSummary>& names,
                 const tmcmc::Result& run, const std::string& of_run) {
  const auto found = tmcmc::find_modes(run);
  if (found.modes.size() < 2) {
    return;
  }
  report("{} separate modes{}:\n", found.modes.size(), of_run);
  for (std::size_t k = 0; k < found.modes.size(); ++k) {
    const auto& mode = found.modes[k];
    report("  mode {}: weight {:.3g} +- {:.2g};", k + 1, mode.weight, mode.standard_error);
    for (std::size_t j = 0; j < names.size(); ++j) {
      const auto at = static_cast<Index>(j);
      report(" {} = {:.4g} ({:.2g})", names[j].name, mode.mean[at], mode.standard_deviation[at]);
    }
    report("\n");
  }
  for (const auto& warning : found.warnings) {
    report("warning: {}{}\n", warning, of_run);
  }
}

}  // namespace

void print_summary(const command_line::Report& report, const std::vector<ParameterSummary>& summary,
                   const std::vector<tmcmc::Result>& runs) {
  std::size_t width = std::string("parameter").size();
  for (const auto& row : summary) {
    width = std::max(width, row.name.size() + (row.unit.empty() ? 0 : row.unit.size() + 3));
  }
  report("{:<{}} {:>11} {:>10} {:>11} {:>11} {:>11} {:>7} {:>6}\n", "parameter", width, "mean", "sd", "5 %",
         "50 %", "95 %", "ess", "R-hat");
  for (const auto& row : summary) {
    const std::string name = row.unit.empty() ? row.name : fmt::format("{} [{}]", row.name, row.unit);
    report("{:<{}} {:>11.5g} {:>10.3g} {:>11.5g} {:>11.5g} {:>11.5g} {:>7.0f} {:>6}\n", name, width, row.mean,
           row.sd, row.quantile_5, row.median, row.quantile_95, row.effective_sample_size,
           std::isnan(row.r_hat) ? "-" : fmt::format("{:.3f}", row.r_hat));
  }
  const auto evidence = mean_evidence(runs);
  report("log-evidence {:.3f} +- {:.3f}", evidence.log_evidence, evidence.standard_error);
  for (std::size_t r = 0; r < runs.size(); ++r) {
    report("{} {} stages, {} evaluations", r == 0 ? ";" : ",", runs[r].stages.size(),
           runs[r].final.evaluations);
  }
  report("\n");
  for (std::size_t r = 0; r < runs.size(); ++r) {
    print_modes(report, summary, runs[r], runs.size() > 1 ? fmt::format(" of run {}", r + 1) : "");
  }
  for (std::size_t r = 0; r < runs.size(); ++r) {
    for (const auto& warning : runs[r].diagnostics.warnings) {
      report("warning: {}{}\n", warning.message, runs.size() > 1 ? fmt::format(" of run {}", r + 1) : "");
    }
  }
}

const std::vector<std::string>& summary_columns() {
  static const std::vector<std::string> columns = {
      "parameter", "unit", "mean", "sd", "quantile_5", "median", "quantile_95", "effective_sample_size",
      "r_hat"};
  return columns;
}

void write_summary(command_line::OptionalCsv& csv, const std::vector<ParameterSummary>& summary) {
  for (const auto& row : summary) {
    csv.row(row.name, row.unit, row.mean, row.sd, row.quantile_5, row.median, row.quantile_95,
            row.effective_sample_size, row.r_hat);
  }
}

std::vector<std::string> sample_columns(const tmcmc::Prior& prior, long runs) {
  auto columns = prior.names();
  columns.emplace_back("log_likelihood");
  if (runs > 1) {
    columns.insert(columns.begin(), "run");
  }
  return columns;
}

void write_samples(command_line::OptionalCsv& csv, const std::vector<tmcmc::Result>& runs) {
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const auto& samples = runs[r].final;
    for (const Index i : equal_rows(runs[r], equal_draws(runs[r]))) {
      std::vector<double> row;
      if (runs.size() > 1) {
        row.push_back(static_cast<double>(r + 1));
      }
      for (Index j = 0; j < samples.points.cols(); ++j) {
        row.push_back(samples.points(i, j));
      }
      row.push_back(samples.log_likelihood[i]);
      csv.row(row);
    }
  }
}

storage::InferenceData inference_data(const std::vector<tmcmc::Result>& runs, const Model& model,
                                      std::uint64_t seed) {
  storage::InferenceData data{.parameter_names = model.prior.names(), .parameter_units = model.prior.units()};
  Index draws = equal_draws(runs.front());
  for (const auto& run : runs) {
    draws = std::min(draws, equal_draws(run));
  }
  data.chains = static_cast<Index>(runs.size());
  data.samples.resize(draws * data.chains, model.prior.dimension());
  data.log_likelihood.resize(draws * data.chains);
  Index next = 0;
  for (const auto& run : runs) {
    for (const Index row : equal_rows(run, draws)) {
      data.samples.row(next) = run.final.points.row(row);
      data.log_likelihood[next++] = run.final.log_likelihood[row];
    }
  }
  const auto stages = [&](const std::string& name, auto member) {
    storage::Column column{name, {}};
    for (const auto& run : runs) {
      for (const auto& stage : run.stages) {
        column.second.push_back(static_cast<double>(stage.*member));
      }
    }
    data.stages.push_back(std::move(column));
  };
  stages("beta", &tmcmc::StageRecord::beta);
  stages("effective_sample_size", &tmcmc::StageRecord::effective_sample_size);
  stages("acceptance_rate", &tmcmc::StageRecord::acceptance_rate);
  stages("log_evidence_increment", &tmcmc::StageRecord::log_evidence_increment);
  stages("evaluations", &tmcmc::StageRecord::evaluations);
  if (runs.size() > 1) {
    storage::Column run_of_stage{"run", {}};
    for (std::size_t r = 0; r < runs.size(); ++r) {
      run_of_stage.second.insert(run_of_stage.second.end(), runs[r].stages.size(), static_cast<double>(r));
    }
    data.stages.push_back(std::move(run_of_stage));
  }
  data.observed = model.measurements.observed;
  data.constant = model.measurements.constant;
  if (model.measurements.pointwise) {
    data.pointwise_log_likelihood = model.measurements.pointwise(data.samples);
  }
  data.texts = {{"inference_library", "tmcmc_companion"},
                {"inference_library_version", command_line::version()},
                {"seed", std::to_string(seed)}};
  const auto evidence = mean_evidence(runs);
  data.numbers = {{"beta", runs.front().final.beta},
                  {"log_evidence", evidence.log_evidence},
                  {"log_evidence_standard_error", evidence.standard_error}};
  for (std::size_t j = 0; j < data.parameter_names.size(); ++j) {
    double size = 0.0;
    for (const auto& run : runs) {
      size += run.diagnostics.effective_sample_size[static_cast<Index>(j)];
    }
    data.numbers.emplace_back("effective_sample_size_" + data.parameter_names[j], size);
  }
  return data;
}

}  // namespace examples
