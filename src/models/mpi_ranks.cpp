#include <mpi.h>

#include <algorithm>
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
/// Rows and columns of a batch, and the number of outputs per point, 0 for the log-likelihood.
using Header = std::array<long, 3>;

constexpr Header no_more = {-1, 0, 0};

using Text = std::array<char, 4096>;  // of an exception; what is longer is cut off

// Errors of MPI itself end the program: this is MPI's default, and the run could not continue
// anyway.

/// Waits without occupying a processor, as MPI's own waiting does.
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
  MPI_Ibcast(header.data(), 3, MPI_LONG, 0, MPI_COMM_WORLD, &request);
  wait_for(request);
  return header;
}

/// How many numbers of a batch each rank has, and where they begin.
struct Parts {
  Parts(long rows, long columns, int ranks) {
    for (long rank = 0; rank < ranks; ++rank) {
      begins.push_back(static_cast<int>(rows * rank / ranks * columns));
      counts.push_back(static_cast<int>(rows * (rank + 1) / ranks * columns) - begins.back());
    }
  }
  std::vector<int> counts, begins;
};

/// Fills in the values of this rank's points, one row per point.
void fill(Eigen::MatrixXd& values, const SharedModel& model, const Eigen::MatrixXd& points, long outputs) {
  if (outputs == 0) {
    model.log_likelihood(points, values.col(0));
  } else {
    model.outputs(points, values);
  }
}

/// Evaluates this rank's part of a batch; every rank calls it after the header.
/// \param points, all_values  on rank 0 the whole batch, row after row
/// \throws on rank 0, the exception of the lowest rank whose model failed.
void evaluate(const SharedModel& model, const Header& header, int rank, int ranks, const Rows& points,
              double* all_values) {
  const auto [rows, columns, outputs] = header;
  const long width = std::max(outputs, 1L);
  const Parts of_points(rows, columns, ranks);
  const Parts of_values(rows, width, ranks);
  const long count = of_values.counts[static_cast<std::size_t>(rank)] / width;
  Rows mine(count, columns);
  Eigen::MatrixXd values = Eigen::MatrixXd::Constant(count, width, std::numeric_limits<double>::quiet_NaN());
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Iscatterv(points.data(), of_points.counts.data(), of_points.begins.data(), MPI_DOUBLE, mine.data(),
                static_cast<int>(mine.size()), MPI_DOUBLE, 0, MPI_COMM_WORLD, &request);
  wait_for(request);
  std::exception_ptr failure;
  Text text{};  // empty unless the model fails
  try {
    if (count > 0) {
      fill(values, model, mine, outputs);
    }
  } catch (const std::exception& error) {
    failure = std::current_exception();
    const std::string what = std::string(error.what()) + ' ';  // not empty
    what.copy(text.data(), text.size() - 1);
  }
  const Rows by_rows = values;
  MPI_Igatherv(by_rows.data(), static_cast<int>(by_rows.size()), MPI_DOUBLE, all_values,
               of_values.counts.data(), of_values.begins.data(), MPI_DOUBLE, 0, MPI_COMM_WORLD, &request);
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
      const auto refuse = [this](const auto&, auto) {
        throw std::runtime_error(
            "rank " + std::to_string(rank_) +
            " could not begin: expected the program to begin there too, and with one rank");
      };
      serve({refuse, refuse});
    }
    MPI_Finalize();
  } catch (const io::Interrupted&) {
    io::die_of_interrupt();
  }
}

void Ranks::serve(const SharedModel& model) {
  for (Header header = broadcast(no_more); header != no_more; header = broadcast(no_more)) {
    evaluate(model, header, rank_, size_, {}, nullptr);
  }
  is_done_ = true;
}

std::optional<tmcmc::LogLikelihood> Ranks::share(const tmcmc::LogLikelihood& model) {
  const auto shared = share(model, {});
  return shared ? std::optional(shared->log_likelihood) : std::nullopt;
}

std::optional<SharedModel> Ranks::share(const tmcmc::LogLikelihood& model, const ForwardModel& outputs) {
  const SharedModel own{model, outputs};
  if (rank_ > 0) {
    serve(own);
    return std::nullopt;
  }
  const auto together = [this, own, mutex = std::make_shared<std::mutex>()](const Rows& points, long columns,
                                                                            double* values) {
    if (std::max(points.cols(), columns) * points.rows() > std::numeric_limits<int>::max()) {
      throw std::length_error("batch of " + std::to_string(points.rows()) + " points of " +
                              std::to_string(std::max(points.cols(), columns)) +
                              " numbers: expected fewer than 2^31 numbers");
    }
    const std::lock_guard lock(*mutex);
    evaluate(own, broadcast({points.rows(), points.cols(), columns}), rank_, size_, points, values);
  };
  SharedModel shared;
  shared.log_likelihood = [together](const Eigen::Ref<const Eigen::MatrixXd>& points,
                                     Eigen::Ref<Eigen::VectorXd> values) {
    together(points, 0, values.data());
  };
  if (outputs) {
    shared.outputs = [together](const Eigen::Ref<const Eigen::MatrixXd>& points,
                                Eigen::Ref<Eigen::MatrixXd> values) {
      Rows rows(values.rows(), values.cols());
      together(points, rows.cols(), rows.data());
      values = rows;
    };
  }
  return shared;
}

}  // namespace models
