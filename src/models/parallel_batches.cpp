#include "models/parallel_batches.hpp"

#include <algorithm>
#include <utility>

#include "errors/invalid_value.hpp"
#include "tmcmc/parallel.hpp"

namespace models {
namespace {

using tmcmc::Index;
using Points = Eigen::Ref<const Eigen::MatrixXd>;

/// Calls evaluate(first, count) for batches of n rows.
template <class Evaluate>
void for_batches(Index n, const ParallelOptions& options, const Evaluate& evaluate) {
  const Index share = (n + options.calls - 1) / options.calls;
  const Index rows = options.batch_rows > 0 ? options.batch_rows : std::max<Index>(share, 1);
  tmcmc::for_each_block(n, rows, options.calls,
                        [&](Index, Index begin, Index end) { evaluate(begin, end - begin); });
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
    for_batches(points.rows(), options, [&](Index first, Index count) {
      model(points.middleRows(first, count), values.segment(first, count));
    });
  };
}

ForwardModel parallel_outputs(ForwardModel model, const ParallelOptions& options) {
  validate(options);
  return [model = std::move(model), options](const Points& points, Eigen::Ref<Eigen::MatrixXd> outputs) {
    for_batches(points.rows(), options, [&](Index first, Index count) {
      model(points.middleRows(first, count), outputs.middleRows(first, count));
    });
  };
}

}  // namespace models
