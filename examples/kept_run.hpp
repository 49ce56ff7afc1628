/// \file
/// A run that stores its stages while it proceeds.
#pragma once

#include <string>

#include "storage/checkpoint.hpp"

namespace examples {

/// storage::run_with_checkpoint, or tmcmc::run if the path is empty.
/// \throws as these, and io::Interrupted; the message of whatever ends the run says which stage is
///         kept, and where.
/// \param observer  called with each stage
[[nodiscard]] tmcmc::Result run_kept(const storage::RunDescription& run, const tmcmc::LogLikelihood& model,
                                     const std::string& checkpoint, const tmcmc::Observer& observer);

}  // namespace examples
