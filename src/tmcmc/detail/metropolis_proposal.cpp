#include "tmcmc/detail/metropolis_proposal.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "portable_math/multiversion.hpp"
#include "tmcmc/detail/random_rows.hpp"
#include "tmcmc/detail/support_lanes.hpp"

namespace tmcmc::detail {

namespace {

using Lanes = ProposalLanes::Lanes;

/// Number of lanes that a loop over `count` chains processes: whole vectors of any instruction set.
/// The contents of surplus lanes are not used.
constexpr std::size_t in_vectors(std::size_t count) {
  return (count + 7) / 8 * 8;
}

constexpr std::uint32_t choice_block = 1U << 24U;  // of the random words: beyond those of the normals

PORTABLE_MATH_MULTIVERSION
void fill_log_uniforms(const std::uint64_t* words, std::size_t count, Lanes& result) {
  for (std::size_t i = 0; i < count; ++i) {
    result[i] = portable_math::log_positive(uniform_open(words[i]));
  }
}

PORTABLE_MATH_MULTIVERSION
void normals(const std::uint64_t* radius_a, const std::uint64_t* radius_b, const std::uint64_t* angles,
             std::size_t count, Lanes* z) {
  for (std::size_t i = 0; i < count; ++i) {
    const NormalPair a = normal_pair(radius_a[i], angles[i] >> 32U);
    const NormalPair b = normal_pair(radius_b[i], angles[i]);
    z[0][i] = a.first;
    z[1][i] = a.second;
    z[2][i] = b.first;
    z[3][i] = b.second;
  }
}

PORTABLE_MATH_MULTIVERSION
void add_scaled(double scale, const Lanes& z, std::size_t count, Lanes& x) {
  for (std::size_t i = 0; i < count; ++i) {
    x[i] += scale * z[i];
  }
}

/// inside[i] &= low <= x[i] <= high
PORTABLE_MATH_MULTIVERSION
void check_bounds(const Lanes& x, double low, double high, std::size_t count, Lanes& inside) {
  for (std::size_t i = 0; i < count; ++i) {
    const double above = x[i] >= low ? inside[i] : 0.0;
    inside[i] = x[i] <= high ? above : 0.0;
  }
}

/// Replaces z by the step in units of the factor's columns, and adds the contribution of an
/// independent draw to log_correction.
PORTABLE_MATH_MULTIVERSION
void step_of(double unit, const Lanes& y, const Lanes& chosen, const Lanes& independent,
             const Lanes& walk_scale, std::size_t count, Lanes& z, Lanes& log_correction) {
  for (std::size_t i = 0; i < count; ++i) {
    const double white = y[i] / unit;
    const double part = chosen[i] * independent[i];
    log_correction[i] += part * (0.5 * (z[i] * z[i] - white * white));
    const double walk = walk_scale[i] * z[i];
    const double fresh = unit * z[i] - y[i];
    z[i] = chosen[i] * (independent[i] != 0.0 ? fresh : walk);
  }
}

PORTABLE_MATH_MULTIVERSION
void scale_to(double factor, double centre, const Lanes& x, std::size_t count, Lanes& y) {
  for (std::size_t i = 0; i < count; ++i) {
    y[i] = factor * (x[i] - centre);
  }
}

}  // namespace

ProposalLanes::ProposalLanes(Index dimension)
    : dimension_(dimension),
      z_(static_cast<std::size_t>((dimension + 3) / 4 * 4)),
      x_(static_cast<std::size_t>(dimension)),
      y_(static_cast<std::size_t>(dimension)),
      chosen_(static_cast<std::size_t>(dimension)) {
  for (const Lanes& x : x_) {
    columns_.push_back(x.data());
  }
}

void ProposalLanes::draw(const StreamKey& key, const DrawId& id, const MetropolisKernel& kernel,
                         const RowIds& rows, std::size_t count, Lanes* log_uniforms) {
  for (std::size_t group = 0; 4 * group < z_.size(); ++group) {
    DrawId place = id;
    place.block = static_cast<std::uint32_t>(group);
    std::uint64_t* words = words_.front().data();
    random_words_of_rows(key, place, {rows.data(), count}, {words, 4 * lanes});
    if (group == 0 && log_uniforms != nullptr) {
      fill_log_uniforms(words, in_vectors(count), *log_uniforms);
    }
    normals(words + lanes, words + 2 * lanes, words + 3 * lanes, in_vectors(count), &z_[4 * group]);
  }
  if (!kernel.plain()) {
    draw_choices(key, id, kernel, rows, count);
  }
}

void ProposalLanes::draw_choices(const StreamKey& key, const DrawId& id, const MetropolisKernel& kernel,
                                 const RowIds& rows, std::size_t count) {
  const auto d = static_cast<std::uint64_t>(dimension_);
  const auto levels =
      static_cast<std::uint64_t>(std::bit_width(d));  // probabilities 1, 1/2, ..., no less than 1/d
  const auto scaled = [](std::uint64_t bits, std::uint64_t n) {
    return (bits >> 32U) * n >> 32U;
  };  // 0 ... n - 1
  DrawId place = id;
  for (std::size_t i = 0; i < count; ++i) {
    place.row = rows[i];
    place.block = choice_block;
    Words w = random_words(key, place);
    independent_[i] = uniform_32(w[0]) < kernel.independent_fraction ? 1.0 : 0.0;
    const double probability = std::ldexp(1.0, -static_cast<int>(scaled(w[0], levels)));
    const std::uint64_t always = scaled(w[1], d);
    double size = 0.0;
    for (std::uint64_t j = 0; j < d; ++j) {
      if (j % 8 == 0 && kernel.random_subsets) {
        ++place.block;
        w = random_words(key, place);
      }
      const double u = uniform_32(w[j % 8 / 2] >> (32U * (j % 2)));
      const bool chosen = !kernel.random_subsets || j == always || u < probability;
      const bool varies = kernel.factor(static_cast<Index>(j), static_cast<Index>(j)) > 0.0;
      chosen_[j][i] = chosen && varies ? 1.0 : 0.0;
      size += chosen ? 1.0 : 0.0;
    }
    walk_scale_[i] = kernel.divide_by_sqrt_size ? kernel.scale / std::sqrt(size) : kernel.scale;
  }
}

void ProposalLanes::shift(const MetropolisKernel& kernel) {
  const Index d = dimension_;
  for (Index k = 0; k < d; ++k) {  // y = factor^-1 (u - centre)
    const auto column = static_cast<std::size_t>(k);
    if (kernel.independent_fraction > 0.0 && kernel.factor(k, k) > 0.0) {
      scale_to(1.0, kernel.centre[k], x_[column], lanes, y_[column]);
      for (Index l = 0; l < k; ++l) {
        add_scaled(-kernel.factor(k, l), y_[static_cast<std::size_t>(l)], lanes, y_[column]);
      }
      scale_to(1.0 / kernel.factor(k, k), 0.0, y_[column], lanes, y_[column]);
    } else {
      y_[column].fill(0.0);
    }
  }
  for (std::size_t k = 0; k < y_.size(); ++k) {
    step_of(kernel.factor_unit, y_[k], chosen_[k], independent_, walk_scale_, lanes, z_[k], log_correction_);
  }
}

void ProposalLanes::propose(const MetropolisKernel& kernel, const Prior& prior, const Population& points,
                            const RowIds& rows, std::size_t count, Eigen::VectorXd& log_prior) {
  const std::size_t in_use = in_vectors(count);
  log_correction_.fill(0.0);
  for (Index j = 0; j < dimension_; ++j) {
    Lanes& x = x_[static_cast<std::size_t>(j)];
    const double* column = points.col(j).data();
    for (std::size_t i = 0; i < count; ++i) {
      x[i] = column[rows[i]];
    }
  }
  if (!prior.is_box()) {
    bool known = true;
    for (std::size_t i = 0; i < count; ++i) {
      log_prior_[i] = log_prior[static_cast<Index>(rows[i])];
      known = known && !std::isnan(log_prior_[i]);
    }
    if (!known) {
      prior.log_kernel(columns_, count, log_prior_.data());
      for (std::size_t i = 0; i < count; ++i) {
        log_prior[static_cast<Index>(rows[i])] = log_prior_[i];
      }
    }
  }
  if (kernel.coordinates == Coordinates::unbounded) {
    for (Index j = 0; j < dimension_; ++j) {
      leave_support(prior.lower()[j], prior.upper()[j], in_use, x_[static_cast<std::size_t>(j)],
                    log_correction_);
    }
  }
  double scale = kernel.scale;
  if (!kernel.plain()) {
    shift(kernel);
    scale = 1.0;
  } else if (kernel.divide_by_sqrt_size) {
    scale /= std::sqrt(static_cast<double>(dimension_));
  }
  for (Index j = 0; j < dimension_; ++j) {
    Lanes& x = x_[static_cast<std::size_t>(j)];
    for (Index k = 0; k <= j; ++k) {
      add_scaled(scale * kernel.factor(j, k), z_[static_cast<std::size_t>(k)], in_use, x);
    }
    if (kernel.coordinates == Coordinates::unbounded) {
      enter_support(prior.lower()[j], prior.upper()[j], in_use, x, log_correction_);
    }
  }
}

std::size_t ProposalLanes::check(const Prior& prior, std::size_t count) {
  inside_.fill(1.0);
  for (Index j = 0; j < dimension_; ++j) {
    check_bounds(x_[static_cast<std::size_t>(j)], prior.lower()[j], prior.upper()[j], in_vectors(count),
                 inside_);
  }
  if (!prior.is_box()) {
    add_prior_ratio(prior, count);
  }
  return static_cast<std::size_t>(
      std::count(inside_.begin(), inside_.begin() + static_cast<std::ptrdiff_t>(count), 1.0));
}

void ProposalLanes::add_prior_ratio(const Prior& prior, std::size_t count) {
  prior.log_kernel(columns_, count, proposed_log_prior_.data());
  for (std::size_t i = 0; i < count; ++i) {
    if (inside_[i] == 0.0) {
      continue;
    }
    if (!(proposed_log_prior_[i] > -std::numeric_limits<double>::infinity())) {
      inside_[i] = 0.0;
    } else if (!std::isfinite(log_prior_[i])) {
      throw SamplingError("the prior has drawn a point where its density is zero");
    } else {
      log_correction_[i] += proposed_log_prior_[i] - log_prior_[i];
    }
  }
}

}  // namespace tmcmc::detail
