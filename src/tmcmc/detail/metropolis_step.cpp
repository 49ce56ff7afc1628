#include "tmcmc/detail/metropolis_step.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <sstream>

#include "tmcmc/parallel.hpp"

namespace tmcmc::detail {

MoveCounts& MoveCounts::operator+=(const MoveCounts& other) {
  proposals += other.proposals;
  accepted += other.accepted;
  walks += other.walks;
  accepted_walks += other.accepted_walks;
  evaluations += other.evaluations;
  redraws += other.redraws;
  return *this;
}

struct Mover::Block {
  Block(Index most_rows, Index dimension)
      : candidates(most_rows, dimension),
        candidate_log_likelihood(most_rows),
        candidate_rows(static_cast<std::size_t>(most_rows)),
        independent(static_cast<std::size_t>(most_rows)),
        thresholds(static_cast<std::size_t>(most_rows)),
        log_prior(static_cast<std::size_t>(most_rows)),
        rows(static_cast<std::size_t>(most_rows)),
        log_uniforms(static_cast<std::size_t>(most_rows)),
        accepted_numbers(static_cast<std::size_t>(most_rows)),
        proposals(dimension) {}

  /// Adds the current proposals of the given lanes to the candidates.
  void keep(std::span<const std::size_t> lanes, const ProposalLanes::RowIds& lane_rows,
            const ProposalLanes::Lanes& lane_log_uniforms) {
    for (Index j = 0; j < candidates.cols(); ++j) {
      const ProposalLanes::Lanes& x = proposals.parameter(j);
      double* to = candidates.col(j).data() + kept;
      for (std::size_t k = 0; k < lanes.size(); ++k) {
        to[k] = x[lanes[k]];
      }
    }
    for (const std::size_t lane : lanes) {
      const auto k = static_cast<std::size_t>(kept++);
      candidate_rows[k] = static_cast<Index>(lane_rows[lane]);
      independent[k] = proposals.independent()[lane];
      thresholds[k] = lane_log_uniforms[lane] - proposals.log_correction()[lane];
      log_prior[k] = proposals.log_prior()[lane];
    }
  }

  /// Makes one proposal for each of the first `row_count` rows. Proposals inside the support become
  /// candidates; the rows of the other proposals move to the front. Returns the number of these
  /// rows.
  std::size_t propose(const MetropolisKernel& kernel, const Prior& prior, const StreamKey& key,
                      const DrawId& id, std::size_t row_count, const Population& points,
                      Eigen::VectorXd& log_prior_of_points, MoveCounts& counts);

  /// Moves the rows of accepted candidates to the candidates' values, and returns the numbers of
  /// the accepted candidates.
  std::span<const Index> accept(double beta, Population& points, Eigen::VectorXd& log_likelihood,
                                MoveCounts& counts);

