#include "models/program.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <utility>

#include "io/csv.hpp"
#include "io/scratch_directory.hpp"
#include "models/child.hpp"
#include "models/echo.hpp"
#include "models/model_error.hpp"
#include "models/start_failure.hpp"

namespace models {

namespace {

namespace fs = std::filesystem;

const std::string scratch_name = "log-likelihood";
const std::string points_name = "points.csv";
const std::string results_name = "log_likelihoods.csv";
const std::string column = "log_likelihood";

}  // namespace

Program::Program(ProgramOptions options) : options_(std::move(options)) {
  require_options(options_.parameter_names, options_.timeout_seconds);
  options_.program = runnable_path(options_.program);
}

void Program::operator()(const Eigen::Ref<const Eigen::MatrixXd>& points,
                         Eigen::Ref<Eigen::VectorXd> log_likelihood) const {
  evaluate(points, Eigen::Map<Eigen::MatrixXd>(log_likelihood.data(), log_likelihood.size(), 1));
}

std::vector<std::string> Program::columns_in(const io::CsvTable& table) const {
  if (options_.outputs == 0) {
    table.require_columns({column});
    return {column};
  }
  std::vector<std::string> columns;
  const auto& names = options_.parameter_names;
  std::copy_if(table.column_names().begin(), table.column_names().end(), std::back_inserter(columns),
               [&](const auto& name) { return std::find(names.begin(), names.end(), name) == names.end(); });
  if (columns.size() != options_.outputs) {
    throw io::InputError({.path = table.path(),
                          .line = 1,
                          .found = fmt::format("{} columns of outputs", columns.size()),
                          .expected = fmt::format("{}, one for each observation", options_.outputs)});
  }
  return columns;
}

void Program::evaluate(const Eigen::Ref<const Eigen::MatrixXd>& points,
                       Eigen::Ref<Eigen::MatrixXd> values) const {
  const auto fail = [&](const std::string& what, Eigen::Index row, bool first_of_batch) {
    const auto& names = options_.parameter_names;
    throw ModelError(fmt::format(
        "{}: {}; {}", io::printable(options_.program, 200), what,
        first_of_batch ? describe_first_point(names, points) : describe_point(names, points, row)));
  };
  require_shape(points, values, options_.parameter_names.size(), options_.outputs);
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
  if (const std::string what = explain_end(options_.program, end, options_.timeout_seconds); !what.empty()) {
    fail(what, 0, true);
  }
  if (!fs::is_regular_file(output)) {
    fail("wrote no log-likelihoods", 0, true);
  }
  try {
    const auto table = io::CsvTable::read(output);
    const auto columns = columns_in(table);
    const auto rows = static_cast<Eigen::Index>(table.rows());
    const Echo echo(table, options_.parameter_names);
    for (Eigen::Index i = 0; i < std::min(rows, points.rows()); ++i) {
      if (const std::string what = echo.mismatch(i, points.row(i).transpose()); !what.empty()) {
        fail(what, i, false);
      }
      const auto row = static_cast<std::size_t>(i);
      for (std::size_t k = 0; k < columns.size(); ++k) {
        const auto value = table.find_number(row, columns[k]);
        if (!value || !is_admitted(*value, options_.outputs)) {
          fail(fmt::format("wrote the {} '{}': expected {}",
                           options_.outputs > 0 ? io::printable(columns[k]) : "log-likelihood",
                           io::printable(table.cell(row, columns[k])), admitted(options_.outputs)),
               i, false);
        }
        values(i, static_cast<Eigen::Index>(k)) = *value;
      }
    }
    if (rows != points.rows()) {
      fail(fmt::format("wrote {} {} for {} points", rows,
                       options_.outputs > 0 ? "rows of outputs" : "log-likelihoods", points.rows()),
           std::min(rows, points.rows() - 1), false);
    }
  } catch (const io::InputError& error) {
    io::InputFault fault = error.fault();
    fault.path = results_name;  // its directory is gone when the message is read
    fail("wrote what cannot be read: " + io::describe(fault), 0, true);
  }
}

}  // namespace models
