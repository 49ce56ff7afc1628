/// \file
/// Random words of many rows at a time.
#pragma once

#include <span>

#include "tmcmc/random.hpp"

namespace tmcmc::detail {

/// random_words() for several rows at one place, whose own row is ignored: word k of rows[i] goes
/// to words[k * words.size() / 4 + i].
/// \param words  at least four times as many entries as rows
void random_words_of_rows(const StreamKey& key, const DrawId& place, std::span<const std::uint64_t> rows,
                          std::span<std::uint64_t> words);

}  // namespace tmcmc::detail
