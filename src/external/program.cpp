#include "external/program.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#include <optional>

#include "external/child.hpp"
#include "io/csv.hpp"
#include "io/scratch_directory.hpp"

namespace external {

namespace {

namespace fs = std::filesystem;

const std::string scratch_name = "log-likelihood";
const std::string points_name = "points.csv";
const std::string results_name = "log_likelihoods.csv";
const std::string column = "log_likelihood";

std::string end_of(const ChildEnd& end, double timeout_seconds) {
  switch (end.kind) {
    case ChildEnd::Kind::exited:
      return end.value == 0 ? std::string() : fmt::format("ended with status {}: expected 0", end.value);
    case ChildEnd::Kind::signalled:
      return fmt::format("was ended by signal {} ({}): expected an exit", end.value, strsignal(end.value));
    case ChildEnd::Kind::timed_out:
      return fmt::format("took more than {} s and was killed", io::format_number(timeout_seconds));
    case ChildEnd::Kind::not_started:
      return fmt::format("could not be started: {}", std::strerror(end.value));
  }
  return {};
}

/// A log-likelihood, or nothing: NaN and +inf are no likelihoods.
std::optional<double> log_likelihood_in(const io::CsvTable& table, Eigen::Index row) {
  try {
    const double value = table.number_or_nan(static_cast<std::size_t>(row), column);
    return value < std::numeric_limits<double>::infinity() ? std::optional(value) : std::nullopt;
  } catch (const io::InputError&) {
    return std::nullopt;
  }
}

}  // namespace

Program::Program(ProgramOptions options) : options_(std::move(options)) {
  if (options_.parameter_names.empty()) {
    throw std::invalid_argument("parameter_names: expected at least one");
  }
  if (!(options_.timeout_seconds >= 0.0) || !std::isfinite(options_.timeout_seconds)) {
    throw std::invalid_argument(fmt::format("timeout_seconds = {}: expected a finite number of at least 0",
                                            options_.timeout_seconds));
  }
  std::error_code error;
  const bool is_file = fs::is_regular_file(options_.program, error);
  if (!is_file || access(options_.program.c_str(), X_OK) != 0) {
    throw ProgramError(fmt::format("{}: {}: expected a program that can be run",
                                   io::printable(options_.program, 200),
                                   is_file ? std::strerror(errno)
                                   : error ? error.message()
                                           : "not a file"));
  }
  options_.program = fs::absolute(options_.program).string();
}

void Program::operator()(const Eigen::Ref<const Eigen::MatrixXd>& points,
                         Eigen::Ref<Eigen::VectorXd> log_likelihood) const {
  const auto fail = [&](const std::string& what, Eigen::Index row, bool first_of_batch) {
    std::string point;
    for (Eigen::Index j = 0; j < points.cols(); ++j) {
      point +=
          fmt::format("{}{} = {}", j > 0 ? ", " : "", options_.parameter_names[static_cast<std::size_t>(j)],
                      io::format_number(points(row, j)));
    }
    throw ProgramError(fmt::format("{}: {}; {} ({})", io::printable(options_.program, 200), what,
                                   first_of_batch ? fmt::format("the first of {} points", points.rows())
                                                  : fmt::format("point {} of {}", row + 1, points.rows()),
                                   point));
  };
  if (points.cols() != static_cast<Eigen::Index>(options_.parameter_names.size()) ||
      log_likelihood.size() != points.rows()) {
    throw std::invalid_argument(
        fmt::format("external::Program: {} x {} points and {} results: expected {} columns and as "
                    "many results as points",
                    points.rows(), points.cols(), log_likelihood.size(), options_.parameter_names.size()));
  }
  if (points.rows() == 0) {
    return;
  }
  const io::ScratchDirectory scratch(scratch_name);
  const std::string input = scratch.path() + "/" + points_name;
  const std::string output = scratch.path() + "/" + results_name;
  io::CsvWriter writer(input, options_.parameter_names);
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    const Eigen::VectorXd row = points.row(i);
    writer.row(std::span<const double>(row.data(), static_cast<std::size_t>(row.size())));
  }
  writer.commit();

  const ChildEnd end = run_child({options_.program, input, output}, scratch.path(), options_.timeout_seconds);
  if (const std::string what = end_of(end, options_.timeout_seconds); !what.empty()) {
    fail(what, 0, true);
  }
  if (!fs::is_regular_file(output)) {
    fail("wrote no log-likelihoods", 0, true);
  }
  try {
    const auto table = io::CsvTable::read(output);
    table.require_columns({column});
    const auto rows = static_cast<Eigen::Index>(table.rows());
    for (Eigen::Index i = 0; i < std::min(rows, points.rows()); ++i) {
      const auto value = log_likelihood_in(table, i);
      if (!value) {
        fail(fmt::format("wrote the log-likelihood '{}': expected a number or -inf",
                         io::printable(table.cell(static_cast<std::size_t>(i), column))),
             i, false);
      }
      log_likelihood[i] = *value;
    }
    if (rows != points.rows()) {
      fail(fmt::format("wrote {} log-likelihoods for {} points", rows, points.rows()),
           std::min(rows, points.rows() - 1), false);
    }
  } catch (const io::InputError& error) {
    std::string what = error.what();
    if (const auto at = what.find(output); at != std::string::npos) {
      what.replace(at, output.size(), results_name);
    }
    fail("wrote what cannot be read: " + what, 0, true);
  }
}

}  // namespace external
