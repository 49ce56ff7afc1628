/// \file
/// The processes (ranks) that mpirun starts one program as, sharing the batches of a
/// log-likelihood.
#pragma once

#include <optional>

#include "models/forward_model.hpp"
#include "tmcmc/sampler.hpp"

namespace models {

/// A model as all ranks evaluate it together.
struct SharedModel {
  tmcmc::LogLikelihood log_likelihood;
  ForwardModel outputs;  ///< empty if the model has none
};

/// MPI from construction to destruction: one object a process, made in main before anything else
/// and outliving every function that share returns. Rank 0 runs the program; the others evaluate
/// rows for it until it is done. In a build without MPI, and without mpirun, there is one rank.
class Ranks {
 public:
  /// \throws std::runtime_error if this MPI cannot be called by one thread at a time.
  Ranks(int& argc, char**& argv);
  /// On rank 0: tells the others that there is nothing more to do. On another that never called
  /// share: waits for that, and refuses a batch until then, so that a rank which could not begin
  /// ends the program with one message of rank 0.
  ~Ranks();
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  /// From 0.
  [[nodiscard]] int rank() const { return rank_; }
  /// Number of ranks.
  [[nodiscard]] int size() const { return size_; }

  /// Every rank calls this once, with the same model. On rank 0 it returns a log-likelihood of
  /// which all ranks evaluate equal parts, contiguous in the order of the rows, so that the values
  /// have the same bytes with any number of ranks. On the others it evaluates until rank 0 is done,
  /// and returns nothing.
  ///
  /// Only the rows of one call are shared out: for a run set Options::threads = 1 (calls from
  /// several threads wait for each other) and Options::batch_rows = 0. The returned function throws
  /// what the model throws for the lowest rank: as it is from rank 0, as a std::runtime_error with
  /// its text from another. NaN and plus infinity come back as values. All waiting ends with
  /// io::Interrupted when a signal has come.
  [[nodiscard]] std::optional<tmcmc::LogLikelihood> share(const tmcmc::LogLikelihood& model);

  /// The same of a model that is asked for its outputs too, which are shared out by rows likewise.
  /// Instead of the other, once. \param outputs  empty for none
  [[nodiscard]] std::optional<SharedModel> share(const tmcmc::LogLikelihood& model,
                                                 const ForwardModel& outputs);

 private:
  void serve(const SharedModel& model);

  int rank_ = 0;
  int size_ = 1;
  bool is_done_ = false;
};

}  // namespace models
