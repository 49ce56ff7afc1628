/// \file
/// Tasks that ranks take as they become free, with results in the order of the tasks.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "distributed/ranks.hpp"

namespace distributed {

/// What a rank makes of a task. Both are bytes: whoever gives the tasks knows what they mean.
using Work = std::function<std::string(const std::string& task)>;

/// Rank 0's hold on the others, see lead_or_serve.
class Farm {
 public:
  /// On rank 0; both have to outlive it.
  Farm(Ranks& ranks, const Work& work) : ranks_(ranks), work_(work) {}
  ~Farm();  ///< tells the other ranks that there is nothing more to do, and waits until they know
  Farm(const Farm&) = delete;
  Farm& operator=(const Farm&) = delete;

  /// Hands each task to a rank that is free, this one included, until there is none left. With one rank it is a plain loop.
  /// \param next  gives the next task, or nothing at the end
  /// \param collect  gets the results, in the order of the tasks
  /// \throws what the work throws for the first task that fails, after the results before it were collected and the ranks
  ///         that are at work have ended theirs. From another rank a tmcmc::SamplingError or InfeasiblePriorError comes as
  ///         it is, any other exception as a std::runtime_error with its text.
  void run(const std::function<std::optional<std::string>()>& next,
           const std::function<void(std::string result)>& collect);

  /// Number of ranks, this one included.
  [[nodiscard]] int size() const { return ranks_.size(); }

 private:
  Ranks& ranks_;
  const Work& work_;
};

/// Every rank calls this when it has what the work needs. Rank 0 gets a Farm and leads; the others work until it returns or
/// throws.
/// \throws AnotherRankFailed if a rank has not come this far; on rank 0 what `lead` throws.
void lead_or_serve(Ranks& ranks, const Work& work, const std::function<void(Farm&)>& lead);

}  // namespace distributed
