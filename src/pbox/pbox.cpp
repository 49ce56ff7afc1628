#include "pbox/pbox.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "errors/invalid_value.hpp"

namespace pbox {
namespace {

struct Jump {
  double x;
  double left;   // value of its ECDF just below x, counting one of several equal samples at a time
  double right;  // value after this jump
};

std::vector<Jump> sorted_jumps(std::span<const Ecdf> ecdfs) {
  std::size_t total = 0;
  for (const Ecdf& ecdf : ecdfs) total += ecdf.size();
  std::vector<Jump> jumps;
  jumps.reserve(total);
  for (const Ecdf& ecdf : ecdfs) {
    for (std::size_t k = 0; k < ecdf.size(); ++k) {
      jumps.push_back({ecdf.sorted()[k], ecdf.level(k), ecdf.level(k + 1)});
    }
  }
  std::sort(jumps.begin(), jumps.end(), [](const Jump& a, const Jump& b) { return a.x < b.x; });
  return jumps;
}

void require_consistent(const PBox& box) {
  if (box.x.empty() || box.lower.size() != box.x.size() || box.upper.size() != box.x.size()) {
    throw errors::InvalidValue("pbox::PBox", "", "x, lower and upper of the same length, at least 1");
  }
}

void require_ecdfs(std::span<const Ecdf> ecdfs) {
  if (ecdfs.empty()) throw errors::InvalidValue("ecdfs", "", "at least one");
}

/// The sum of height(i) * (right(i) - left(i)) over i, divided by n. A width or the sum may exceed
/// the largest double where the result does not. The sum is then computed for samples scaled by
/// 2^-shift, which is exact except for samples that are too small to matter beside such widths.
template <class Heights, class Lefts, class Rights>
double mean_width(std::size_t terms, double n, Heights height, Lefts left, Rights right) {
  double sum = 0.0;
  for (std::size_t i = 0; i < terms; ++i) sum += height(i) * (right(i) - left(i));
  if (std::isfinite(sum)) return sum / n;
  constexpr int shift = 66;  // more than the number of bits of any sum of samples
  double scaled = 0.0;
  for (std::size_t i = 0; i < terms; ++i) {
    scaled += height(i) * (std::ldexp(right(i), -shift) - std::ldexp(left(i), -shift));
  }
  return std::ldexp(scaled / n, shift);
}

double area_by_ranks(std::span<const Ecdf> ecdfs) {
  const std::span<const double> first = ecdfs.front().sorted();
  std::vector<double> low(first.begin(), first.end());
  std::vector<double> high = low;
  for (const Ecdf& ecdf : ecdfs.subspan(1)) {
    const double* const x = ecdf.sorted().data();
    for (std::size_t k = 0; k < low.size(); ++k) {
      low[k] = std::min(low[k], x[k]);
      high[k] = std::max(high[k], x[k]);
    }
  }
  return mean_width(
      low.size(), static_cast<double>(low.size()), [](std::size_t) { return 1.0; },
      [&](std::size_t k) { return low[k]; }, [&](std::size_t k) { return high[k]; });
}

}  // namespace

Ecdf::Ecdf(std::vector<double> samples) : sorted_(std::move(samples)) {
  if (sorted_.empty()) throw errors::InvalidValue("samples", "", "at least one");
  for (std::size_t i = 0; i < sorted_.size(); ++i) {
    if (!std::isfinite(sorted_[i])) {
      throw errors::InvalidValue("samples[" + std::to_string(i) + "]", sorted_[i], "a finite number");
    }
  }
  std::sort(sorted_.begin(), sorted_.end());
}

Ecdf::Ecdf(std::vector<double> samples, std::span<const double> weights) {
  if (weights.size() != samples.size()) {
    throw errors::InvalidValue("weights", weights.size(),
                               "one for each of the " + std::to_string(samples.size()) + " samples");
  }
  bool are_equal = true;
  std::vector<std::pair<double, double>> weighted;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (!(weights[i] >= 0.0) || !std::isfinite(weights[i])) {
      throw errors::InvalidValue("weights[" + std::to_string(i) + "]", weights[i],
                                 "a finite number of at least 0");
    }
    are_equal = are_equal && weights[i] == weights[0] && weights[i] > 0.0;
    if (weights[i] > 0.0) weighted.emplace_back(samples[i], weights[i]);
  }
  if (are_equal || weighted.empty()) {
    if (!samples.empty() && weighted.empty())
      throw errors::InvalidValue("weights", 0.0, "a positive one among them");
    *this = Ecdf(std::move(samples));
    return;
  }
  std::vector<double> kept;
  for (const auto& [x, weight] : weighted) kept.push_back(x);
  *this = Ecdf(std::move(kept));  // which checks the samples
  std::stable_sort(weighted.begin(), weighted.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  const double largest = std::max_element(weighted.begin(), weighted.end(), [](const auto& a, const auto& b) {
                           return a.second < b.second;
                         })->second;
  double sum = 0.0;
  for (const auto& [x, weight] : weighted) levels_.push_back(sum += weight / largest);
  for (double& level : levels_) level /= sum;
}

double Ecdf::operator()(double x) const {
  if (std::isnan(x)) return x;
  const auto above = std::upper_bound(sorted_.begin(), sorted_.end(), x);
  return level(static_cast<std::size_t>(above - sorted_.begin()));
}

PBox envelope(std::span<const Ecdf> ecdfs) {
  require_ecdfs(ecdfs);
  const std::vector<Jump> jumps = sorted_jumps(ecdfs);
  PBox box;

  // ECDFs never decrease, so the largest value reached by any jump so far is the value of the
  // largest ECDF here.
  double highest = 0.0;
  for (const Jump& jump : jumps) {
    highest = std::max(highest, jump.right);
    if (box.x.empty() || box.x.back() < jump.x) {
      box.x.push_back(jump.x);
      box.upper.push_back(highest);
    } else {
      box.upper.back() = highest;
    }
  }

  // From the right: an ECDF that still has a jump ahead has the value to the left of its next jump;
  // other ECDFs are 1.
  box.lower.resize(box.x.size());
  double lowest = 1.0;
  std::size_t next = jumps.size();
  for (std::size_t i = box.x.size(); i-- > 0;) {
    while (next > 0 && jumps[next - 1].x > box.x[i]) lowest = std::min(lowest, jumps[--next].left);
    box.lower[i] = lowest;
  }
  return box;
}

Bounds evaluate(const PBox& box, double x) {
  require_consistent(box);
  if (std::isnan(x)) return {x, x};
  const auto above = std::upper_bound(box.x.begin(), box.x.end(), x);
  if (above == box.x.begin()) return {0.0, 0.0};
  if (above == box.x.end()) return {1.0, 1.0};
  const auto i = static_cast<std::size_t>(above - box.x.begin()) - 1;
  return {box.lower[i], box.upper[i]};
}

double area(const PBox& box) {
  require_consistent(box);
  return mean_width(
      box.x.size() - 1, 1.0, [&](std::size_t i) { return box.upper[i] - box.lower[i]; },
      [&](std::size_t i) { return box.x[i]; }, [&](std::size_t i) { return box.x[i + 1]; });
}

double area_metric(std::span<const Ecdf> ecdfs) {
  require_ecdfs(ecdfs);
  const std::size_t n = ecdfs.front().size();
  const bool equal_sizes = std::all_of(
      ecdfs.begin(), ecdfs.end(), [n](const Ecdf& ecdf) { return ecdf.size() == n && !ecdf.is_weighted(); });
  return equal_sizes ? area_by_ranks(ecdfs) : area(envelope(ecdfs));
}

}  // namespace pbox
