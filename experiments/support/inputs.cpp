#include "inputs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
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

constexpr double smallest_bound = 1e-100;   // of the upper ones: the squares of noise levels are doubles
constexpr double largest_bound = 1e100;     // likewise
constexpr long largest_study = 4294967295;  // of the random streams, 2^32 - 1
constexpr long most_printed_runs = 10000;   // each is drawn many times over

std::vector<double> ratios(const io::CsvTable& table, const char* column) {
  return checked(
      table, column, table.numbers(column), [](double r) { return r > 1e-4 && r < 1e6; },
      "a ratio between 1e-4 and 1e6");
}

/// What stands behind the last "expected" of a complaint such as "friction_force.lower = 3: expected less than 2 N".
std::string expectation(const std::string& complaint) {
  constexpr std::string_view before = ": expected ";
  const auto found = complaint.rfind(before);
  return found == std::string::npos ? "" : complaint.substr(found + before.size());
}

/// A complaint such as "friction_force.lower = 3: expected less than 2 N", with its place in the file of the prior. What
/// is no regular file cannot be read a second time.
[[noreturn]] void fail_prior(const std::string& path, const std::string& complaint) {
  const std::string expected = expectation(complaint);
  std::error_code ignored;
  if (!expected.empty() && std::filesystem::is_regular_file(path, ignored)) {
    const auto table = io::CsvTable::read(path);
    const auto names = table.text("parameter");
    for (std::size_t row = 0; row < names.size(); ++row) {
      for (const char* side : {"lower", "upper"}) {
        if (complaint.starts_with(fmt::format("{}.{} = ", names[row], side))) {
          table.fail(row, side, expected);
        }
      }
    }
  }
  throw io::InputError(path + ": " + complaint);
}

/// \throws io::InputError unless every study has each sampler of the file once.
void require_same_samplers(const io::CsvTable& table, const std::vector<long>& studies,
                           const std::vector<std::string>& samplers) {
  std::vector<std::pair<long, std::string_view>> pairs;
  std::map<long, std::size_t> rows_of;
  for (std::size_t row = 0; row < studies.size(); ++row) {
    pairs.emplace_back(studies[row], samplers[row]);
    ++rows_of[studies[row]];
  }
  require_once(table, pairs, "sampler", "each sampler once a study");
  const std::set<std::string_view> names(samplers.begin(), samplers.end());
  for (std::size_t row = 0; row < studies.size(); ++row) {
    const std::size_t found = rows_of[studies[row]];
    if (found != names.size()) {
      table.fail(row, "study",
                 fmt::format("a row of each sampler ({}), not {} of {}",
                             io::printable(fmt::to_string(fmt::join(names, ", "))), found, names.size()));
    }
  }
}

}  // namespace

std::vector<double> positive_numbers(const io::CsvTable& table, std::string_view column) {
  return checked(
      table, column, table.numbers(column), [](double x) { return x > 0.0; }, "a positive number");
}

std::vector<double> nonnegative_numbers(const io::CsvTable& table, std::string_view column) {
  return checked(
      table, column, table.numbers(column), [](double x) { return x >= 0.0; }, "a number of at least 0");
}

std::vector<long> positive_integers(const io::CsvTable& table, std::string_view column) {
  return checked(
      table, column, table.integers(column), [](long n) { return n >= 1; }, "a whole number of at least 1");
}

