#pragma once

#include <unistd.h>

#include <cerrno>
#include <utility>

namespace io {

/// Owns a file descriptor; -1 means none.
class Descriptor {
 public:
  /// Takes over the descriptor.
  explicit Descriptor(int fd = -1) : fd_(fd) {}
  ~Descriptor() { close(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  /// The number of the descriptor, for system calls.
  [[nodiscard]] int get() const { return fd_; }
  /// Closes the descriptor and takes over another one.
  void reset(int fd) {
    close();
    fd_ = fd;
  }
  /// Closes the descriptor if it is open; false if the system reports a failed write.
  bool close() {
    const int fd = std::exchange(fd_, -1);
    return fd < 0 || ::close(fd) == 0 || errno == EINTR;
  }

 private:
  int fd_;
};

}  // namespace io
