#pragma once

#include <fcntl.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cstdio>

/// Points a descriptor elsewhere until the end of the scope.
class Redirection {
 public:
  Redirection(int descriptor, const char* path, int flags)
      : Redirection(descriptor, ::open(path, flags | O_CLOEXEC, 0600)) {}
  Redirection(int descriptor, int target) : descriptor_(descriptor) {
    std::fflush(nullptr);
    saved_ = ::dup(descriptor);
    REQUIRE(target >= 0);
    ::dup2(target, descriptor);
    ::close(target);
  }
  ~Redirection() {
    ::dup2(saved_, descriptor_);
    ::close(saved_);
  }
  Redirection(const Redirection&) = delete;
  Redirection& operator=(const Redirection&) = delete;

 private:
  int descriptor_;
  int saved_ = -1;
};
