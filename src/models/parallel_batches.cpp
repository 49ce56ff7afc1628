#include "models/parallel_batches.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "errors/invalid_value.hpp"

namespace models {
namespace {

using tmcmc::Index;
using Points = Eigen::Ref<const Eigen::MatrixXd>;

/// Keeps the exception of the call with the lowest rows.
class FirstFailure {
 public:
  void note(Index first_row) {
    const std::lock_guard lock(mutex_);
    has_failed_ = true;
    if (!exception_ || first_row < first_row_) {
      exception_ = std::current_exception();
      first_row_ = first_row;
    }
  }
  [[nodiscard]] bool has_failed() const { return has_failed_; }
  void rethrow() const {
    if (exception_) {
      std::rethrow_exception(exception_);
    }
  }

 private:
  std::mutex mutex_;
  std::atomic<bool> has_failed_ = false;
  std::exception_ptr exception_;
  Index first_row_ = 0;
};

/// Calls evaluate(first, count) for batches of n rows.
template <class Evaluate>
void for_batches(Index n, const ParallelOptions& options, const Evaluate& evaluate) {
  const Index share = (n + options.calls - 1) / options.calls;
  const Index rows = options.batch_rows > 0 ? std::min(options.batch_rows, n) : share;
  const Index batches = (n + rows - 1) / rows;
  std::atomic<Index> next = 0;
  FirstFailure failure;
  const auto work = [&] {
    for (Index batch = next++; batch < batches && !failure.has_failed(); batch = next++) {
      const Index first = batch * rows;
      const Index count = std::min(rows, n - first);
      try {
        evaluate(first, count);
      } catch (...) {
        failure.note(first);
      }
    }
  };
  {
    std::vector<std::jthread> others;
    for (Index i = 1; i < std::min<Index>(options.calls, batches); ++i) {
      others.emplace_back(work);
    }
    work();
  }
  failure.rethrow();
}

void validate(const ParallelOptions& options) {
  if (options.calls < 1) {
    throw errors::InvalidValue("calls", options.calls, "at least 1");
  }
  if (options.batch_rows < 0) {
    throw errors::InvalidValue("batch_rows", options.batch_rows, "a number of rows, or 0 for equal shares");
  }
}

}  // namespace

tmcmc::LogLikelihood parallel_batches(tmcmc::LogLikelihood model, const ParallelOptions& options) {
  validate(options);
  return [model = std::move(model), options](const Points& points, Eigen::Ref<Eigen::VectorXd> values) {
    if (points.rows() > 0) {
      for_batches(points.rows(), options, [&](Index first, Index count) {
        model(points.middleRows(first, count), values.segment(first, count));
      });
    }
  };
}

ForwardModel parallel_outputs(ForwardModel model, const ParallelOptions& options) {
  validate(options);
  return [model = std::move(model), options](const Points& points, Eigen::Ref<Eigen::MatrixXd> outputs) {
    if (points.rows() > 0) {
      for_batches(points.rows(), options, [&](Index first, Index count) {
        model(points.middleRows(first, count), outputs.middleRows(first, count));
      });
    }
  };
}

}  // namespace models