  Population candidates;  // proposals inside the support: the first `kept` rows
  Index kept = 0;
  Eigen::VectorXd candidate_log_likelihood;
  std::vector<Index> candidate_rows;
  std::vector<double> independent;  // 1 for independent proposals
  std::vector<double>
      thresholds;  // log-uniform less the correction: least log-ratio of the likelihoods to accept
  std::vector<double> log_prior;        // of the candidates
  std::vector<std::uint64_t> rows;      // that have no proposal inside the support yet
  std::vector<double> log_uniforms;     // of these rows
  std::vector<Index> accepted_numbers;  // of the candidates
  ProposalLanes proposals;
};

std::size_t Mover::Block::propose(const MetropolisKernel& kernel, const Prior& prior, const StreamKey& key,
                                  const DrawId& id, std::size_t row_count, const Population& points,
                                  Eigen::VectorXd& log_prior_of_points, MoveCounts& counts) {
  constexpr std::size_t at_once = ProposalLanes::lanes;
  ProposalLanes::RowIds lane_rows{};
  ProposalLanes::Lanes log_u{};
  std::array<std::size_t, at_once> inside{};
  std::size_t left = 0;
  for (std::size_t first = 0; first < row_count; first += at_once) {
    const std::size_t count = std::min(row_count - first, at_once);
    std::copy_n(&rows[first], count, lane_rows.begin());
    proposals.draw(key, id, kernel, lane_rows, count, id.attempt == 0 ? &log_u : nullptr);
    if (id.attempt == 0) {
      counts.walks += static_cast<Index>(
          std::count(proposals.independent().begin(),
                     proposals.independent().begin() + static_cast<std::ptrdiff_t>(count), 0.0));
    } else {
      std::copy_n(&log_uniforms[first], count, log_u.begin());
    }
    proposals.propose(kernel, prior, points, lane_rows, count, log_prior_of_points);
    proposals.check(prior, count);
    std::size_t inside_count = 0;
    for (std::size_t i = 0; i < count; ++i) {  // no branches: which are inside cannot be predicted
      inside[inside_count] = i;
      rows[left] = lane_rows[i];  // never beyond first + i
      log_uniforms[left] = log_u[i];
      const bool is_inside = proposals.inside(i);
      inside_count += is_inside ? 1 : 0;
      left += is_inside ? 0 : 1;
    }
    keep({inside.data(), inside_count}, lane_rows, log_u);
  }
  return left;
}

std::span<const Index> Mover::Block::accept(double beta, Population& points, Eigen::VectorXd& log_likelihood,
                                            MoveCounts& counts) {
  std::size_t count = 0;
  for (Index k = 0; k < kept; ++k) {
    const Index row = candidate_rows[static_cast<std::size_t>(k)];
    const double log_ratio = beta * (candidate_log_likelihood[k] - log_likelihood[row]);
    accepted_numbers[count] = k;
    count += thresholds[static_cast<std::size_t>(k)] <= log_ratio ? 1 : 0;
  }
  const std::span<const Index> accepted(accepted_numbers.data(), count);
  for (Index j = 0; j < points.cols(); ++j) {
    double* x = points.col(j).data();
    const double* candidate = candidates.col(j).data();
    for (const Index k : accepted) {
      x[candidate_rows[static_cast<std::size_t>(k)]] = candidate[k];
    }
  }
  for (const Index k : accepted) {
    const Index row = candidate_rows[static_cast<std::size_t>(k)];
    log_likelihood[row] = candidate_log_likelihood[k];
    counts.accepted_walks += independent[static_cast<std::size_t>(k)] == 0.0 ? 1 : 0;
  }
  counts.accepted += static_cast<Index>(count);
  return accepted;
}

Mover::Mover(const LogLikelihood& log_likelihood, const Prior& prior, const StreamKey& key, int threads,
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
  if (!prior_.is_box() && known_points_.rows() != points.rows()) {
    known_points_ = points;
    log_prior_.setConstant(points.rows(), std::numeric_limits<double>::quiet_NaN());
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

/// Forgets the prior density of rows that the caller has changed since it was computed: at the
/// start of a stage all rows.
void Mover::forget_moved_rows(const Index* rows, Index begin, Index end, const Population& points) {
  for (Index i = begin; i < end; ++i) {
    const Index row = rows == nullptr ? i : rows[i];
    bool moved = false;
    for (Index j = 0; j < points.cols(); ++j) {
      moved = moved || known_points_(row, j) != points(row, j);
    }
    if (moved) {
      log_prior_[row] = std::numeric_limits<double>::quiet_NaN();
      for (Index j = 0; j < points.cols(); ++j) {
        known_points_(row, j) = points(row, j);
      }
    }
  }
}

MoveCounts Mover::step_block(const MetropolisKernel& kernel, const Index* rows, Index begin, Index end,
                             std::uint32_t draw, Population& points, Eigen::VectorXd& log_likelihood,
                             Block& block) {
  if (!prior_.is_box()) {
    forget_moved_rows(rows, begin, end, points);
  }
  for (Index i = begin; i < end; ++i) {
    block.rows[static_cast<std::size_t>(i - begin)] =
        static_cast<std::uint64_t>(rows == nullptr ? i : rows[i]);
  }
  MoveCounts counts;
  counts.proposals = end - begin;
  block.kept = 0;
  DrawId id{.purpose = Purpose::move, .stage = kernel.stage, .draw = draw};
  auto left = block.propose(kernel, prior_, key_, id, static_cast<std::size_t>(end - begin), points,
                            log_prior_, counts);
  while (left > 0 && kernel.boundary == Boundary::redraw) {
    if (static_cast<Index>(++id.attempt) > kernel.max_redraws) {
      throw SamplingError("a proposal fell outside the support of the prior " +
                          std::to_string(kernel.max_redraws) + " times in a row (max_redraws)");
    }
    counts.redraws += static_cast<Index>(left);
    left = block.propose(kernel, prior_, key_, id, left, points, log_prior_, counts);
  }
  if (block.kept > 0) {
    auto values = block.candidate_log_likelihood.head(block.kept);
    values.setConstant(std::numeric_limits<double>::quiet_NaN());
    log_likelihood_(block.candidates.topRows(block.kept), values);
    counts.evaluations = block.kept;
    require_valid(block.candidates.topRows(block.kept), values);
    const auto accepted = block.accept(kernel.beta, points, log_likelihood, counts);
    if (!prior_.is_box()) {
      for (const Index k : accepted) {
        const Index row = block.candidate_rows[static_cast<std::size_t>(k)];
        log_prior_[row] = block.log_prior[static_cast<std::size_t>(k)];
        known_points_.row(row) = points.row(row);
      }
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

}  // namespace tmcmc::detail
