#include "tmcmc/random.hpp"

#include <Random123/philox.h>

namespace tmcmc {

Words random_words(const StreamKey& key, const DrawId& id) {
  using Philox = r123::Philox4x64;
  const Philox::ctr_type counter{{id.stage | (static_cast<std::uint64_t>(key.arm) << 32U) |
                                      (static_cast<std::uint64_t>(id.purpose) << 56U),
                                  id.row, id.draw | (static_cast<std::uint64_t>(id.attempt) << 32U),
                                  id.block}};
  const Philox::key_type philox_key{{key.seed, key.run | (static_cast<std::uint64_t>(key.study) << 32U)}};
  const auto words = Philox()(counter, philox_key);
  return {words[0], words[1], words[2], words[3]};
}

}  // namespace tmcmc
