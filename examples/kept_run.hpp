/// \file
/// A run whose stages are kept while it goes.
#pragma once

#include <string>

#include "storage/checkpoint.hpp"

namespace examples {

/// storage::run_with_checkpoint, or tmcmc::run if the path is empty.
/// \throws as these, and io::Interrupted; what ends the run says in its message which stage is
///         kept, and where.
/// \param observer  sees each stage
[[nodiscard]] tmcmc::Result run_kept(const storage::RunDescription& run, const tmcmc::LogLikelihood& model,
                                     const std::string& checkpoint, const tmcmc::Observer& observer);

}  // namespace examples
