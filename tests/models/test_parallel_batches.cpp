#include <atomic>
#include <catch2/catch.hpp>
#include <mutex>
#include <stdexcept>
#include <thread>

#include "errors/invalid_value.hpp"
#include "models/parallel_batches.hpp"

using models::parallel_batches;
using models::parallel_outputs;

namespace {

using Points = Eigen::Ref<const Eigen::MatrixXd>;
using Values = Eigen::Ref<Eigen::VectorXd>;

void sum_of_squares(const Points& points, Values values) {
  values = -points.rowwise().squaredNorm();
}

}  // namespace

TEST_CASE("a batch has the same values however it is cut", "[models][parallel]") {
  const Eigen::MatrixXd points = Eigen::MatrixXd::Random(103, 3);
  const Eigen::VectorXd whole = -points.rowwise().squaredNorm();
  for (const int calls : {1, 2, 7, 200}) {
    for (const Eigen::Index rows : {0, 1, 10, 103, 1000}) {
      Eigen::VectorXd values(103);
      parallel_batches(sum_of_squares, {calls, rows})(points, values);
      CHECK(values == whole);
    }
  }
  Eigen::VectorXd none(0);
  parallel_batches(sum_of_squares, {3, 0})(points.topRows(0), none);
}

TEST_CASE("a batch has the same outputs however it is cut", "[models][parallel]") {
  const Eigen::MatrixXd points = Eigen::MatrixXd::Random(103, 3);
  std::atomic<Eigen::Index> longest = 0;
  const models::ForwardModel model = [&](const Points& some, Eigen::Ref<Eigen::MatrixXd> outputs) {
    for (Eigen::Index seen = longest;
         seen < some.rows() && !longest.compare_exchange_weak(seen, some.rows());) {
    }
    outputs = some.rowwise().reverse();
  };
  for (const int calls : {1, 2, 7, 200}) {
    for (const Eigen::Index rows : {0, 1, 10, 103, 1000}) {
      Eigen::MatrixXd outputs(103, 3);
      longest = 0;
      parallel_outputs(model, {calls, rows})(points, outputs);
      CHECK(outputs == points.rowwise().reverse());
      CHECK(longest == std::min<Eigen::Index>(rows > 0 ? rows : (103 + calls - 1) / calls, 103));
    }
  }
  Eigen::MatrixXd none(0, 3);
  parallel_outputs(model, {3, 0})(points.topRows(0), none);
}

TEST_CASE("no call gets more rows than allowed, and so many run at a time", "[models][parallel]") {
  std::atomic<int> calls = 0, running = 0, most = 0;
  std::atomic<Eigen::Index> longest = 0;
  const auto model = [&](const Points& points, Values values) {
    ++calls;
    const int now = ++running;
    for (int seen = most; seen < now && !most.compare_exchange_weak(seen, now);) {
    }
    for (Eigen::Index seen = longest;
         seen < points.rows() && !longest.compare_exchange_weak(seen, points.rows());) {
    }
    while (calls < 4) {  // the first four meet
      std::this_thread::yield();
    }
    values.setZero();
    --running;
  };
  Eigen::VectorXd values(10);
  parallel_batches(model, {4, 2})(Eigen::MatrixXd::Zero(10, 1), values);
  CHECK(calls == 5);
  CHECK(most == 4);
  CHECK(longest == 2);
}

TEST_CASE("the failure of the lowest rows is thrown, and nothing begins after a failure",
          "[models][parallel]") {
  std::atomic<int> calls = 0;
  const auto model = [&](const Points& points, Values) {
    ++calls;
    while (calls < 2) {
      std::this_thread::yield();
    }
    throw std::runtime_error(std::to_string(static_cast<int>(points(0, 0))));
  };
  const Eigen::MatrixXd points = Eigen::VectorXd::LinSpaced(100, 0.0, 99.0);
  Eigen::VectorXd values(100);
  CHECK_THROWS_WITH(parallel_batches(model, {2, 1})(points, values), "0");
  CHECK(calls == 2);
}

TEST_CASE("calls and rows that make no sense are refused", "[models][parallel]") {
  CHECK_THROWS_AS(parallel_batches(sum_of_squares, {0, 0}), errors::InvalidValue);
  CHECK_THROWS_AS(parallel_batches(sum_of_squares, {1, -1}), errors::InvalidValue);
  CHECK_THROWS_AS(parallel_outputs({}, {0, 0}), errors::InvalidValue);
}
