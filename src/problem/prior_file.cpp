#include "problem/prior_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>

#include "errors/invalid_value.hpp"
#include "io/csv_checks.hpp"
#include "tmcmc/distributions.hpp"

namespace problem {

namespace {

constexpr double smallest_width = 1e-100;  // the squares of noise levels are doubles

using Arguments = std::map<std::string, double, std::less<>>;

std::string_view cell_of(const io::CsvTable& table, std::size_t row, std::string_view column) {
  return table.has(column) ? table.cell(row, column) : std::string_view();
}

/// Whether the distribution has an argument of this name in any of its forms.
bool takes(std::string_view distribution, std::string_view argument) {
  const auto rows = tmcmc::distributions();
  return std::any_of(rows.begin(), rows.end(), [&](const tmcmc::Distribution& d) {
    return d.name == distribution &&
           std::find(d.arguments.begin(), d.arguments.end(), argument) != d.arguments.end();
  });
}

double number_in(const io::CsvTable& table, std::size_t row, const std::string& column, bool may_be_infinite,
                 const char* range = "a number from -1e100 to 1e100") {
  const auto number = table.find_number(row, column);
  if (!number || std::isnan(*number) || (std::isinf(*number) && !may_be_infinite)) {
    table.fail(row, column, may_be_infinite ? "a number, inf or -inf" : "a finite number");
  }
  if (!std::isinf(*number) && !(std::fabs(*number) <= largest_number)) {
    table.fail(row, column, range);
  }
  return *number;
}

/// The non-empty cells of the row, by the names of their columns.
Arguments arguments_of(const io::CsvTable& table, std::size_t row, const std::string& distribution,
                       bool nonnegative) {
  Arguments arguments;
  for (const std::string& column : argument_columns()) {
    if (cell_of(table, row, column).empty()) {
      continue;
    }
    if (!takes(distribution, column)) {
      table.fail(row, column,
                 fmt::format("an empty cell, since {} is stated by {}", distribution,
                             tmcmc::argument_names(distribution)));
    }
    const bool bound = column == "lower" || column == "upper";
    arguments[column] =
        number_in(table, row, column, bound && distribution == "truncated_normal",
                  nonnegative && bound ? "a number from 1e-100 to 1e100" : "a number from -1e100 to 1e100");
  }
  return arguments;
}

/// Refuses the bounds of a uniform row if there are no numbers between them.
void require_interval(const io::CsvTable& table, std::size_t row, double lower, double upper,
                      bool nonnegative) {
  if (nonnegative && !(lower >= 0.0)) {
    table.fail(row, "lower", "a number of at least 0");
  }
  const std::string above = "a number above the lower bound " + io::format_number(lower);
  if (!(lower < upper)) {
    table.fail(row, "upper", above);
  }
  if (!(std::nextafter(lower, upper) < upper)) {
    table.fail(row, "upper", above + ", with others between them");
  }
}

tmcmc::Marginal marginal_of(const io::CsvTable& table, std::size_t row, bool nonnegative) {
  const std::string_view named = cell_of(table, row, "distribution");
  const std::string distribution(named.empty() ? "uniform" : named);
  if (tmcmc::argument_names(distribution).empty()) {
    table.fail(row, "distribution", tmcmc::distribution_names());
  }
  Arguments arguments = arguments_of(table, row, distribution, nonnegative);
  if (distribution == "uniform") {
    for (const char* side : {"lower", "upper"}) {
      if (!arguments.contains(side)) {
        table.fail(row, table.has(side) ? side : "distribution",
                   "a finite number in the column of the bound");
      }
    }
    require_interval(table, row, arguments["lower"], arguments["upper"], nonnegative);
  }
  if (distribution == "truncated_normal") {  // a side that is not cut may stay empty
    arguments.try_emplace("lower", -std::numeric_limits<double>::infinity());
    arguments.try_emplace("upper", std::numeric_limits<double>::infinity());
  }
  try {
    return tmcmc::make_marginal(distribution, arguments);
  } catch (const errors::InvalidValue& error) {
    const bool has_cell = !cell_of(table, row, error.field()).empty();
    table.fail(row, has_cell ? error.field() : "distribution", error.expected());
  }
}

/// Refuses supports that the model does not allow, and scales whose squares are not doubles.
void require_support(const io::CsvTable& table, std::size_t row, const tmcmc::Marginal& marginal,
                     bool nonnegative) {
  const auto& [lower, upper] = marginal.support();
  const bool by_bounds = !cell_of(table, row, "lower").empty() && !cell_of(table, row, "upper").empty();
  if (nonnegative && !(lower >= 0.0)) {
    table.fail(row, by_bounds ? "lower" : "distribution",
               by_bounds
                   ? "a number of at least 0"
                   : "a distribution of positive numbers, such as log_normal, or truncated_normal from 0 on");
  }
  if (nonnegative && !(upper >= smallest_width)) {
    table.fail(row, by_bounds ? "upper" : "distribution", "a number from 1e-100 to 1e100");
  }
  if (!(upper - lower >= smallest_width)) {
    table.fail(row, by_bounds ? "upper" : "distribution",
               fmt::format("a number at least 1e-100 above the lower bound {}", io::format_number(lower)));
  }
}

std::size_t place_of(const std::vector<std::string>& names, std::string_view name) {
  return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

std::string any_of_these(const std::vector<std::string>& names) {
  return names.size() == 1
             ? names.front()
             : fmt::format("{} or {}", fmt::join(names.begin(), names.end() - 1, ", "), names.back());
}

tmcmc::Correlation read_correlations(const std::string& path,
                                     const std::vector<tmcmc::Parameter>& parameters) {
  std::vector<std::string> names;
  std::transform(parameters.begin(), parameters.end(), std::back_inserter(names),
                 [](const auto& p) { return p.name; });
  const auto table = io::CsvTable::read(path);
  const auto& columns = table.column_names();
  const std::string first = columns.front();
  if (first != "parameter" && first != "normal_score") {
    throw io::InputError(io::InputFault{
        .path = path,
        .line = 1,
        .found = fmt::format("header '{}'", io::printable(fmt::format("{}", fmt::join(columns, ",")), 200)),
        .expected = "a column 'parameter' first, or for correlations of normal scores 'normal_score'"});
  }
  for (std::size_t c = 1; c < columns.size(); ++c) {
    if (place_of(names, columns[c]) == names.size()) {
      table.fail(0, columns[c],
                 "a column for each of the parameters " + any_of_these(names) + ", and no other");
    }
  }
  const auto rows = table.text(first);
  io::require_once(table, rows, first, "each parameter once");
  const auto d = static_cast<Eigen::Index>(names.size());
  tmcmc::Correlation result{Eigen::MatrixXd::Identity(d, d), first == "parameter"
                                                                 ? tmcmc::CorrelationOf::parameters
                                                                 : tmcmc::CorrelationOf::normal_scores};
  std::vector<std::size_t> line(names.size(), names.size());
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const std::size_t i = place_of(names, rows[row]);
    if (i == names.size()) {
      table.fail(row, first, any_of_these(names));
    }
    line[i] = row;
    for (std::size_t c = 1; c < columns.size(); ++c) {
      const double value = number_in(table, row, columns[c], false);
      const std::size_t j = place_of(names, columns[c]);
      if (i == j ? value != 1.0 : !(std::fabs(value) < 1.0)) {
        table.fail(row, columns[c],
                   i == j ? "1, the correlation of a parameter with itself" : "a number between -1 and 1");
      }
      result.matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = value;
    }
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (line[i] == names.size() || !table.has(names[i])) {
      throw io::InputError(
          io::InputFault{.path = path,
                         .column = "'" + first + "'",
                         .found = "no row and column '" + names[i] + "'",
                         .expected = fmt::format("one for each of {}", fmt::join(names, ", "))});
    }
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const double value = result.matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
      const double other = result.matrix(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(i));
      if (value != other) {
        table.fail(line[i], names[j],
                   fmt::format("{}, as in line {} on the other side of the diagonal",
                               io::format_number(other), table.line(line[j])));
      }
      const Eigen::Matrix2d pair = (Eigen::Matrix2d() << 1.0, value, value, 1.0).finished();
      const std::array marginals = {parameters[i].marginal, parameters[j].marginal};
      try {  // each pair alone, to name its cell
        static_cast<void>(tmcmc::normal_score_correlation({pair, result.of}, marginals));
      } catch (const errors::InvalidValue& error) {
        table.fail(line[i], names[j], error.expected());
      }
    }
  }
  return result;
}

}  // namespace

