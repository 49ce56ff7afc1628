#include "tmcmc/moves.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>

#include "portable_math/multiversion.hpp"
#include "tmcmc/parallel.hpp"

namespace tmcmc {

namespace {

constexpr std::size_t lanes = 64;
using WordLanes = std::array<std::uint64_t, lanes>;
using Lanes = std::array<double, lanes>;

PORTABLE_MATH_MULTIVERSION
void log_uniforms(const WordLanes& words, Lanes& result) {
  for (std::size_t i = 0; i < lanes; ++i) {
    result[i] = portable_math::log_positive(uniform_open(words[i]));
  }
}

PORTABLE_MATH_MULTIVERSION
void normals(const WordLanes& radius_a, const WordLanes& radius_b, const WordLanes& angles, Lanes* z) {
  for (std::size_t i = 0; i < lanes; ++i) {
    const NormalPair a = normal_pair(radius_a[i], angles[i] >> 32U);
    const NormalPair b = normal_pair(radius_b[i], angles[i]);
    z[0][i] = a.first;
    z[1][i] = a.second;
    z[2][i] = b.first;
    z[3][i] = b.second;
  }
}

PORTABLE_MATH_MULTIVERSION
void add_scaled(double scale, const Lanes& z, Lanes& x) {
  for (std::size_t i = 0; i < lanes; ++i) {
    x[i] += scale * z[i];
  }
}

/// inside[i] &= low <= x[i] <= high
PORTABLE_MATH_MULTIVERSION
void check_bounds(const Lanes& x, double low, double high, Lanes& inside) {
  for (std::size_t i = 0; i < lanes; ++i) {
    const double above = x[i] >= low ? inside[i] : 0.0;
    inside[i] = x[i] <= high ? above : 0.0;
  }
}

}  // namespace

MoveCounts& MoveCounts::operator+=(const MoveCounts& other) {
  proposals += other.proposals;
  accepted += other.accepted;
  evaluations += other.evaluations;
  redraws += other.redraws;
  return *this;
}

struct Mover::Block {
  Block(Index rows, Index dimension)
      : candidates(rows, dimension),
        candidate_log_likelihood(rows),
        candidate_rows(static_cast<std::size_t>(rows)),
        log_uniform(static_cast<std::size_t>(rows)),
        z(static_cast<std::size_t>((dimension + 3) / 4 * 4)),
        x(static_cast<std::size_t>(dimension)) {}

  /// Standard normals for `count` rows into z, and the uniforms of the acceptance.
  void draw(const StreamKey& key, const DrawId& id, const std::uint64_t* rows, std::size_t count,
            Lanes* log_u) {
    for (std::size_t group = 0; 4 * group < z.size(); ++group) {
      DrawId place = id;
      place.block = static_cast<std::uint32_t>(group);
      for (std::size_t i = 0; i < count; ++i) {
        place.row = rows[i];
        const Words w = random_words(key, place);
        for (std::size_t word = 0; word < 4; ++word) {
          words[word][i] = w[word];
        }
      }
      if (group == 0 && log_u != nullptr) {
        log_uniforms(words[0], *log_u);
      }
      normals(words[1], words[2], words[3], &z[4 * group]);
    }
  }

