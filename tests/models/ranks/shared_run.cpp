// A run whose log-likelihood all ranks evaluate, with a checkpoint: what ranks.sh starts under
// mpirun.
//
//     shared_run MOVES FAULT OUTPUT CHECKPOINT
//
// MOVES: resample-move, threads (the same, with calls from three threads) or waste-free. FAULT:
// none; nan or throw, of every point of a corner that many draws from the prior fall into; die:R:N,
// rank R kills itself at its N-th row. OUTPUT gets the last checkpoint, and OUTPUT.rows.R the
// number of rows that rank R has evaluated.

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>
#include <thread>

#include "models/ranks.hpp"
#include "storage/checkpoint.hpp"
#include "tmcmc/problems.hpp"

namespace {

tmcmc::Options options_of(const std::string& moves) {
  tmcmc::Options options = moves == "waste-free" ? tmcmc::recommended_moves(2600) : problems::few_samples();
  options.batch_rows = 0;
  options.threads = moves == "threads" ? 3 : 1;
  return options;
}

class Model {
 public:
  Model(const std::string& fault, int rank) : fault_(fault) {
    int dying_rank = -1;
    long dying_row = 0;
    if (std::sscanf(fault.c_str(), "die:%d:%ld", &dying_rank, &dying_row) == 2 && dying_rank == rank) {
      dies_at_ = dying_row;
    }
  }

  double operator()(double x, double y, double ridge) {
    std::this_thread::sleep_for(std::chrono::microseconds(100));
    if (++rows_ == dies_at_) {
      std::raise(SIGKILL);
    }
    const bool in_corner = x < -2.0 && y > 2.0;
    if (in_corner && fault_ == "throw") {
      std::ostringstream message;
      message.precision(17);
      message << "the model failed at (" << x << ", " << y << ")";
      throw tmcmc::SamplingError(message.str());
    }
    return in_corner && fault_ == "nan" ? std::numeric_limits<double>::quiet_NaN() : ridge;
  }

  [[nodiscard]] long rows() const { return rows_; }

 private:
  std::string fault_;
  long dies_at_ = 0;
  long rows_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
  models::Ranks ranks(argc, argv);
  const std::string moves = argv[1];
  const std::string output = argv[3];
  const std::filesystem::path checkpoint = argv[4];
  Model model(argv[2], ranks.rank());
  const tmcmc::Problem ridge = problems::ridge();
  const tmcmc::Problem problem{
      [&](const Eigen::Ref<const Eigen::MatrixXd>& points, Eigen::Ref<Eigen::VectorXd> values) {
        ridge.log_likelihood(points, values);
        for (tmcmc::Index i = 0; i < values.size(); ++i) {
          values[i] = model(points(i, 0), points(i, 1), values[i]);
        }
      },
      ridge.prior};
  int status = 0;
  try {
    if (const auto shared = ranks.share(problem.log_likelihood)) {
      const storage::RunDescription run{options_of(moves), {.seed = 5}, problem.prior, "the ridge"};
      static_cast<void>(storage::run_with_checkpoint(checkpoint, run, *shared));
      std::filesystem::rename(checkpoint, output);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    status = 1;
  }
  std::ofstream(output + ".rows." + std::to_string(ranks.rank())) << model.rows() << '\n';
  return status;
}
