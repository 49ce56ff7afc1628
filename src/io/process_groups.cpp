#include "io/process_groups.hpp"

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>

#include "io/ending.hpp"

namespace io {
namespace {

constexpr pid_t nobody = 0;
constexpr pid_t starting = -1;

std::array<std::atomic<pid_t>, 4096> leaders;
static_assert(std::atomic<pid_t>::is_always_lock_free, "the signal handler needs lock-free atomics");

}  // namespace

pid_t fork_group() noexcept {
  const ending::Registration registration;
  const auto slot = std::find_if(leaders.begin(), leaders.end(), [](std::atomic<pid_t>& leader) {
    pid_t expected = nobody;
    return leader.compare_exchange_strong(expected, starting);
  });
  if (slot == leaders.end()) {
    errno = EAGAIN;
    return -1;
  }
  const pid_t child = ::fork();
  if (child == 0) {
    ::setpgid(0, 0);
    return 0;
  }
  if (child > 0) ::setpgid(child, child);  // whoever comes first: from here on the group is there
  slot->store(child > 0 ? child : nobody);
  return child;
}

int end_group(pid_t leader) noexcept {
  const ending::Registration registration;
  ::kill(-leader, SIGKILL);  // until waitpid the number is the leader's own, even if it has ended
  int status = 0;
  while (::waitpid(leader, &status, 0) < 0 && errno == EINTR) {
  }
  const auto slot = std::find(leaders.begin(), leaders.end(), leader);
  if (slot != leaders.end()) slot->store(nobody);
  return status;
}

void process_groups::kill_all() noexcept {
  for (const std::atomic<pid_t>& slot : leaders) {
    const pid_t leader = slot.load();
    if (leader > 0) ::kill(-leader, SIGKILL);
  }
}

}  // namespace io
