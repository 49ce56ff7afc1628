#include "distributed/share.hpp"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <mutex>

namespace distributed {

namespace {

using tmcmc::Index;
using Points = Eigen::Ref<const Eigen::MatrixXd>;

constexpr double seconds_a_task = 0.1;

std::string bytes_of(const double* values, Index count) {
  return {reinterpret_cast<const char*>(values), static_cast<std::size_t>(count) * sizeof(double)};
}

/// As many doubles as the bytes hold.
Eigen::VectorXd doubles_of(const std::string& bytes) {
  Eigen::VectorXd values(static_cast<Index>(bytes.size() / sizeof(double)));
  std::memcpy(values.data(), bytes.data(), bytes.size());
  return values;
}

/// Points in, one column a parameter; out come the log-likelihoods and the seconds that they took.
std::string evaluate(const tmcmc::Problem& problem, const std::string& task) {
  const Eigen::VectorXd numbers = doubles_of(task);
  const Index n = numbers.size() / problem.prior.dimension();
  const auto start = std::chrono::steady_clock::now();
  Eigen::VectorXd answer(n + 1);
  problem.log_likelihood(Eigen::Map<const Eigen::MatrixXd>(numbers.data(), n, problem.prior.dimension()),
                         answer.head(n));
  answer[n] = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return bytes_of(answer.data(), answer.size());
}

/// Hands out the rows of one call after the other. Times decide how many rows go together, and nothing else.
class SharedLogLikelihood {
 public:
  explicit SharedLogLikelihood(Farm& farm) : farm_(farm) {}

  void operator()(const Points& points, Eigen::Ref<Eigen::VectorXd> log_likelihood) {
    const std::lock_guard lock(mutex_);
    Index handed_out = 0;
    Index collected = 0;
    const auto next = [&]() -> std::optional<std::string> {
      const Index left = points.rows() - handed_out;
      if (left == 0) {
        return std::nullopt;
      }
      const Index n = rows_of_task(left);
      const Eigen::MatrixXd rows = points.middleRows(handed_out, n);
      handed_out += n;
      return bytes_of(rows.data(), rows.size());
    };
    farm_.run(next, [&](const std::string& result) {
      const Eigen::VectorXd answer = doubles_of(result);
      const Index n = answer.size() - 1;
      log_likelihood.segment(collected, n) = answer.head(n);
      collected += n;
      rows_ += static_cast<double>(n);
      seconds_ += answer[n];
    });
  }

 private:
  [[nodiscard]] Index rows_of_task(Index left) const {
    if (farm_.size() == 1) {
      return left;
    }
    const double affordable = rows_ == 0.0 ? 1.0 : seconds_a_task * rows_ / std::max(seconds_, 1e-9);
    const Index share = left / (Index{4} * farm_.size());
    return std::max(Index{1}, static_cast<Index>(std::min(affordable, static_cast<double>(share))));
  }

  Farm& farm_;
  std::mutex mutex_;
  double rows_ = 0.0;  // so far
  double seconds_ = 0.0;
};

}  // namespace

void share(Ranks& ranks, const tmcmc::Problem& problem,
           const std::function<void(const tmcmc::Problem&)>& lead) {
  const Work work = [&](const std::string& task) { return evaluate(problem, task); };
  lead_or_serve(ranks, work, [&](Farm& farm) {
    SharedLogLikelihood shared(farm);
    lead({std::ref(shared), problem.prior});
  });
}

}  // namespace distributed
