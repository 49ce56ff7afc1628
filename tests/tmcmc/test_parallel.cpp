// Blocks of an index range on several threads: each once, and the failure of the lowest one.

#include <algorithm>
#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "tmcmc/parallel.hpp"

using tmcmc::for_each_block;
using tmcmc::Index;

TEST_CASE("every index is in one block, in any number of threads", "[parallel]") {
  for (const int threads : {1, 2, 5}) {
    std::vector<std::atomic<int>> seen(103);
    std::atomic<int> misplaced = 0;
    for_each_block(103, 10, threads, [&](Index block, Index begin, Index end) {
      misplaced += begin != 10 * block || end != std::min<Index>(103, begin + 10) ? 1 : 0;
      for (Index i = begin; i < end; ++i) {
        ++seen[static_cast<std::size_t>(i)];
      }
    });
    CHECK(misplaced == 0);
    CHECK(std::all_of(seen.begin(), seen.end(), [](int count) { return count == 1; }));
  }
}

TEST_CASE("the lowest of the blocks that throw is the one whose exception is seen", "[parallel]") {
  for (int repeat = 0; repeat < 200; ++repeat) {
    std::atomic<Index> begun = 0;
    try {
      for_each_block(1000, 1, 4, [&](Index block, Index, Index) {
        ++begun;
        if (block >= 3) {
          throw std::runtime_error(std::to_string(block));
        }
      });
      FAIL("nothing was thrown");
    } catch (const std::runtime_error& error) {
      CHECK(error.what() == std::string("3"));
    }
    CHECK(begun <= 3 + 4);  // at most one failure a thread
  }
}

TEST_CASE("a later failure of a lower block does not let higher ones begin", "[parallel]") {
  // Block 0 waits until block 1 has thrown, and throws after it; or the other way round.
  for (const Index first : {0, 1}) {
    std::atomic<int> begun = 0;
    std::atomic<bool> has_thrown = false;
    CHECK_THROWS_WITH(for_each_block(100, 1, 2,
                                     [&](Index block, Index, Index) {
                                       ++begun;
                                       while (begun < 2) {
                                         std::this_thread::yield();
                                       }
                                       if (block == first) {
                                         has_thrown = true;
                                       } else {
                                         while (!has_thrown) {
                                           std::this_thread::yield();
                                         }
                                         std::this_thread::sleep_for(std::chrono::milliseconds(20));
                                       }
                                       throw std::runtime_error(std::to_string(block));
                                     }),
                      "0");
    CHECK(begun == 2);
  }
}
