/// \file
/// The few calls that need MPI; internal to distributed. mpi_transport.cpp has them with MPI, single_transport.cpp for a
/// process that is alone.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace distributed {

struct Message {
  int from = 0;
  int tag = 0;
  std::string bytes;
};

namespace transport {

void start(int& argc, char**& argv);
void finish() noexcept;
[[nodiscard]] int rank();
[[nodiscard]] int size();

/// The smallest of the values that the ranks give. Every rank has to call it.
[[nodiscard]] int smallest(int value);

/// \throws std::length_error for more than 2^31 - 1 bytes.
void send(int to, int tag, std::string_view bytes);

/// A message that has arrived, from any rank; does not wait.
[[nodiscard]] std::optional<Message> receive();

}  // namespace transport
}  // namespace distributed
