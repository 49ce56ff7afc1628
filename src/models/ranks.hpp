/// \file
/// The processes (ranks) as which mpirun starts one program, and which share the batches of a
/// log-likelihood.
#pragma once

#include <optional>

#include "models/forward_model.hpp"
#include "tmcmc/sampler.hpp"

namespace models {

/// A model as all ranks evaluate it together.
struct SharedModel {
  tmcmc::LogLikelihood log_likelihood;
  /// Empty if the model has none.
  ForwardModel outputs;
};

/// MPI from construction to destruction: one object per process, made in main before anything else
/// and outliving every function that share returns. Rank 0 runs the program; the other ranks
/// evaluate rows for it until it is done. In a build without MPI, and without mpirun, there is one
/// rank.
class Ranks {
 public:
  /// \throws std::runtime_error if this MPI library does not support calls from one thread at a
  ///         time.
  Ranks(int& argc, char**& argv);
  /// On rank 0: tells the other ranks that there is nothing more to do. On a rank that never called
  /// share: waits for that message, and refuses a batch until then, so that if a rank could not
  /// begin the program ends with a single message from rank 0.
  ~Ranks();
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  /// Number of this rank, from 0.
  [[nodiscard]] int rank() const { return rank_; }
  /// Number of ranks.
  [[nodiscard]] int size() const { return size_; }

  /// Every rank calls this function once, with the same model. On rank 0 it returns a
  /// log-likelihood of which all ranks evaluate equal parts, contiguous in the order of the rows,
  /// so that the values are byte-identical for any number of ranks. On the other ranks it evaluates
  /// until rank 0 is done, and returns nothing.
  ///
  /// Only the rows of one call are shared out: for a run set Options::threads = 1 (calls from
  /// several threads wait for each other) and Options::batch_rows = 0. If ranks fail, the returned
  /// function throws the exception of the lowest of them: unchanged if that is rank 0, otherwise as
  /// a std::runtime_error with its text. NaN and plus infinity are returned as values. All waiting
  /// ends with io::Interrupted when a signal has been received.
  [[nodiscard]] std::optional<tmcmc::LogLikelihood> share(const tmcmc::LogLikelihood& model);

  /// As the other overload, for a model whose outputs are also evaluated; they too are shared out
  /// by rows. A rank calls one of the two overloads, once.
  /// \param outputs  empty if the model has none
  [[nodiscard]] std::optional<SharedModel> share(const tmcmc::LogLikelihood& model,
                                                 const ForwardModel& outputs);

 private:
  void serve(const SharedModel& model);

  int rank_ = 0;
  int size_ = 1;
  bool is_done_ = false;
};

}  // namespace models
