/// \file
/// Time and memory of a piece of work.
#pragma once

#include <functional>

namespace experiments {

/// What a piece of work took.
struct Cost {
  /// Shortest time of a repetition, s.
  double seconds = 0.0;
  /// Peak of the memory in use beyond what was in use before; NaN where Linux does not tell.
  double peak_bytes = 0.0;
};

/// Repeats the work for a tenth of a second, at least once.
[[nodiscard]] Cost cost_of(const std::function<void()>& work);

}  // namespace experiments
