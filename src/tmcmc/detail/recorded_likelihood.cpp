#include "tmcmc/detail/recorded_likelihood.hpp"

#include <algorithm>
#include <cstring>
#include <utility>
#include <vector>

namespace tmcmc::detail {

namespace {

std::string bytes_of(const Eigen::RowVectorXd& point) {
  std::string bytes(static_cast<std::size_t>(point.size()) * sizeof(double), '\0');
  std::memcpy(bytes.data(), point.data(), bytes.size());
  return bytes;
}

}  // namespace

RecordedLikelihood::RecordedLikelihood(const LogLikelihood& log_likelihood, const Walkers& known, Index rows,
                                       EvaluationObserver observer)
    : log_likelihood_(log_likelihood),
      rows_(rows),
      observer_(std::move(observer)),
      evaluated_(known),
      count_(known.points.rows()),
      observed_(count_) {
  for (Index i = 0; i < count_; ++i) {
    known_.emplace(bytes_of(known.points.row(i)), known.log_likelihood[i]);
  }
}

void RecordedLikelihood::operator()(const Eigen::Ref<const Eigen::MatrixXd>& points,
                                    Eigen::Ref<Eigen::VectorXd> values) {
  std::vector<Index> unknown;
  for (Index i = 0; i < points.rows(); ++i) {
    const auto found = known_.empty() ? known_.end() : known_.find(bytes_of(points.row(i)));
    if (found == known_.end()) {
      unknown.push_back(i);
    } else {
      values[i] = found->second;
    }
  }
  for (std::size_t begin = 0; begin < unknown.size(); begin += static_cast<std::size_t>(rows_)) {
    const std::size_t end = std::min(unknown.size(), begin + static_cast<std::size_t>(rows_));
    const std::vector<Index> rows(unknown.begin() + static_cast<std::ptrdiff_t>(begin),
                                  unknown.begin() + static_cast<std::ptrdiff_t>(end));
    const Population chosen = points(rows, Eigen::all);
    Eigen::VectorXd results = values(rows);  // holds what tells values that are not written
    log_likelihood_(chosen, results);
    values(rows) = results;
    if (observer_) {
      remember(chosen, results);
    }
  }
}

void RecordedLikelihood::remember(const Population& points, const Eigen::VectorXd& values) {
  const std::scoped_lock lock(mutex_);
  const Index needed = count_ + points.rows();
  if (needed > evaluated_.points.rows()) {
    evaluated_.points.conservativeResize(2 * needed, points.cols());
    evaluated_.log_likelihood.conservativeResize(2 * needed);
  }
  evaluated_.points.middleRows(count_, points.rows()) = points;
  evaluated_.log_likelihood.segment(count_, points.rows()) = values;
  count_ = needed;
  if (count_ - observed_ >= rows_) {
    observed_ = count_;
    observer_({evaluated_.points.topRows(count_), evaluated_.log_likelihood.head(count_)});
  }
}

}  // namespace tmcmc::detail
