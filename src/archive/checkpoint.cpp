#include "archive/checkpoint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <boost/crc.hpp>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string_view>

#include "archive/text_format.hpp"
#include "io/files.hpp"

namespace archive {

namespace {

using tmcmc::Index;

constexpr std::string_view magic = "tmcmc checkpoint ";
constexpr std::string_view version = "1";
constexpr std::string_view checksum_line = "crc32 = ";
constexpr std::size_t longest_value = 120;

std::string checksum(std::string_view text) {
  boost::crc_32_type crc;
  crc.process_bytes(text.data(), text.size());
  return fmt::format("{:08x}", crc.checksum());
}

/// Every field by name: one that is added to the record does not compile until it is listed here.
template <class Record, class Function>
void for_each_field(Record& record, Function function) {
  auto& [stage, beta, step, effective_sample_size, coefficient_of_variation, log_evidence_increment,
         acceptance_rate, feasible, distinct_ancestors, evaluations, redraws, move_steps, proposal_scale,
         transition_evaluations] = record;
  function(stage);
  function(beta);
  function(step);
  function(effective_sample_size);
  function(coefficient_of_variation);
  function(log_evidence_increment);
  function(acceptance_rate);
  function(feasible);
  function(distinct_ancestors);
  function(evaluations);
  function(redraws);
  function(move_steps);
  function(proposal_scale);
  function(transition_evaluations);
}

// ---------------------------------------------------------------- writing

void write_progress(Writer& file, const tmcmc::Progress& progress) {
  const tmcmc::State& state = progress.state;
  const tmcmc::BridgeSums& sums = progress.bridge.sums();
  file.line("stage", state.stage);
  file.line("beta", state.beta);
  file.line("log_evidence", state.log_evidence);
  file.line("evaluations", state.evaluations);
  file.line("proposal_scale", state.proposal_scale);
  file.line("chains", state.genealogy.chains);
  file.line("bridge.log_evidence", sums.log_evidence);
  file.line("bridge.least_variance", sums.least_variance);
  file.table("stages", progress.stages.size());
  for (const tmcmc::StageRecord& record : progress.stages) {
    for_each_field(record, [&](auto field) { file.cell(field); });
    file.end_row();
  }
  file.table("points", static_cast<std::size_t>(state.points.rows()));
  for (Index i = 0; i < state.points.rows(); ++i) {
    for (const double x : state.points.row(i)) {
      file.cell(x);
    }
    file.cell(state.log_likelihood[i]);
    file.end_row();
  }
  file.table("ancestors", state.genealogy.ancestors);
  file.table("influence", sums.influence);
  file.table("parents", sums.parents);
}

// ---------------------------------------------------------------- reading

void require_same(Reader& file, const std::filesystem::path& path, const Settings& expected) {
  for (const auto& [name, ours] : expected) {
    const auto theirs = file.value(name);
    if (theirs != ours) {
      throw io::InputError(fmt::format(
          "{}: checkpoint was made with {} = {}, this run has {}: expected the same, or another file",
          path.string(), name, io::printable(theirs, longest_value), io::printable(ours, longest_value)));
    }
  }
}

tmcmc::Progress read_progress(Reader& file, Index dimension) {
  tmcmc::Progress progress;
  tmcmc::State& state = progress.state;
  tmcmc::BridgeSums sums;
  file.read("stage", state.stage);
  file.read("beta", state.beta);
  file.read("log_evidence", state.log_evidence);
  file.read("evaluations", state.evaluations);
  file.read("proposal_scale", state.proposal_scale);
  file.read("chains", state.genealogy.chains);
  file.read("bridge.log_evidence", sums.log_evidence);
  file.read("bridge.least_variance", sums.least_variance);
  for (std::size_t left = file.table("stages"); left > 0; --left) {
    file.next_line();
    for_each_field(progress.stages.emplace_back(), [&](auto& field) { file.cell(field); });
    file.end_row();
  }
  std::vector<std::vector<double>> rows;
  file.table("points", rows);
  state.points.resize(static_cast<Index>(rows.size()), dimension);
  state.log_likelihood.resize(static_cast<Index>(rows.size()));
  for (Index i = 0; i < state.points.rows(); ++i) {
    const auto& row = rows[static_cast<std::size_t>(i)];
    if (static_cast<Index>(row.size()) != dimension + 1) {
      file.fail(fmt::format("a sample of {} numbers: expected {}", row.size(), dimension + 1));
    }
    std::copy_n(row.begin(), dimension, state.points.row(i).begin());
    state.log_likelihood[i] = row.back();
  }
  file.table("ancestors", state.genealogy.ancestors);
  file.table("influence", sums.influence);
  file.table("parents", sums.parents);
  file.end();
  progress.bridge = tmcmc::BridgeEvidence(std::move(sums));
  return progress;
}

/// The text before the line of the checksum.
std::string_view checked(std::string_view text, const std::filesystem::path& path) {
  const auto fail = [&](std::string_view what) {
    throw io::InputError(fmt::format("{}: {}", path.string(), what));
  };
  if (!text.starts_with(magic)) {
    fail(fmt::format("not a checkpoint: expected '{}{}' in its first line", magic, version));
  }
  const auto found = text.substr(magic.size(), text.find('\n') - magic.size());
  if (found != version) {
    fail(fmt::format("checkpoint of format '{}': expected format {} {}", io::printable(found), version,
                     start_again));
  }
  const std::size_t body = text.size() - std::min(text.size(), checksum_line.size() + 9);
  const auto last = text.substr(body);
  if (!last.starts_with(checksum_line) || !last.ends_with('\n')) {
    fail(fmt::format("cut off: expected a checksum in the last line {}", start_again));
  }
  const auto sum = last.substr(checksum_line.size(), 8);
  const auto expected = checksum(text.substr(0, body));
  if (sum != expected) {
    fail(fmt::format("damaged: checksum {}, expected {} {}", io::printable(sum), expected, start_again));
  }
  return text.substr(0, body);
}

/// Settings do not show all that a model consists of, such as the modules that a program imports: a few samples are
/// evaluated again.
void require_same_model(const std::filesystem::path& path, const tmcmc::LogLikelihood& log_likelihood,
                        const tmcmc::State& state) {
  const Index rows = state.points.rows();
  const std::array<Index, 3> sampled = {0, rows / 2, rows - 1};
  const Eigen::MatrixXd points = state.points(sampled, Eigen::all);
  Eigen::VectorXd now(points.rows());
  log_likelihood(points, now);
  for (Index i = 0; i < now.size(); ++i) {
    const double before = state.log_likelihood[sampled.at(static_cast<std::size_t>(i))];
    if (now[i] != before) {
      throw io::InputError(fmt::format(
          "{}: the model has changed: the log-likelihood of a sample in the checkpoint was {} and is now {}: "
          "expected the same, or another file",
          io::printable_path(path), io::format_number(before), io::format_number(now[i])));
    }
  }
}

}  // namespace

std::string file_checksum(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  boost::crc_optimal<64, 0x42F0E1EBA9EA3693, ~0ULL, ~0ULL, true, true> crc;
  std::vector<char> block(std::size_t{1} << 16U);
  while (file) {
    file.read(block.data(), static_cast<std::streamsize>(block.size()));
    crc.process_bytes(block.data(), static_cast<std::size_t>(file.gcount()));
  }
  if (!file.eof()) {
    throw io::InputError({.path = path, .found = "cannot be read", .expected = "a file"});
  }
  return fmt::format("{:016x}", crc.checksum());
}

void write_checkpoint(const std::filesystem::path& path, const RunDescription& run,
                      const tmcmc::Progress& progress) {
  Writer writer(fmt::format("{}{}", magic, version));
  for (const auto& [name, value] : settings(run)) {
    writer.line(name, value);
  }
  write_progress(writer, progress);
  io::OutputFile file(path);
  file.write(writer.text());
  file.write(fmt::format("{}{}\n", checksum_line, checksum(writer.text())));
  file.commit();
}

std::optional<tmcmc::Progress> read_checkpoint(const std::filesystem::path& path, const RunDescription& run) {
  const Settings expected = settings(run);
  std::error_code error;
  if ((!std::filesystem::exists(path, error) && !error) || std::filesystem::is_character_file(path, error)) {
    return std::nullopt;
  }
  std::ifstream file(path, std::ios::binary);
  if (!file || !std::filesystem::is_regular_file(path, error)) {
    throw io::InputError(fmt::format("{}: cannot be read: expected a checkpoint", path.string()));
  }
  const std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  const auto body = checked(text, path);
  Reader reader(path, body.substr(body.find('\n') + 1));
  require_same(reader, path, expected);
  tmcmc::Progress progress = read_progress(reader, run.prior.dimension());
  try {
    tmcmc::require_valid(progress, run.prior, run.options);
  } catch (const std::invalid_argument& invalid) {
    reader.fail(invalid.what());
  }
  return progress;
}

void remove_checkpoint(const std::filesystem::path& path) {
  std::error_code error;
  const std::filesystem::path file = std::filesystem::canonical(path, error);
  if (error || !std::filesystem::is_regular_file(file, error) || io::OutputFile(path).in_place()) {
    return;
  }
  if (!std::filesystem::remove(file, error) && error) {
    throw io::OutputError(
        fmt::format("{}: cannot be removed: {}: expected a checkpoint in a writable directory",
                    io::printable_path(path), error.message()));
  }
}

tmcmc::Result run_with_checkpoint(const std::filesystem::path& path, const RunDescription& run,
                                  const tmcmc::LogLikelihood& log_likelihood,
                                  const tmcmc::Observer& observer) {
  const tmcmc::Problem problem{log_likelihood, run.prior};
  {  // a path that cannot be written is better known now than after the first stage
    const io::OutputFile writable(path);
  }
  auto progress = read_checkpoint(path, run);
  if (progress) {
    require_same_model(path, log_likelihood, progress->state);
  }
  const auto keep = [&](const tmcmc::Progress& now) {
    write_checkpoint(path, run, now);
    if (observer) {
      observer(now);
    }
  };
  return progress ? tmcmc::resume(problem, run.options, run.key, std::move(*progress), keep)
                  : tmcmc::run(problem, run.options, run.key, keep);
}

}  // namespace archive
