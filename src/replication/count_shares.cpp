// How often the studies of a sampler have so many runs of so many iterations.

#include <map>

#include "replication/published.hpp"

namespace replication {

std::vector<CountShare> count_shares(const std::vector<StudySummary>& studies, const PrintedCounts& printed) {
  const auto of_sampler = studies_of(studies, printed.sampler);
  const auto runs_of = [](const auto& counts, std::int64_t iterations) {
    const auto found = counts.find(iterations);
    return found == counts.end() ? std::int64_t{0} : std::int64_t{found->second};
  };
  std::map<std::int64_t, std::map<std::int64_t, double>> studies_with;  // iterations -> runs -> studies
  for (const auto& cell : printed.counts) {
    studies_with[cell.first];
  }
  for (const auto& study : of_sampler) {
    for (const auto& cell : study.iterations) {
      studies_with[cell.first];
    }
  }
  std::vector<CountShare> shares;
  for (auto& [iterations, by_runs] : studies_with) {
    for (const auto& study : of_sampler) {
      by_runs[runs_of(study.iterations, iterations)] += 1.0;
    }
    for (const auto& [runs, number] : by_runs) {
      shares.push_back({iterations, runs, number / static_cast<double>(of_sampler.size()),
                        runs_of(printed.counts, iterations)});
    }
  }
  return shares;
}

}  // namespace replication
