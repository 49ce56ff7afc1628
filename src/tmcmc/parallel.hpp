/// \file
/// Loops and sums over blocks of an index range on several threads.
#pragma once

#include <omp.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <vector>

#include "tmcmc/types.hpp"

namespace tmcmc {

/// Calls body(block, begin, end) for each block of at most block_size indices of [0, n), on up to
/// `threads` threads. If some calls throw, the exception of the lowest block is rethrown after all
/// calls that have begun have ended. Blocks begin in ascending order, and none begins once a lower
/// one has thrown.
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
  std::atomic<Index> failed{blocks};  // lowest block that threw
#pragma omp parallel for schedule(monotonic : dynamic) num_threads(threads)
  for (Index block = 0; block < blocks; ++block) {
    if (block > failed) continue;
    try {
      body(block, block * block_size, std::min(n, (block + 1) * block_size));
    } catch (...) {
      failures[static_cast<std::size_t>(block)] = std::current_exception();
      for (Index lowest = failed; block < lowest && !failed.compare_exchange_weak(lowest, block);) {
      }
    }
  }
  for (const auto& failure : failures) {
    if (failure) {
      std::rethrow_exception(failure);
    }
  }
}

/// Rows of one partial sum: few enough for the cache, and more than the runs of the paper have.
constexpr Index reduction_rows = 4096;

/// Combines the results of body(begin, end) for each block of reduction_rows indices, in the order
/// of the blocks: the result depends only on n, not on the number of threads.
template <class Body, class Combine>
auto reduce_blocks(Index n, int threads, Body body, Combine combine) {
  if (n <= reduction_rows) {
    return body(Index{0}, n);
  }
  using Partial = decltype(body(Index{0}, n));
  std::vector<Partial> partial(static_cast<std::size_t>((n + reduction_rows - 1) / reduction_rows));
  for_each_block(n, reduction_rows, threads, [&](Index block, Index begin, Index end) {
    partial[static_cast<std::size_t>(block)] = body(begin, end);
  });
  for (std::size_t block = 1; block < partial.size(); ++block) {
    partial.front() = combine(partial.front(), partial[block]);
  }
  return partial.front();
}

/// Number of rows that one call of a log-likelihood gets: an equal share for each thread, at most
/// batch_rows unless that is 0.
[[nodiscard]] inline Index rows_per_call(Index n, int threads, Index batch_rows) {
  const Index share = (n + threads - 1) / threads;
  return batch_rows > 0 ? std::min(batch_rows, share) : share;
}

}  // namespace tmcmc
