/// \file
/// A pool of objects that concurrent calls use one at a time and keep for later calls.
#pragma once

#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace models {

/// The objects that no call uses at present; there are as many objects as there were concurrent
/// calls.
template <class Thing>
class Pool {
 public:
  /// Takes an object for this call alone; null if all are in use, and the caller then makes
  /// another.
  [[nodiscard]] std::unique_ptr<Thing> take() {
    const std::lock_guard lock(mutex_);
    if (idle_.empty()) {
      return nullptr;
    }
    auto thing = std::move(idle_.back());
    idle_.pop_back();
    return thing;
  }

  /// Returns an object to the pool for the next call.
  void give_back(std::unique_ptr<Thing> thing) {
    const std::lock_guard lock(mutex_);
    idle_.push_back(std::move(thing));
  }

 private:
  std::mutex mutex_;
  std::vector<std::unique_ptr<Thing>> idle_;
};

}  // namespace models
