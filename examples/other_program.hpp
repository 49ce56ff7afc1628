/// \file
/// Another program as the model of own_model: called once per batch, started once, or behind a
/// UM-Bridge server.
#pragma once

#include "own_models.hpp"

namespace examples {

/// The model of --command, --worker or --um-bridge, exactly one of which is given; it is called
/// concurrently.
/// \throws as make_model
[[nodiscard]] Model other_program(const ProblemOptions& options, const Listeners& listeners);

}  // namespace examples
