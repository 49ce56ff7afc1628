/// \file
/// The random numbers of one draw, in sequence.
#pragma once

#include "portable_math/normal_quantile.hpp"
#include "tmcmc/random.hpp"

namespace tmcmc {

/// Numbers from the counter-based words at a place and in the blocks after it. They depend only on
/// key and place, so that draws do not depend on threads or on each other.
class RandomStream {
 public:
  /// \param place  place of the first four words; the others follow in place.block + 1, ...
  RandomStream(const StreamKey& key, const DrawId& place) : key_(key), place_(place) {}

  /// Uniform on the open interval (0, 1).
  double uniform() {
    if (next_ == words_.size()) {
      words_ = random_words(key_, place_);
      ++place_.block;
      next_ = 0;
    }
    return uniform_open(words_[next_++]);
  }

  /// Standard normal, the quantile of one uniform number.
  double normal() { return portable_math::normal_quantile(uniform()); }

 private:
  StreamKey key_;
  DrawId place_;
  Words words_{};
  std::size_t next_ = std::tuple_size_v<Words>;
};

}  // namespace tmcmc
