/// \file
/// Another program as the model of own_model: called once a batch, started once, or behind a server of UM-Bridge.
#pragma once

#include "own_models.hpp"

namespace examples {

/// The model of --command, --worker or --um-bridge, of which one is given; it is called several times at a time.
/// \throws as make_model
[[nodiscard]] Model other_program(const ProblemOptions& options, const Listeners& listeners);

}  // namespace examples
