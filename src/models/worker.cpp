#include "models/worker.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <string_view>
#include <utility>

#include "io/csv.hpp"
#include "io/csv_text.hpp"
#include "models/model_error.hpp"
#include "models/pool.hpp"
#include "models/start_failure.hpp"
#include "models/worker_process.hpp"

namespace models {
namespace {

constexpr std::size_t longest_answer = 80;

/// Bytes that the numbers of a line may take.
std::size_t longest_line(std::size_t outputs) {
  return 4096 + 64 * outputs;
}

std::string text_of(const Eigen::Ref<const Eigen::MatrixXd>& points) {
  std::string text = fmt::format("{}\n", points.rows());
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    for (Eigen::Index j = 0; j < points.cols(); ++j) {
      text += io::format_number(points(i, j));
      text += j + 1 < points.cols() ? ',' : '\n';
    }
  }
  return text;
}

/// The numbers of a line, one for each element of `values`.
template <class Values>
void read_line(std::string_view line, std::size_t outputs, Values values) {
  std::string_view rest = line.substr(0, line.size() - (line.ends_with('\r') ? 1 : 0));
  const std::string shown = io::printable(rest, longest_answer);
  for (Eigen::Index k = 0; k < values.size(); ++k) {
    const std::size_t comma = std::min(rest.find(','), rest.size());
    const bool is_last = k + 1 == values.size();
    const std::string_view text = is_last ? rest : rest.substr(0, comma);
    double value = 0.0;
    if (!io::csv_text::parse_any_double(text, value).empty() || !is_admitted(value, outputs) ||
        (!is_last && comma == rest.size())) {
      throw ModelError(
          outputs == 0
              ? fmt::format("wrote the log-likelihood '{}': expected a number or -inf", shown)
              : fmt::format("wrote the line '{}': expected {} outputs with commas between them, each {}",
                            shown, outputs, admitted(outputs)));
    }
    values[k] = value;
    rest.remove_prefix(std::min(comma + 1, rest.size()));
  }
}

}  // namespace

struct Worker::State {
  WorkerOptions options;
  Pool<WorkerProcess> idle;
  std::atomic<long> restarts = 0;

  [[nodiscard]] std::string explain(const ChildEnd& end) const {
    const std::string failure = explain_end(options.program, end, options.timeout_seconds);
    return failure.empty() ? "ended with status 0: expected it to go on until its standard input ends"
                           : failure;
  }

  [[noreturn]] void fail(const std::string& what, const Eigen::Ref<const Eigen::MatrixXd>& points,
                         Eigen::Index row) const {
    throw ModelError(fmt::format("{}: {}; {}", io::printable(options.program, longest_answer), what,
                                 row == 0 ? describe_first_point(options.parameter_names, points)
                                          : describe_point(options.parameter_names, points, row)));
  }
};

Worker::Worker(WorkerOptions options) : state_(std::make_shared<State>()) {
  require_options(options.parameter_names, options.timeout_seconds);
  options.program = runnable_path(options.program);
  state_->options = std::move(options);
}

void Worker::operator()(const Eigen::Ref<const Eigen::MatrixXd>& points,
                        Eigen::Ref<Eigen::VectorXd> log_likelihood) const {
  evaluate(points, Eigen::Map<Eigen::MatrixXd>(log_likelihood.data(), log_likelihood.size(), 1));
}

void Worker::evaluate(const Eigen::Ref<const Eigen::MatrixXd>& points,
                      Eigen::Ref<Eigen::MatrixXd> values) const {
  const WorkerOptions& options = state_->options;
  require_shape(points, values, options.parameter_names.size(), options.outputs);
  const std::string what = options.outputs > 0 ? "lines of outputs" : "log-likelihoods";
  if (points.rows() == 0) {
    return;
  }
  std::vector<std::string> arguments = options.parameter_names;
  arguments.insert(arguments.begin(), options.program);
  const std::string text = text_of(points);
  auto process = state_->idle.take();
  for (bool is_second = false;; is_second = true) {
    if (!process) {
      process = std::make_unique<WorkerProcess>(arguments);
    }
    Eigen::Index row = 0;
    try {
      const auto take_line = [&](std::string_view line) {
        if (row == points.rows()) {
          throw ModelError(fmt::format("wrote '{}' after the last of {} {}",
                                       io::printable(line, longest_answer), row, what));
        }
        read_line(line, options.outputs, values.row(row));
        return ++row == points.rows();
      };
      process->exchange(text, deadline_after(options.timeout_seconds), longest_line(options.outputs),
                        take_line);
      state_->idle.give_back(std::move(process));
      return;
    } catch (const WorkerEnded& ended) {
      const std::string how = state_->explain(ended.end);
      if (is_second || ended.end.kind == ChildEnd::Kind::not_started ||
          ended.end.kind == ChildEnd::Kind::timed_out) {
        state_->fail(fmt::format("{} after {} of {} {}{}", how, row, points.rows(), what,
                                 is_second ? ", as did the worker before it" : ""),
                     points, row);
      }
      ++state_->restarts;
      options.on_restart(
          fmt::format("{}: {}; started again", io::printable(options.program, longest_answer), how));
      process.reset();
    } catch (const ModelError& error) {
      state_->fail(error.what(), points, std::min(row, points.rows() - 1));
    }
  }
}

long Worker::restarts() const {
  return state_->restarts;
}

}  // namespace models
