// A pipe that tells whether children have ended.
#pragma once

#include <poll.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <utility>

/// A pipe whose writing end children inherit: it closes when the last of them has ended.
class Lifeline {
 public:
  Lifeline() { REQUIRE(::pipe(ends_) == 0); }
  ~Lifeline() {
    ::close(ends_[0]);
    if (ends_[1] >= 0) ::close(ends_[1]);
  }
  /// Whether all children have ended ten seconds from now at the latest.
  bool all_have_ended() {
    ::close(std::exchange(ends_[1], -1));
    pollfd waiting{ends_[0], POLLIN, 0};
    return ::poll(&waiting, 1, 10000) == 1 && (waiting.revents & POLLHUP) != 0;
  }

 private:
  int ends_[2];
};
