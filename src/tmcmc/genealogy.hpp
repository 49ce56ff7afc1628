/// \file
/// Descent of the chains.
#pragma once

#include <vector>

#include "tmcmc/types.hpp"

namespace tmcmc {

/// Descent of the chains of a population. Population 0 consists of the draws from the prior, each
/// of which is a chain; population t is the population after stage t.
struct Genealogy {
  /// Number of chains: row i of the last population belongs to chain i modulo this number.
  Index chains = 0;
  /// parents[t][c]: chain of population t from which chain c of population t + 1 started. One entry
  /// per stage.
  std::vector<std::vector<Index>> parents;

  /// Entry [t][c]: chain of population t from which chain c of the last population descends.
  [[nodiscard]] std::vector<std::vector<Index>> ancestors() const;
};

}  // namespace tmcmc
