// How much faster a batch of a slow model is on several ranks: rows that sleep, evaluated in one
// call of the log-likelihood by one rank and by all. `make bench-mpi` starts it with 1 and 2 ranks.
//
//     mpirun -np RANKS shared_batch [ROWS [MILLISECONDS]]

#include <fmt/format.h>

#include <chrono>
#include <cstdlib>
#include <thread>

#include "models/ranks.hpp"

namespace {

double seconds_of(const tmcmc::LogLikelihood& log_likelihood, const Eigen::MatrixXd& points) {
  Eigen::VectorXd values(points.rows());
  const auto start = std::chrono::steady_clock::now();
  log_likelihood(points, values);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

int main(int argc, char** argv) {
  models::Ranks ranks(argc, argv);
  const long rows = argc > 1 ? std::atol(argv[1]) : 1000;
  const std::chrono::duration<double, std::milli> time_of_row(argc > 2 ? std::atof(argv[2]) : 10.0);
  const tmcmc::LogLikelihood model = [&](const Eigen::Ref<const Eigen::MatrixXd>& points,
                                         Eigen::Ref<Eigen::VectorXd> values) {
    for (tmcmc::Index i = 0; i < values.size(); ++i) {
      std::this_thread::sleep_for(time_of_row);
      values[i] = points(i, 0);
    }
  };
  if (const auto shared = ranks.share(model)) {
    const tmcmc::BoxPrior prior(Eigen::Vector4d::Zero(), Eigen::Vector4d::Ones());
    const Eigen::MatrixXd points = prior.sample(rows, {});
    const double all = seconds_of(*shared, points);
    const double alone = seconds_of(model, points);
    fmt::print(
        "{} rows of {} ms: {:.3f} s by rank 0 alone, {:.3f} s by {} ranks, ratio {:.3f} (ideal {:.3f})\n",
        rows, time_of_row.count(), alone, all, ranks.size(), all / alone, 1.0 / ranks.size());
  }
}
