#include "inputs.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>

#include "friction/response.hpp"

namespace experiments {

namespace {

const std::vector<std::string> prior_rows = {"friction_force", "natural_frequency", "phase_noise",
                                             "frequency_ratio_noise"};

std::string in_directory(const char* directory, const std::string& file) {
  const std::filesystem::path here = std::filesystem::path("data") / directory / file;
  std::error_code ignored;
  return std::filesystem::exists(here, ignored)
             ? here.string()
             : (std::filesystem::path(COMPANION_SOURCE_DIR) / here).string();
}

std::vector<double> positive_numbers(const io::CsvTable& table, const char* column) {
  std::vector<double> values = table.numbers(column);
  for (std::size_t row = 0; row < values.size(); ++row) {
    if (!(values[row] > 0.0)) {
      table.fail(row, column, "a positive number");
    }
  }
  return values;
}

}  // namespace

void InputFiles::add_observations_to(CLI::App& app) {
  observations = published("table1_observations.csv");
  app.add_option("--observations", observations,
                 "Measurements: CSV with columns r_nominal, r_measured, driving_frequency_hz, phase_deg")
      ->type_name("CSV");
}

void InputFiles::add_prior_to(CLI::App& app) {
  app.add_option(
         "--prior", prior,
         "Bounds of the uniform prior: CSV with columns parameter, lower, upper; without it Table 2 as the "
         "reading has it")
      ->type_name("CSV");
}

std::string published(const std::string& file) {
  return in_directory("published", file);
}

std::string example(const std::string& file) {
  return in_directory("examples", file);
}

friction::Observations read_observations(const std::string& path) {
  const auto table = io::CsvTable::read(path);
  table.require_columns({"r_nominal", "r_measured", "driving_frequency_hz", "phase_deg"});
  friction::Observations o;
  o.nominal_ratio = positive_numbers(table, "r_nominal");
  o.measured_ratio = positive_numbers(table, "r_measured");
  o.driving_frequency_hz = positive_numbers(table, "driving_frequency_hz");
  o.phase_deg = table.numbers("phase_deg");
  for (std::size_t row = 0; row < o.size(); ++row) {
    if (friction::is_singular_ratio(o.measured_ratio[row])) {
      table.fail(row, "r_measured", "a ratio other than 1, 1/3, 1/5, ..., where the response is unbounded");
    }
    if (!(o.measured_ratio[row] > 1e-4 && o.measured_ratio[row] < 1e6)) {
      table.fail(row, "r_measured", "a ratio between 1e-4 and 1e6");
    }
    if (!(o.phase_deg[row] >= -360.0 && o.phase_deg[row] <= 360.0)) {
      table.fail(row, "phase_deg", "an angle between -360 and 360 degrees");
    }
  }
  return o;
}

tmcmc::BoxPrior read_prior(const std::string& path) {
  return read_prior(path, prior_rows);
}

tmcmc::BoxPrior read_prior(const std::string& path, const std::vector<std::string>& expected) {
  const auto table = io::CsvTable::read(path);
  table.require_columns({"parameter", "lower", "upper"});
  const auto names = table.text("parameter");
  const auto lower = table.numbers("lower");
  const auto upper = table.numbers("upper");
  std::vector<bool> seen(expected.size(), false);
  Eigen::VectorXd low(static_cast<Eigen::Index>(expected.size()));
  Eigen::VectorXd high = low;
  for (std::size_t row = 0; row < names.size(); ++row) {
    const auto found = std::find(expected.begin(), expected.end(), names[row]);
    if (found == expected.end()) {
      table.fail(
          row, "parameter",
          fmt::format("{} or {}", fmt::join(expected.begin(), expected.end() - 1, ", "), expected.back()));
    }
    const auto j = static_cast<std::size_t>(found - expected.begin());
    if (seen[j]) {
      table.fail(row, "parameter", "each parameter once");
    }
    seen[j] = true;
    if (!(lower[row] >= 0.0)) {
      table.fail(row, "lower", "a number of at least 0");
    }
    if (!(lower[row] < upper[row])) {
      table.fail(row, "upper", "a number above the lower bound " + io::format_number(lower[row]));
    }
    low[static_cast<Eigen::Index>(j)] = lower[row];
    high[static_cast<Eigen::Index>(j)] = upper[row];
  }
  for (std::size_t j = 0; j < seen.size(); ++j) {
    if (!seen[j]) {
      throw io::InputError(fmt::format("{}: column 'parameter': no row '{}': expected one row for each of {}",
                                       path, expected[j], fmt::join(expected, ", ")));
    }
  }
  return {low, high};
}

tmcmc::BoxPrior prior_for(const InputFiles& inputs, const study::Reading& reading) {
  if (!inputs.prior.empty()) {
    return read_prior(inputs.prior);
  }
  const tmcmc::BoxPrior table2 = read_prior(published("table2_prior.csv"));
  Eigen::VectorXd lower = table2.lower();
  lower[friction::natural_frequency] =
      reading.natural_frequency_lower_hz.value_or(lower[friction::natural_frequency]);
  return {lower, table2.upper()};
}

estimation::ParameterBounds bounds_of(const tmcmc::BoxPrior& prior) {
  estimation::ParameterBounds bounds;
  for (std::size_t p = 0; p < bounds.size(); ++p) {
    const auto j = static_cast<Eigen::Index>(p);
    bounds[p] = {prior.lower()[j], prior.upper()[j]};
  }
  return bounds;
}

estimation::ExactPosterior exact_posterior_for(const InputFiles& inputs,
                                               const friction::Likelihood& likelihood,
                                               const tmcmc::BoxPrior& prior) {
  try {
    return {likelihood, bounds_of(prior)};
  } catch (const std::domain_error& error) {
    throw io::InputError(
        fmt::format("{}: {}", inputs.prior.empty() ? inputs.observations : inputs.prior, error.what()));
  }
}

GroupedColumns read_samples(const std::string& path) {
  const auto table = io::CsvTable::read(path);
  table.require_columns({"sampler", "run"});
  const auto samplers = table.text("sampler");
  const auto runs = table.integers("run");
  GroupedColumns result;
  std::vector<std::map<long, std::size_t>> run_index;
  std::vector<std::pair<std::size_t, std::size_t>> place;  // of each row: sampler, run
  for (std::size_t row = 0; row < samplers.size(); ++row) {
    auto found = std::find(result.samplers.begin(), result.samplers.end(), samplers[row]);
    if (found == result.samplers.end()) {
      result.samplers.push_back(samplers[row]);
      run_index.emplace_back();
      found = result.samplers.end() - 1;
    }
    const auto s = static_cast<std::size_t>(found - result.samplers.begin());
    const auto run = run_index[s].try_emplace(runs[row], run_index[s].size()).first->second;
    place.emplace_back(s, run);
  }
  for (const auto& name : table.column_names()) {
    if (name != "sampler" && name != "run") {
      result.columns.push_back(name);
    }
  }
  if (result.columns.empty()) {
    throw io::InputError(path + ": no column of samples: expected at least one besides sampler and run");
  }
  result.values.resize(result.samplers.size());
  for (std::size_t s = 0; s < result.samplers.size(); ++s) {
    result.values[s].assign(result.columns.size(), std::vector<std::vector<double>>(run_index[s].size()));
  }
  for (std::size_t c = 0; c < result.columns.size(); ++c) {
    const auto numbers = table.numbers(result.columns[c]);
    for (std::size_t row = 0; row < numbers.size(); ++row) {
      result.values[place[row].first][c][place[row].second].push_back(numbers[row]);
    }
  }
  return result;
}

std::vector<study::StudySummary> read_studies(const std::string& path) {
  const auto table = io::CsvTable::read(path);
  const auto numbers = table.integers("study");
  const auto samplers = table.text("sampler");
  const auto iterations = table.text("iterations");
  const auto evidence_mean = table.numbers("log_evidence_mean");
  const auto evidence_sd = table.numbers("log_evidence_sd");
  std::vector<study::StudySummary> studies(table.rows());
  for (std::size_t row = 0; row < studies.size(); ++row) {
    auto& s = studies[row];
    s.study = static_cast<std::uint32_t>(numbers[row]);
    s.sampler = samplers[row];
    s.log_evidence_mean = evidence_mean[row];
    s.log_evidence_sd = evidence_sd[row];
    try {
      s.iterations = study::parse_iterations(iterations[row]);
    } catch (const std::invalid_argument&) {
      table.fail(row, "iterations", "pairs such as 10:45, with blanks between");
    }
  }
  const auto fill = [&](const std::string& prefix, std::vector<double> study::StudySummary::*member) {
    for (const auto& name : parameter_columns) {
      const auto values = table.numbers(prefix + name);
      for (std::size_t row = 0; row < studies.size(); ++row) {
        (studies[row].*member).push_back(values[row]);
      }
    }
  };
  fill("area_", &study::StudySummary::areas);
  fill("mean_", &study::StudySummary::means);
  fill("standard_error_", &study::StudySummary::standard_errors);
  fill("smallest_", &study::StudySummary::smallest);
  fill("largest_", &study::StudySummary::largest);
  return studies;
}

PrintedTables read_printed_tables(const std::string& table3, const std::string& table4) {
  PrintedTables printed;
  const auto areas = io::CsvTable::read(table3);
  const auto samplers = areas.text("sampler");
  for (const std::size_t parameter :
       {std::size_t{friction::friction_force}, std::size_t{friction::natural_frequency}}) {
    const auto& column = parameter_columns[parameter];
    const auto values = areas.numbers(column);
    for (std::size_t row = 0; row < samplers.size(); ++row) {
      if (!(values[row] > 0.0)) {
        areas.fail(row, column, "a positive number");
      }
      printed.areas.push_back({samplers[row], parameter, std::string(areas.cell(row, column))});
    }
  }
  const auto counts = io::CsvTable::read(table4);
  const auto iterations = counts.integers("iterations");
  for (const auto& sampler : counts.column_names()) {
    if (sampler == "iterations") {
      continue;
    }
    const auto runs = counts.integers(sampler);
    study::PrintedCounts column{sampler, {}};
    for (std::size_t row = 0; row < runs.size(); ++row) {
      if (runs[row] < 0) {
        counts.fail(row, sampler, "a number of runs, at least 0");
      }
      column.counts[iterations[row]] = runs[row];
    }
    printed.counts.push_back(column);
  }
  return printed;
}

study::Null null_of(const std::vector<study::StudySummary>& studies, const PrintedTables& printed) {
  if (printed.counts.size() != 2) {
    throw io::InputError(fmt::format(
        "Table 4 as printed: {} columns of counts: expected those of two samplers", printed.counts.size()));
  }
  return study::null_of(studies, printed.counts[0].sampler, printed.counts[1].sampler, 1);
}

}  // namespace experiments
