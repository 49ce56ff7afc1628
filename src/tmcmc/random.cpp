#include "tmcmc/random.hpp"

#include <Random123/philox.h>

#include "tmcmc/detail/random_rows.hpp"

namespace tmcmc {

namespace {

using Philox = r123::Philox4x64;

/// The counter without the row.
Philox::ctr_type counter_of(const StreamKey& key, const DrawId& id) {
  return {{id.stage | (static_cast<std::uint64_t>(key.arm) << 32U) |
               (static_cast<std::uint64_t>(id.purpose) << 56U),
           0, id.draw | (static_cast<std::uint64_t>(id.attempt) << 32U), id.block}};
}

Philox::key_type key_of(const StreamKey& key) {
  return {{key.seed, key.run | (static_cast<std::uint64_t>(key.study) << 32U)}};
}

}  // namespace

Words random_words(const StreamKey& key, const DrawId& id) {
  Philox::ctr_type counter = counter_of(key, id);
  counter[1] = id.row;
  const auto words = Philox()(counter, key_of(key));
  return {words[0], words[1], words[2], words[3]};
}

void detail::random_words_of_rows(const StreamKey& key, const DrawId& place,
                                  std::span<const std::uint64_t> rows, std::span<std::uint64_t> words) {
  Philox::ctr_type counter = counter_of(key, place);
  const Philox::key_type philox_key = key_of(key);
  const std::size_t stride = words.size() / 4;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    counter[1] = rows[i];
    const auto four = Philox()(counter, philox_key);
    for (std::size_t k = 0; k < 4; ++k) {
      words[k * stride + i] = four[k];
    }
  }
}

}  // namespace tmcmc
