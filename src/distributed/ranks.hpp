/// \file
/// The processes (ranks) that mpirun starts one program as.
#pragma once

#include <stdexcept>

namespace distributed {

/// MPI from construction to destruction: one object a process, made in main before anything else. In a build without MPI,
/// and without mpirun, there is one rank.
class Ranks {
 public:
  /// \throws std::runtime_error if MPI cannot be called from several threads.
  Ranks(int& argc, char**& argv);
  ~Ranks();
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  [[nodiscard]] int rank() const { return rank_; }  ///< from 0
  [[nodiscard]] int size() const { return size_; }  ///< number of ranks

  /// Waits until all ranks are here. Work may be shared out only after that.
  /// \throws AnotherRankFailed if one of them failed instead and called reports_failure.
  void wait_until_all_are_ready();

  /// Whether it is this rank that tells the user of its failure. Inputs that are wrong are wrong on every rank, and one line
  /// is enough: before all ranks are ready it is the lowest that failed, later rank 0, which hears of all failures.
  [[nodiscard]] bool reports_failure();

 private:
  int rank_ = 0;
  int size_ = 1;
  bool ready_ = false;
};

/// This rank can go on and another cannot; that one says why.
class AnotherRankFailed : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace distributed
