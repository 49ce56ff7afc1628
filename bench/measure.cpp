#include "measure.hpp"

#include <malloc.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <limits>
#include <string>

namespace experiments {

namespace {

/// A size of this process: "VmHWM:" is the peak since it was reset, "VmRSS:" what is in use.
double memory_bytes(const std::string& name) {
  std::ifstream status("/proc/self/status");
  std::string word;
  while (status >> word && word != name) {
  }
  double kilobytes = std::numeric_limits<double>::quiet_NaN();
  status >> kilobytes;
  return 1024.0 * kilobytes;
}

}  // namespace

Cost cost_of(const std::function<void()>& work) {
  using Clock = std::chrono::steady_clock;
  malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << "5";  // resets the peak
  const double before = memory_bytes("VmRSS:");
  double best = std::numeric_limits<double>::infinity();
  for (const auto begin = Clock::now(); Clock::now() - begin < std::chrono::milliseconds(100);) {
    const auto start = Clock::now();
    work();
    best = std::min(best, std::chrono::duration<double>(Clock::now() - start).count());
  }
  return {best, memory_bytes("VmHWM:") - before};
}

}  // namespace experiments
