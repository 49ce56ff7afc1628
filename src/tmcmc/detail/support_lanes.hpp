/// \file
/// The way from the support of a marginal to the whole line and back, for a parameter of many chains at once.
#pragma once

#include <cstddef>

#include "tmcmc/detail/metropolis_proposal.hpp"

namespace tmcmc::detail {

/// x becomes u = log((x - low) / (high - x)), or the logarithm of the distance to the one finite bound, or stays where
/// there is none; log_jacobian loses log(dx/du) but for a constant.
void leave_support(double low, double high, std::size_t count, ProposalLanes::Lanes& x,
                   ProposalLanes::Lanes& log_jacobian);

/// The way back, from u; log_jacobian gains log(dx/du). What rounds to a bound counts as outside.
void enter_support(double low, double high, std::size_t count, ProposalLanes::Lanes& x,
                   ProposalLanes::Lanes& log_jacobian);

}  // namespace tmcmc::detail
