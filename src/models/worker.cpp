#include "models/worker.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <limits>
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

double value_of(std::string_view line) {
  const std::string_view text = line.substr(0, line.size() - (line.ends_with('\r') ? 1 : 0));
  double value = 0.0;
  const bool is_number = io::csv_text::parse_any_double(text, value).empty();
  if (!is_number || !(value < std::numeric_limits<double>::infinity())) {  // NaN and +inf are no likelihoods
    throw ModelError(fmt::format("wrote the log-likelihood '{}': expected a number or -inf",
                                 io::printable(text, longest_answer)));
  }
  return value;
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
  const WorkerOptions& options = state_->options;
  require_shape(points, log_likelihood, options.parameter_names.size());
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
          throw ModelError(fmt::format("wrote '{}' after the last of {} log-likelihoods",
                                       io::printable(line, longest_answer), row));
        }
        log_likelihood[row] = value_of(line);
        return ++row == points.rows();
      };
      process->exchange(text, deadline_after(options.timeout_seconds), take_line);
      state_->idle.give_back(std::move(process));
      return;
    } catch (const WorkerEnded& ended) {
      const std::string how = state_->explain(ended.end);
      if (is_second || ended.end.kind == ChildEnd::Kind::not_started ||
          ended.end.kind == ChildEnd::Kind::timed_out) {
        state_->fail(fmt::format("{} after {} of {} log-likelihoods{}", how, row, points.rows(),
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
