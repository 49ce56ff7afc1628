#include <mpi.h>

#include <array>
#include <chrono>
#include <exception>
#include <limits>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "io/interrupt.hpp"
#include "models/ranks.hpp"

namespace models {
namespace {

using tmcmc::Index;
using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Header = std::array<long, 2>;  // rows and columns of a batch

constexpr Header no_more = {-1, 0};

using Text = std::array<char, 4096>;  // of an exception; what is longer is cut off

// Errors of MPI itself end the program: that is MPI's default, and there is nothing to go on with.

/// Waits without a processor to itself, which MPI's own waiting takes.
void wait_for(MPI_Request request) {
  constexpr int eager_tests = 100;
  int is_complete = 0;
  for (int tests = 0; is_complete == 0; ++tests) {
    MPI_Test(&request, &is_complete, MPI_STATUS_IGNORE);
    if (is_complete == 0) {
      io::stop_if_interrupted();
      tests < eager_tests ? std::this_thread::yield()
                          : std::this_thread::sleep_for(std::chrono::microseconds(50));
    }
  }
}

Header broadcast(Header header) {
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Ibcast(header.data(), 2, MPI_LONG, 0, MPI_COMM_WORLD, &request);
  wait_for(request);
  return header;
}

/// How many numbers each rank has of a batch, and where they begin.
struct Parts {
  Parts(long rows, long columns, int ranks) {
    for (long rank = 0; rank < ranks; ++rank) {
      begins.push_back(static_cast<int>(rows * rank / ranks * columns));
      counts.push_back(static_cast<int>(rows * (rank + 1) / ranks * columns) - begins.back());
    }
  }
  std::vector<int> counts, begins;
};

/// Evaluates this rank's part of a batch; every rank calls it after the header.
/// \param points, log_likelihood  on rank 0 the batch
/// \throws on rank 0, for the lowest rank whose model failed.
void evaluate(const tmcmc::LogLikelihood& model, const Header& header, int rank, int ranks,
              const Rows& points, double* log_likelihood) {
  const auto [rows, columns] = header;
  const Parts of_points(rows, columns, ranks);
  const Parts of_values(rows, 1, ranks);
  const int count = of_values.counts[static_cast<std::size_t>(rank)];
  Rows mine(count, columns);
  Eigen::VectorXd values = Eigen::VectorXd::Constant(count, std::numeric_limits<double>::quiet_NaN());
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Iscatterv(points.data(), of_points.counts.data(), of_points.begins.data(), MPI_DOUBLE, mine.data(),
                static_cast<int>(mine.size()), MPI_DOUBLE, 0, MPI_COMM_WORLD, &request);
  wait_for(request);
  std::exception_ptr failure;
  Text text{};  // empty unless the model fails
  try {
    if (count > 0) {
      model(Eigen::MatrixXd(mine), values);
    }
  } catch (const std::exception& error) {
    failure = std::current_exception();
    const std::string what = std::string(error.what()) + ' ';  // not empty
    what.copy(text.data(), text.size() - 1);
  }
  MPI_Igatherv(values.data(), count, MPI_DOUBLE, log_likelihood, of_values.counts.data(),
               of_values.begins.data(), MPI_DOUBLE, 0, MPI_COMM_WORLD, &request);
  wait_for(request);
  std::vector<Text> texts(static_cast<std::size_t>(rank == 0 ? ranks : 0));
  MPI_Igather(&text, sizeof text, MPI_CHAR, texts.data(), sizeof text, MPI_CHAR, 0, MPI_COMM_WORLD, &request);
  wait_for(request);
  if (rank == 0 && failure) {
    std::rethrow_exception(failure);
  }
  for (const Text& other : texts) {
    if (other[0] != '\0') {
      const std::string what = other.data();
      throw std::runtime_error(what.substr(0, what.size() - 1));
    }
  }
}

}  // namespace

Ranks::Ranks(int& argc, char**& argv) {
  int provided = 0;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_SERIALIZED, &provided);
  if (provided < MPI_THREAD_SERIALIZED) {
    throw std::runtime_error(
        "this MPI cannot be called from several threads: expected MPI_THREAD_SERIALIZED");
  }
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &size_);
}

Ranks::~Ranks() {
  try {
    if (rank_ == 0) {
      broadcast(no_more);
    } else if (!is_done_) {
      serve([this](const auto&, auto) {
        throw std::runtime_error(
            "rank " + std::to_string(rank_) +
            " could not begin: expected the program to begin there too, and with one rank");
      });
    }
    MPI_Finalize();
  } catch (const io::Interrupted&) {
    io::die_of_interrupt();
  }
}

void Ranks::serve(const tmcmc::LogLikelihood& model) {
  for (Header header = broadcast(no_more); header != no_more; header = broadcast(no_more)) {
    evaluate(model, header, rank_, size_, {}, nullptr);
  }
  is_done_ = true;
}

std::optional<tmcmc::LogLikelihood> Ranks::share(const tmcmc::LogLikelihood& model) {
  if (rank_ > 0) {
    serve(model);
    return std::nullopt;
  }
  return [this, model, mutex = std::make_shared<std::mutex>()](
             const Eigen::Ref<const Eigen::MatrixXd>& points, Eigen::Ref<Eigen::VectorXd> log_likelihood) {
    if (points.size() > std::numeric_limits<int>::max()) {
      throw std::length_error("batch of " + std::to_string(points.size()) +
                              " numbers: expected fewer than 2^31");
    }
    const std::lock_guard lock(*mutex);
    const Header header = broadcast({points.rows(), points.cols()});
    evaluate(model, header, rank_, size_, points, log_likelihood.data());
  };
}

}  // namespace models
