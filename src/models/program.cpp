#include "models/program.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#include <system_error>

#include "errors/invalid_value.hpp"
#include "io/csv.hpp"
#include "io/scratch_directory.hpp"
#include "models/child.hpp"
#include "models/echo.hpp"
#include "models/start_failure.hpp"

namespace models {

namespace {

namespace fs = std::filesystem;

const std::string scratch_name = "log-likelihood";
const std::string points_name = "points.csv";
const std::string results_name = "log_likelihoods.csv";
const std::string column = "log_likelihood";

std::string end_of(const ChildEnd& end, const ProgramOptions& options) {
  switch (end.kind) {
    case ChildEnd::Kind::exited:
      return end.value == 0 ? std::string()
                            : fmt::format("ended with status {}{}: expected 0", end.value,
                                          explain_command_not_run(options.program, end.value));
    case ChildEnd::Kind::signalled:
      return fmt::format("was ended by signal {} ({}): expected an exit", end.value, strsignal(end.value));
    case ChildEnd::Kind::timed_out:
      return fmt::format("took more than {} s and was killed", io::format_number(options.timeout_seconds));
    case ChildEnd::Kind::not_started:
      return "could not be started: " + explain_start_failure(options.program, end.value);
  }
  return {};
}

}  // namespace

Program::Program(ProgramOptions options) : options_(std::move(options)) {
  if (options_.parameter_names.empty()) {
    throw errors::InvalidValue("parameter_names", "", "at least one name");
  }
  if (!(options_.timeout_seconds >= 0.0) || !std::isfinite(options_.timeout_seconds)) {
    throw errors::InvalidValue("timeout_seconds", io::format_number(options_.timeout_seconds),
                               "a finite number of at least 0");
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
    throw errors::InvalidValue(
        "points", fmt::format("{} x {} with {} results", points.rows(), points.cols(), log_likelihood.size()),
        fmt::format("{} columns and as many results as points", options_.parameter_names.size()));
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
  if (const std::string what = end_of(end, options_); !what.empty()) {
    fail(what, 0, true);
  }
  if (!fs::is_regular_file(output)) {
    fail("wrote no log-likelihoods", 0, true);
  }
  try {
    const auto table = io::CsvTable::read(output);
    table.require_columns({column});
    const auto rows = static_cast<Eigen::Index>(table.rows());
    const Echo echo(table, options_.parameter_names);
    for (Eigen::Index i = 0; i < std::min(rows, points.rows()); ++i) {
      if (const std::string what = echo.mismatch(i, points.row(i).transpose()); !what.empty()) {
        fail(what, i, false);
      }
      const auto row = static_cast<std::size_t>(i);
      const auto value = table.find_number(row, column);
      if (!value || !(*value < std::numeric_limits<double>::infinity())) {  // NaN and +inf are no likelihoods
        fail(fmt::format("wrote the log-likelihood '{}': expected a number or -inf",
                         io::printable(table.cell(row, column))),
             i, false);
      }
      log_likelihood[i] = *value;
    }
    if (rows != points.rows()) {
      fail(fmt::format("wrote {} log-likelihoods for {} points", rows, points.rows()),
           std::min(rows, points.rows() - 1), false);
    }
  } catch (const io::InputError& error) {
    io::InputFault fault = error.fault();
    fault.path = results_name;  // its directory is gone when the message is read
    fail("wrote what cannot be read: " + io::describe(fault), 0, true);
  }
}

}  // namespace models
