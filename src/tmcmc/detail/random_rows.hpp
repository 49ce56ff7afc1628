/// \file
/// Random words of many rows at a time.
#pragma once

#include <span>

#include "tmcmc/random.hpp"

namespace tmcmc::detail {

/// random_words() for several rows of one place, whose own row does not count: word k of rows[i] goes to
/// words[k * words.size() / 4 + i].
/// \param words  four times as many as rows, or more
void random_words_of_rows(const StreamKey& key, const DrawId& place, std::span<const std::uint64_t> rows,
                          std::span<std::uint64_t> words);

}  // namespace tmcmc::detail
