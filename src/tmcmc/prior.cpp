#include "tmcmc/prior.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>
#include <utility>

#include "tmcmc/parallel.hpp"

namespace tmcmc {

BoxPrior::BoxPrior(Eigen::VectorXd lower, Eigen::VectorXd upper)
    : lower_(std::move(lower)), upper_(std::move(upper)) {
  if (lower_.size() == 0 || lower_.size() != upper_.size()) {
    throw std::invalid_argument("prior: expected as many lower as upper bounds, at least one of each");
  }
  for (Index j = 0; j < lower_.size(); ++j) {
    if (!std::isfinite(upper_[j] - lower_[j]) || !(std::nextafter(lower_[j], upper_[j]) < upper_[j])) {
      std::ostringstream message;
      message << "prior: bounds of parameter " << j << " are [" << std::setprecision(17) << lower_[j] << ", "
              << upper_[j] << "]: expected finite numbers, lower < upper, with numbers between them";
      throw std::invalid_argument(message.str());
    }
  }
}

Population BoxPrior::sample(Index n, const StreamKey& key, int threads) const {
  Population points(n, dimension());
  Eigen::VectorXd first(dimension());
  Eigen::VectorXd last(dimension());
  for (Index j = 0; j < dimension(); ++j) {
    first[j] = std::nextafter(lower_[j], upper_[j]);
    last[j] = std::nextafter(upper_[j], lower_[j]);
  }
  for_each_block(n, reduction_rows, threads, [&](Index, Index begin, Index end) {
    for (Index i = begin; i < end; ++i) {
      Words words{};
      for (Index j = 0; j < dimension(); ++j) {
        const auto word = static_cast<std::size_t>(j % 4);
        if (word == 0) {
          words = random_words(key, {.purpose = Purpose::prior,
                                     .row = static_cast<std::uint64_t>(i),
                                     .block = static_cast<std::uint32_t>(j / 4)});
        }
        const double value = lower_[j] + (upper_[j] - lower_[j]) * uniform_open(words[word]);
        points(i, j) = std::clamp(value, first[j], last[j]);
      }
    }
  });
  return points;
}

}  // namespace tmcmc
