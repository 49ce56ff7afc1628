#include "tmcmc/genealogy.hpp"

namespace tmcmc {

std::vector<std::vector<Index>> Genealogy::ancestors() const {
  std::vector<std::vector<Index>> all = parents;
  for (std::size_t t = all.size(); t-- > 1;) {
    std::vector<Index> earlier;
    earlier.reserve(all[t].size());
    for (const Index chain : all[t]) {
      earlier.push_back(parents[t - 1][static_cast<std::size_t>(chain)]);
    }
    all[t - 1] = std::move(earlier);
  }
  return all;
}

}  // namespace tmcmc
