/// \file
/// Transformation from the support of a marginal to the whole line and back, for one parameter of
/// many chains at once.
#pragma once

#include <cstddef>

#include "tmcmc/detail/metropolis_proposal.hpp"

namespace tmcmc::detail {

/// Replaces x by u = log((x - low) / (high - x)), or by the logarithm of the distance to the one
/// finite bound, or leaves it unchanged if there is no bound; log(dx/du), up to a constant, is
/// subtracted from log_jacobian.
void leave_support(double low, double high, std::size_t count, ProposalLanes::Lanes& x,
                   ProposalLanes::Lanes& log_jacobian);

/// The inverse transformation, from u; log(dx/du) is added to log_jacobian. A value that rounds to
/// a bound counts as outside.
void enter_support(double low, double high, std::size_t count, ProposalLanes::Lanes& x,
                   ProposalLanes::Lanes& log_jacobian);

}  // namespace tmcmc::detail