std::vector<std::string> argument_columns() {
  std::vector<std::string> columns;
  for (const auto& distribution : tmcmc::distributions()) {
    for (const auto argument : distribution.arguments) {
      if (std::find(columns.begin(), columns.end(), argument) == columns.end()) {
        columns.emplace_back(argument);
      }
    }
  }
  return columns;
}

tmcmc::Prior read_prior(const PriorFiles& files, const ParameterRules& rules) {
  const auto table = io::CsvTable::read(files.marginals);
  if (table.has("distribution")) {
    table.require_columns({"parameter"});
  } else {
    table.require_columns({"parameter", "lower", "upper"});
  }
  const auto names = table.text("parameter");
  io::require_once(table, names, "parameter", "each parameter once");
  std::vector<std::optional<tmcmc::Parameter>> found(rules.names.empty() ? names.size() : rules.names.size());
  for (std::size_t row = 0; row < names.size(); ++row) {
    const std::size_t place = rules.names.empty() ? row : place_of(rules.names, names[row]);
    if (place == found.size()) {
      table.fail(row, "parameter", any_of_these(rules.names));
    }
    try {
      if (rules.require_name) {
        rules.require_name(names[row]);
      }
    } catch (const errors::InvalidValue& error) {
      table.fail(row, "parameter", error.expected());
    }
    const tmcmc::Marginal marginal = marginal_of(table, row, rules.nonnegative);
    require_support(table, row, marginal, rules.nonnegative);
    found[place] = tmcmc::Parameter{names[row], std::string(cell_of(table, row, "unit")), marginal};
  }
  std::vector<tmcmc::Parameter> parameters;
  for (std::size_t j = 0; j < found.size(); ++j) {
    if (!found[j]) {
      throw io::InputError(
          io::InputFault{.path = files.marginals,
                         .column = "'parameter'",
                         .found = fmt::format("no row '{}'", rules.names[j]),
                         .expected = fmt::format("one row for each of {}", fmt::join(rules.names, ", "))});
    }
    parameters.push_back(*found[j]);
  }
  if (files.correlations.empty()) {
    return tmcmc::Prior(std::move(parameters));
  }
  const auto correlation = read_correlations(files.correlations, parameters);
  try {
    return tmcmc::Prior(std::move(parameters), correlation);
  } catch (const errors::InvalidValue& error) {
    throw io::InputError(files.correlations + ": " + error.what());
  }
}

}  // namespace problem
