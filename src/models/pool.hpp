/// \file
/// Things that calls of several threads use one at a time, kept for the next call.
#pragma once

#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace models {

/// What no call uses at present: as many as there were calls at a time.
template <class Thing>
class Pool {
 public:
  /// One for this call alone; null if all are in use, and the caller makes another.
  [[nodiscard]] std::unique_ptr<Thing> take() {
    const std::lock_guard lock(mutex_);
    if (idle_.empty()) {
      return nullptr;
    }
    auto thing = std::move(idle_.back());
    idle_.pop_back();
    return thing;
  }

  /// For the next call.
  void give_back(std::unique_ptr<Thing> thing) {
    const std::lock_guard lock(mutex_);
    idle_.push_back(std::move(thing));
  }

 private:
  std::mutex mutex_;
  std::vector<std::unique_ptr<Thing>> idle_;
};

}  // namespace models
