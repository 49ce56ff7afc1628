/// \file
/// The few calls that need MPI; internal to distributed. mpi_transport.cpp has them with MPI, single_transport.cpp for a
/// process that is alone.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace distributed {

/// What one rank sends to another.
struct Message {
  int from = 0;       ///< rank of the sender
  int tag = 0;        ///< says what the bytes are
  std::string bytes;  ///< as the sender has them
};

namespace transport {

/// Joins the ranks, once, before all else; takes the arguments that are MPI's own away.
/// \throws std::runtime_error if MPI cannot be called from several threads.
void start(int& argc, char**& argv);
void finish() noexcept;    ///< leaves them
[[nodiscard]] int rank();  ///< of this process, from 0
[[nodiscard]] int size();  ///< number of ranks

/// The smallest of the values that the ranks give. Every rank has to call it.
[[nodiscard]] int smallest(int value);

/// \throws std::length_error for more than 2^31 - 1 bytes.
void send(int to, int tag, std::string_view bytes);

/// A message that has arrived, from any rank; does not wait.
[[nodiscard]] std::optional<Message> receive();

}  // namespace transport
}  // namespace distributed
