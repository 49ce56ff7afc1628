/// \file
/// Loop over blocks of an index range on several threads.
#pragma once

#include <omp.h>

#include <algorithm>
#include <exception>
#include <vector>

#include "tmcmc/types.hpp"

namespace tmcmc {

/// Calls body(block, begin, end) for each block of at most block_size indices of [0, n), on up to `threads`
/// threads. If some calls throw, the exception of the lowest block is rethrown after all have ended.
template <class Body>
void for_each_block(Index n, Index block_size, int threads, Body body) {
  const Index blocks = (n + block_size - 1) / block_size;
  if (threads <= 1 || blocks <= 1) {
    for (Index block = 0; block < blocks; ++block) {
      body(block, block * block_size, std::min(n, (block + 1) * block_size));
    }
    return;
  }
  std::vector<std::exception_ptr> failures(static_cast<std::size_t>(blocks));
#pragma omp parallel for schedule(dynamic) num_threads(threads)
  for (Index block = 0; block < blocks; ++block) {
    try {
      body(block, block * block_size, std::min(n, (block + 1) * block_size));
    } catch (...) {
      failures[static_cast<std::size_t>(block)] = std::current_exception();
    }
  }
  for (const auto& failure : failures) {
    if (failure) {
      std::rethrow_exception(failure);
    }
  }
}

}  // namespace tmcmc
