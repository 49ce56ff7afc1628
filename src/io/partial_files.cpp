#include "io/partial_files.hpp"

#include <unistd.h>

#include <array>
#include <atomic>
#include <climits>
#include <cstring>

namespace io::partial_files {
namespace {

enum State : int { free_slot, filling, live, claimed };

struct Slot {
  std::atomic<int> state{free_slot};
  char path[PATH_MAX];
};

constexpr int slot_count = 4200;  // as many threads as may be asked for, each with a file, and the outputs
std::array<Slot, slot_count> slots;
static_assert(std::atomic<int>::is_always_lock_free, "the signal handler needs lock-free atomics");

}  // namespace

int add(const char* path) noexcept {
  const std::size_t size = std::strlen(path) + 1;
  if (size > PATH_MAX) return -1;
  for (int i = 0; i < slot_count; ++i) {
    Slot& slot = slots[static_cast<std::size_t>(i)];
    int expected = free_slot;
    if (!slot.state.compare_exchange_strong(expected, filling)) continue;
    std::memcpy(slot.path, path, size);
    slot.state.store(live);
    return i;
  }
  return -1;
}

void remove(int slot) noexcept {
  if (slot < 0) return;
  int expected = live;
  slots[static_cast<std::size_t>(slot)].state.compare_exchange_strong(expected, free_slot);
}

void unlink_all() noexcept {
  for (Slot& slot : slots) {
    int expected = live;
    if (slot.state.compare_exchange_strong(expected, claimed)) ::unlink(slot.path);
  }
}

}  // namespace io::partial_files
