#include "tmcmc/detail/metropolis_step.hpp"

#include <algorithm>
#include <functional>
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
  Block(Index rows, Index dimension)
      : candidates(rows, dimension),
        candidate_log_likelihood(rows),
        candidate_rows(static_cast<std::size_t>(rows)),
        independent(static_cast<std::size_t>(rows)),
        thresholds(static_cast<std::size_t>(rows)),
        log_prior(static_cast<std::size_t>(rows)),
        proposals(dimension) {}

  Population candidates;  // proposals inside the support, in the order of their rows
  Eigen::VectorXd candidate_log_likelihood;
  std::vector<Index> candidate_rows;
  std::vector<double> independent;  // 1 for independent proposals
  std::vector<double>
      thresholds;  // log-uniform less the correction: least log-ratio of the likelihoods to accept
  std::vector<double> log_prior;  // of the candidates
  ProposalLanes proposals;
};

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

/// The caller has changed some rows since their prior density was computed: at the start of a stage all of them.
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
  const Index d = points.cols();
  MoveCounts counts;
  counts.proposals = end - begin;
  if (!prior_.is_box()) {
    forget_moved_rows(rows, begin, end, points);
  }
  Index candidates = 0;
  DrawId id{.purpose = Purpose::move, .stage = kernel.stage, .draw = draw};
  ProposalLanes::RowIds row_ids{};

  ProposalLanes& proposals = block.proposals;
  ProposalLanes::Lanes log_u{};
  const auto propose = [&](std::size_t count,
                           ProposalLanes::Lanes* log_uniforms) {  // returns the number inside the support
    proposals.draw(key_, id, kernel, row_ids, count, log_uniforms);
    proposals.propose(kernel, prior_, points, row_ids, count, log_prior_);
    return proposals.check(prior_, count);
  };
  const auto keep = [&](std::size_t lane, double log_uniform) {
    for (Index j = 0; j < d; ++j) {
      block.candidates(candidates, j) = proposals.parameter(j)[lane];
    }
    block.candidate_rows[static_cast<std::size_t>(candidates)] = static_cast<Index>(row_ids[lane]);
    block.independent[static_cast<std::size_t>(candidates)] = proposals.independent()[lane];
    block.thresholds[static_cast<std::size_t>(candidates)] = log_uniform - proposals.log_correction()[lane];
    block.log_prior[static_cast<std::size_t>(candidates)] = proposals.log_prior()[lane];
    ++candidates;
  };
  const auto keep_all = [&](std::size_t count) {
    for (Index j = 0; j < d; ++j) {
      std::copy_n(proposals.parameter(j).begin(), count, block.candidates.col(j).data() + candidates);
    }
    std::copy_n(row_ids.begin(), count, block.candidate_rows.begin() + candidates);
    std::copy_n(proposals.independent().begin(), count, block.independent.begin() + candidates);
    std::copy_n(proposals.log_prior().begin(), count, block.log_prior.begin() + candidates);
    std::transform(log_u.begin(), log_u.begin() + static_cast<std::ptrdiff_t>(count),
                   proposals.log_correction().begin(), block.thresholds.begin() + candidates, std::minus<>());
    candidates += static_cast<Index>(count);
  };
  constexpr std::size_t at_once = ProposalLanes::lanes;
  std::array<std::size_t, at_once> outside{};
  for (Index first = begin; first < end; first += static_cast<Index>(at_once)) {
    const auto count = static_cast<std::size_t>(std::min(end - first, static_cast<Index>(at_once)));
    for (std::size_t i = 0; i < count; ++i) {
      const Index position = first + static_cast<Index>(i);
      row_ids[i] = static_cast<std::uint64_t>(rows == nullptr ? position : rows[position]);
    }
    id.attempt = 0;
    const std::size_t inside_count = propose(count, &log_u);
    counts.walks += static_cast<Index>(
        std::count(proposals.independent().begin(),
                   proposals.independent().begin() + static_cast<std::ptrdiff_t>(count), 0.0));
    if (inside_count == count) {
      keep_all(count);
      continue;
    }
    std::size_t outside_count = 0;
    for (std::size_t i = 0; i < count; ++i) {
      if (proposals.inside(i)) {
        keep(i, log_u[i]);
      } else {
        outside[outside_count++] = i;
      }
    }
    if (kernel.boundary == Boundary::reject) {
      continue;
    }
    while (outside_count > 0) {  // draw the rest again, packed to the front
      if (static_cast<Index>(++id.attempt) > kernel.max_redraws) {
        throw SamplingError("a proposal fell outside the support of the prior " +
                            std::to_string(kernel.max_redraws) + " times in a row (max_redraws)");
      }
      for (std::size_t k = 0; k < outside_count; ++k) {
        row_ids[k] = row_ids[outside[k]];
        log_u[k] = log_u[outside[k]];
      }
      counts.redraws += static_cast<Index>(outside_count);
      propose(outside_count, nullptr);
      std::size_t still_outside = 0;
      for (std::size_t k = 0; k < outside_count; ++k) {
        if (proposals.inside(k)) {
          keep(k, log_u[k]);
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
  block.candidate_log_likelihood.head(candidates).setConstant(std::numeric_limits<double>::quiet_NaN());
  log_likelihood_(block.candidates.topRows(candidates), block.candidate_log_likelihood.head(candidates));
  counts.evaluations = candidates;
  require_valid(block.candidates.topRows(candidates), block.candidate_log_likelihood.head(candidates));
  for (Index k = 0; k < candidates; ++k) {
    const Index row = block.candidate_rows[static_cast<std::size_t>(k)];
    const double log_ratio = kernel.beta * (block.candidate_log_likelihood[k] - log_likelihood[row]);
    if (block.thresholds[static_cast<std::size_t>(k)] <= log_ratio) {
      for (Index j = 0; j < d; ++j) {
        points(row, j) = block.candidates(k, j);
      }
      log_likelihood[row] = block.candidate_log_likelihood[k];
      if (!prior_.is_box()) {
        log_prior_[row] = block.log_prior[static_cast<std::size_t>(k)];
        known_points_.row(row) = points.row(row);
      }
      ++counts.accepted;
      counts.accepted_walks += block.independent[static_cast<std::size_t>(k)] == 0.0 ? 1 : 0;
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
