#include "inputs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>

#include "errors/invalid_value.hpp"
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

constexpr double smallest_bound = 1e-100;  // of the upper ones: the squares of noise levels are doubles
constexpr double largest_bound = 1e100;    // likewise

std::vector<double> ratios(const io::CsvTable& table, const char* column) {
  return checked(
      table, column, table.numbers(column), [](double r) { return r > 1e-4 && r < 1e6; },
      "a ratio between 1e-4 and 1e6");
}

/// Refuses bounds without numbers between them.
void require_interval(const io::CsvTable& table, std::size_t row, double lower, double upper) {
  if (!(lower < upper)) {
    table.fail(row, "upper", "a number above the lower bound " + io::format_number(lower));
  }
  if (!(std::nextafter(lower, upper) < upper)) {
    table.fail(
        row, "upper",
        fmt::format("a number above the lower bound {}, with others between them", io::format_number(lower)));
  }
}

/// A value that is refused, with its place in the file of the prior. What is no regular file cannot be read a second time.
[[noreturn]] void fail_prior(const std::string& path, const errors::InvalidValue& invalid) {
  std::error_code ignored;
  if (std::filesystem::is_regular_file(path, ignored)) {
    const auto table = io::CsvTable::read(path);
    const auto names = table.text("parameter");
    for (std::size_t row = 0; row < names.size(); ++row) {
      for (const char* side : {"lower", "upper"}) {
        if (invalid.field() == names[row] + "." + side) {
          table.fail(row, side, invalid.expected());
        }
      }
    }
  }
  throw io::InputError(fmt::format("{}: {}", path, invalid.what()));
}

}  // namespace

void InputFiles::add_observations_to(Program& program) {
  observations = published("table1_observations.csv");
  program.add_input("--observations", observations,
                    "Measurements: CSV with columns r_nominal, r_measured, driving_frequency_hz, phase_deg");
}

void InputFiles::add_prior_to(Program& program) {
  program.add_read_file(published("table2_prior.csv"));  // what the reading starts from
  program.add_input(
      "--prior", prior,
      "Bounds of the uniform prior: CSV with columns parameter, lower, upper; without it Table 2 as the "
      "reading has it");
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
  const std::string doubt = friction::doubtful_unit_or_sign(o.phase_deg);
  if (!doubt.empty()) {
    fmt::print(stderr, "warning: {}: column 'phase_deg': {}\n", io::printable(path, 200), doubt);
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
  require_once(table, names, "parameter", "each parameter once");
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
    require_interval(table, row, lower[row], upper[row]);
    if (!(upper[row] >= smallest_bound && upper[row] <= largest_bound)) {
      table.fail(row, "upper", "a number from 1e-100 to 1e100");
    }
    const auto j = static_cast<std::size_t>(found - expected.begin());
    seen[j] = true;
    low[static_cast<Eigen::Index>(j)] = lower[row];
    high[static_cast<Eigen::Index>(j)] = upper[row];
  }
  for (std::size_t j = 0; j < seen.size(); ++j) {
    if (!seen[j]) {
      throw io::InputError({.path = path,
                            .column = "'parameter'",
                            .found = fmt::format("no row '{}'", expected[j]),
                            .expected = fmt::format("one row for each of {}", fmt::join(expected, ", "))});
    }
  }
  return {low, high};
}

NamedPrior read_named_prior(const std::string& path,
                            const std::function<void(const std::string& name)>& require_name) {
  const auto table = io::CsvTable::read(path);
  table.require_columns({"parameter", "lower", "upper"});
  auto names = table.text("parameter");
  require_once(table, names, "parameter", "each parameter once");
  const auto is_moderate = [](double x) { return std::abs(x) <= largest_bound; };
  const std::string expected = "a number from -1e100 to 1e100";
  const auto lower = checked(table, "lower", table.numbers("lower"), is_moderate, expected);
  const auto upper = checked(table, "upper", table.numbers("upper"), is_moderate, expected);
  for (std::size_t row = 0; row < names.size(); ++row) {
    try {
      require_name(names[row]);
    } catch (const errors::InvalidValue& error) {
      table.fail(row, "parameter", error.expected());
    }
    require_interval(table, row, lower[row], upper[row]);
    if (!(upper[row] - lower[row] >= smallest_bound)) {
      table.fail(
          row, "upper",
          fmt::format("a number at least 1e-100 above the lower bound {}", io::format_number(lower[row])));
    }
  }
  const auto n = static_cast<Eigen::Index>(names.size());
  return {std::move(names), {Eigen::VectorXd::Map(lower.data(), n), Eigen::VectorXd::Map(upper.data(), n)}};
}

tmcmc::BoxPrior prior_for(const InputFiles& inputs, const replication::Reading& reading) {
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
  } catch (const errors::InvalidValue& error) {
    if (inputs.prior.empty()) {  // Table 2 is valid: the observations leave no feasible force inside it
      throw io::InputError(fmt::format("{}: {}", inputs.observations, error.what()));
    }
    fail_prior(inputs.prior, error);
  }
}

}  // namespace experiments