void require_runs_once(const io::CsvTable& table) {
  const auto samplers = table.text("sampler");
  const auto runs = table.integers("run");
  std::vector<std::pair<std::string_view, long>> keys;
  for (std::size_t row = 0; row < runs.size(); ++row) {
    keys.emplace_back(samplers[row], runs[row]);
  }
  require_once(table, keys, "run", "each run once a sampler");
}

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
  o.nominal_ratio = ratios(table, "r_nominal");
  o.measured_ratio = ratios(table, "r_measured");
  o.driving_frequency_hz = checked(
      table, "driving_frequency_hz", table.numbers("driving_frequency_hz"),
      [](double f) { return f > 1e-6 && f < 1e9; }, "a frequency between 1e-6 and 1e9 Hz");
  o.phase_deg = table.numbers("phase_deg");
  for (std::size_t row = 0; row < o.size(); ++row) {
    if (friction::is_singular_ratio(o.measured_ratio[row])) {
      table.fail(row, "r_measured", "a ratio other than 1, 1/3, 1/5, ..., where the response is unbounded");
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
  const auto lower = nonnegative_numbers(table, "lower");
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
    if (!(lower[row] < upper[row])) {
      table.fail(row, "upper", "a number above the lower bound " + io::format_number(lower[row]));
    }
    if (!(upper[row] >= smallest_bound && upper[row] <= largest_bound)) {
      table.fail(row, "upper", "a number from 1e-100 to 1e100");
    }
    if (!(std::nextafter(lower[row], upper[row]) < upper[row])) {
      table.fail(row, "upper",
                 fmt::format("a number above the lower bound {}, with others between them",
                             io::format_number(lower[row])));
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
  } catch (const std::invalid_argument& error) {
    fail_prior(inputs.prior.empty() ? published("table2_prior.csv") : inputs.prior, error.what());
  } catch (const std::domain_error& error) {
    if (inputs.prior.empty()) {
      throw io::InputError(fmt::format("{}: {}", inputs.observations, error.what()));
    }
    fail_prior(inputs.prior, error.what());
  }
}

GroupedColumns read_samples(const std::string& path) {
  return read_samples(io::CsvTable::read(path));
}

GroupedColumns read_samples(const io::CsvTable& table) {
  table.require_columns({"sampler", "run"});
  const auto samplers = table.text("sampler");
  const auto runs = table.integers("run");
  GroupedColumns result;
  std::map<std::string_view, std::size_t> sampler_index;
  std::vector<std::map<long, std::size_t>> run_index;
  std::vector<std::pair<std::size_t, std::size_t>> place;  // of each row: sampler, run
  for (std::size_t row = 0; row < samplers.size(); ++row) {
    const auto [found, is_new] = sampler_index.try_emplace(samplers[row], sampler_index.size());
    if (is_new) {
      result.samplers.push_back(samplers[row]);
      run_index.emplace_back();
    }
    const std::size_t s = found->second;
    const auto run = run_index[s].try_emplace(runs[row], run_index[s].size()).first->second;
    place.emplace_back(s, run);
  }
  for (const auto& name : table.column_names()) {
    if (name != "sampler" && name != "run") {
      result.columns.push_back(name);
    }
  }
  if (result.columns.empty()) {
    throw io::InputError(table.path().string() +
                         ": no column of samples: expected at least one besides sampler and run");
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
  const auto numbers = checked(
      table, "study", table.integers("study"), [](long n) { return n >= 0 && n <= largest_study; },
      "a whole number from 0 to 2^32 - 1");
  const auto samplers = table.text("sampler");
  require_same_samplers(table, numbers, samplers);
  const auto iterations = table.text("iterations");
  const auto evidence_mean = table.numbers("log_evidence_mean");
  const auto evidence_sd = nonnegative_numbers(table, "log_evidence_sd");
  std::vector<study::StudySummary> studies(table.rows());
  for (std::size_t row = 0; row < studies.size(); ++row) {
    auto& s = studies[row];
    s.study = static_cast<std::uint32_t>(numbers[row]);
    s.sampler = samplers[row];
    s.log_evidence_mean = evidence_mean[row];
    s.log_evidence_sd = evidence_sd[row];
    try {
      s.iterations = study::parse_iterations(iterations[row]);
    } catch (const std::invalid_argument& error) {
      table.fail(row, "iterations", expectation(error.what()));
    }
  }
  const auto any_numbers = [](const io::CsvTable& from, std::string_view column) {
    return from.numbers(column);
  };
  const auto fill = [&](const std::string& prefix, std::vector<double> study::StudySummary::*member,
                        auto read) {
    for (const auto& name : parameter_columns) {
      const auto values = read(table, prefix + name);
      for (std::size_t row = 0; row < studies.size(); ++row) {
        (studies[row].*member).push_back(values[row]);
      }
    }
  };
  fill("area_", &study::StudySummary::areas, positive_numbers);
  fill("mean_", &study::StudySummary::means, any_numbers);
  fill("standard_error_", &study::StudySummary::standard_errors, nonnegative_numbers);
  fill("smallest_", &study::StudySummary::smallest, any_numbers);
  fill("largest_", &study::StudySummary::largest, any_numbers);
  return studies;
}

PrintedTables read_printed_tables(const std::string& table3, const std::string& table4) {
  PrintedTables printed;
  const auto areas = io::CsvTable::read(table3);
  const auto samplers = areas.text("sampler");
  require_once(areas, samplers, "sampler", "each sampler once");
  for (const std::size_t parameter :
       {std::size_t{friction::friction_force}, std::size_t{friction::natural_frequency}}) {
    const auto& column = parameter_columns[parameter];
    static_cast<void>(positive_numbers(areas, column));
    for (std::size_t row = 0; row < samplers.size(); ++row) {
      printed.areas.push_back({samplers[row], parameter, std::string(areas.cell(row, column))});
    }
  }
  const auto counts = io::CsvTable::read(table4);
  const auto iterations = positive_integers(counts, "iterations");
  require_once(counts, iterations, "iterations", "each number of iterations once");
  for (std::size_t row = 0; row < samplers.size(); ++row) {
    if (samplers[row] == "iterations" || !counts.has(samplers[row])) {
      areas.fail(row, "sampler", fmt::format("the name of a column of {}", table4));
    }
  }
  for (const auto& sampler : counts.column_names()) {
    if (sampler == "iterations") {
      continue;
    }
    if (std::find(samplers.begin(), samplers.end(), sampler) == samplers.end()) {
      throw io::InputError(
          fmt::format("{}: column 'sampler': no row '{}': expected one for each sampler of {}", table3,
                      io::printable(sampler), table4));
    }
    const auto runs = checked(
        counts, sampler, counts.integers(sampler), [](long n) { return n >= 0 && n <= most_printed_runs; },
        "a number of runs from 0 to 10000");
    study::PrintedCounts column{sampler, {}};
    for (std::size_t row = 0; row < runs.size(); ++row) {
      column.counts[iterations[row]] = runs[row];
    }
    printed.counts.push_back(column);
  }
  return printed;
}

std::vector<study::StudySummary> read_studies(const std::string& path, const PrintedTables& printed) {
  auto studies = read_studies(path);
  for (const auto& column : printed.counts) {
    if (std::none_of(studies.begin(), studies.end(),
                     [&](const auto& s) { return s.sampler == column.sampler; })) {
      throw io::InputError(fmt::format(
          "{}: column 'sampler': no row '{}': expected studies of each sampler of the printed tables", path,
          io::printable(column.sampler)));
    }
  }
  return studies;
}

study::Null null_of(const std::vector<study::StudySummary>& studies, const PrintedTables& printed) {
  if (printed.counts.size() != 2) {
    throw io::InputError(fmt::format(
        "Table 4 as printed: {} columns of counts: expected those of two samplers", printed.counts.size()));
  }
  return study::null_of(studies, printed.counts[0].sampler, printed.counts[1].sampler, 1);
}

}  // namespace experiments