  Population candidates;  // proposals inside the box, in the order of their rows
  Eigen::VectorXd candidate_log_likelihood;
  std::vector<Index> candidate_rows;
  std::vector<double> log_uniform;
  std::array<WordLanes, 4> words{};
  std::vector<Lanes> z;
  std::vector<Lanes> x;
};

Mover::Mover(const LogLikelihood& log_likelihood, const BoxPrior& prior, const StreamKey& key, int threads,
             Index batch_rows)
    : log_likelihood_(log_likelihood), prior_(prior), key_(key), threads_(threads), batch_rows_(batch_rows) {}

Mover::~Mover() = default;

MoveCounts Mover::step(const MetropolisKernel& kernel, std::span<const Index> rows, std::uint32_t draw,
                       Population& points, Eigen::VectorXd& log_likelihood) {
  const Index n = rows.empty() ? points.rows() : static_cast<Index>(rows.size());
  const Index block_size = rows_per_call(n, threads_, batch_rows_);
  const Index block_count = (n + block_size - 1) / block_size;
  while (static_cast<Index>(blocks_.size()) < block_count ||
         blocks_.front()->candidates.rows() < block_size) {
    if (!blocks_.empty() && blocks_.front()->candidates.rows() < block_size) {
      blocks_.clear();
    }
    blocks_.push_back(std::make_unique<Block>(block_size, points.cols()));
  }
  std::vector<MoveCounts> counts(static_cast<std::size_t>(block_count));
  for_each_block(n, block_size, threads_, [&](Index block, Index begin, Index end) {
    const auto b = static_cast<std::size_t>(block);
    counts[b] = step_block(kernel, rows.empty() ? nullptr : rows.data(), begin, end, draw, points,
                           log_likelihood, *blocks_[b]);
  });
  MoveCounts total;
  for (const MoveCounts& c : counts) {
    total += c;
  }
  return total;
}

MoveCounts Mover::step_block(const MetropolisKernel& kernel, const Index* rows, Index begin, Index end,
                             std::uint32_t draw, Population& points, Eigen::VectorXd& log_likelihood,
                             Block& block) const {
  const Index d = points.cols();
  MoveCounts counts;
  counts.proposals = end - begin;
  Index candidates = 0;
  DrawId id{.purpose = Purpose::move, .stage = kernel.stage, .draw = draw};
  std::array<std::uint64_t, lanes> row_ids{};

  const auto propose = [&](std::size_t count) {  // x = theta + L z
    for (Index j = 0; j < d; ++j) {
      Lanes& x = block.x[static_cast<std::size_t>(j)];
      const double* column = points.col(j).data();
      for (std::size_t i = 0; i < count; ++i) {
        x[i] = column[row_ids[i]];
      }
      for (Index k = 0; k <= j; ++k) {
        add_scaled(kernel.factor(j, k), block.z[static_cast<std::size_t>(k)], x);
      }
    }
  };
  Lanes inside{};
  const auto check = [&](std::size_t count) {  // number of proposals inside the box
    inside.fill(1.0);
    for (Index j = 0; j < d; ++j) {
      check_bounds(block.x[static_cast<std::size_t>(j)], prior_.lower()[j], prior_.upper()[j], inside);
    }
    return static_cast<std::size_t>(
        std::count(inside.begin(), inside.begin() + static_cast<std::ptrdiff_t>(count), 1.0));
  };
  const auto keep = [&](std::size_t lane, std::uint64_t row, double log_uniform) {
    for (Index j = 0; j < d; ++j) {
      block.candidates(candidates, j) = block.x[static_cast<std::size_t>(j)][lane];
    }
    block.candidate_rows[static_cast<std::size_t>(candidates)] = static_cast<Index>(row);
    block.log_uniform[static_cast<std::size_t>(candidates)] = log_uniform;
    ++candidates;
  };

  Lanes log_u{};
  const auto keep_all = [&](std::size_t count) {
    for (Index j = 0; j < d; ++j) {
      std::copy_n(block.x[static_cast<std::size_t>(j)].begin(), count,
                  block.candidates.col(j).data() + candidates);
    }
    std::copy_n(row_ids.begin(), count, block.candidate_rows.begin() + candidates);
    std::copy_n(log_u.begin(), count, block.log_uniform.begin() + candidates);
    candidates += static_cast<Index>(count);
  };
  std::array<std::size_t, lanes> outside{};
  for (Index first = begin; first < end; first += static_cast<Index>(lanes)) {
    const auto count = static_cast<std::size_t>(std::min(end - first, static_cast<Index>(lanes)));
    for (std::size_t i = 0; i < count; ++i) {
      const Index position = first + static_cast<Index>(i);
      row_ids[i] = static_cast<std::uint64_t>(rows == nullptr ? position : rows[position]);
    }
    id.attempt = 0;
    block.draw(key_, id, row_ids.data(), count, &log_u);
    propose(count);
    if (check(count) == count) {
      keep_all(count);
      continue;
    }
    std::size_t outside_count = 0;
    for (std::size_t i = 0; i < count; ++i) {
      if (inside[i] != 0.0) {
        keep(i, row_ids[i], log_u[i]);
      } else {
        outside[outside_count++] = i;
      }
    }
    if (kernel.boundary == Boundary::reject) {
      continue;
    }
    Lanes pending_log_u = log_u;
    while (outside_count > 0) {  // draw the rest again, packed to the front
      if (static_cast<Index>(++id.attempt) > kernel.max_redraws) {
        throw SamplingError("a proposal fell outside the prior box " + std::to_string(kernel.max_redraws) +
                            " times in a row (max_redraws)");
      }
      for (std::size_t k = 0; k < outside_count; ++k) {
        row_ids[k] = row_ids[outside[k]];
        pending_log_u[k] = pending_log_u[outside[k]];
      }
      counts.redraws += static_cast<Index>(outside_count);
      block.draw(key_, id, row_ids.data(), outside_count, nullptr);
      propose(outside_count);
      check(outside_count);
      std::size_t still_outside = 0;
      for (std::size_t k = 0; k < outside_count; ++k) {
        if (inside[k] != 0.0) {
          keep(k, row_ids[k], pending_log_u[k]);
        } else {
          outside[still_outside++] = k;
        }
      }
      outside_count = still_outside;
    }
  }

  if (candidates == 0) {
    return counts;
  }
  log_likelihood_(block.candidates.topRows(candidates), block.candidate_log_likelihood.head(candidates));
  counts.evaluations = candidates;
  require_valid(block.candidates.topRows(candidates), block.candidate_log_likelihood.head(candidates));
  for (Index k = 0; k < candidates; ++k) {
    const Index row = block.candidate_rows[static_cast<std::size_t>(k)];
    const double log_ratio = kernel.beta * (block.candidate_log_likelihood[k] - log_likelihood[row]);
    if (block.log_uniform[static_cast<std::size_t>(k)] <= log_ratio) {
      for (Index j = 0; j < d; ++j) {
        points(row, j) = block.candidates(k, j);
      }
      log_likelihood[row] = block.candidate_log_likelihood[k];
      ++counts.accepted;
    }
  }
  return counts;
}

void require_valid(const Eigen::Ref<const Eigen::MatrixXd>& points,
                   const Eigen::Ref<const Eigen::VectorXd>& log_likelihood) {
  for (Index i = 0; i < log_likelihood.size(); ++i) {
    if (!(log_likelihood[i] < std::numeric_limits<double>::infinity())) {
      std::ostringstream message;
      message.precision(17);
      message << "log-likelihood is " << log_likelihood[i] << " at (";
      for (Index j = 0; j < points.cols(); ++j) {
        message << (j > 0 ? ", " : "") << points(i, j);
      }
      message << "): expected a finite number or minus infinity";
      throw SamplingError(message.str());
    }
  }
}

}  // namespace tmcmc
