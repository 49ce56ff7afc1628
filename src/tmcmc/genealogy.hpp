/// \file
/// Which chain descends from which.
#pragma once

#include <vector>

#include "tmcmc/types.hpp"

namespace tmcmc {

/// Descent of the chains of a population. Population 0 is the prior, where each draw is a chain;
/// population t is that after stage t.
struct Genealogy {
  /// Row i of the last population belongs to chain i modulo this.
  Index chains = 0;
  /// parents[t][c]: chain of population t from which chain c of population t + 1 started. One entry
  /// a stage.
  std::vector<std::vector<Index>> parents;

  /// Entry [t][c]: chain of population t from which chain c of the last population descends.
  [[nodiscard]] std::vector<std::vector<Index>> ancestors() const;
};

}  // namespace tmcmc
