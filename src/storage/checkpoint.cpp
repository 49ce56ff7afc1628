#include "storage/checkpoint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <boost/crc.hpp>
#include <cereal/archives/portable_binary.hpp>
#include <cereal/types/string.hpp>
#include <cereal/types/utility.hpp>
#include <cereal/types/vector.hpp>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include "errors/invalid_value.hpp"
#include "io/csv.hpp"
#include "io/files.hpp"

namespace storage {

namespace {

using tmcmc::Index;

/// Beginning of the file: this line, then the checksum of the rest, and the rest in cereal's
/// portable binary form.
constexpr std::string_view first_line = "tmcmc checkpoint 3\n";
constexpr std::size_t checksum_size = 9;  // eight hexadecimal digits and a line end
constexpr std::string_view start_again = "(delete it to start again)";
constexpr std::size_t longest_value = 120;

std::string checksum_line(std::string_view text) {
  boost::crc_32_type crc;
  crc.process_bytes(text.data(), text.size());
  return fmt::format("{:08x}\n", crc.checksum());
}

[[noreturn]] void fail(const std::filesystem::path& path, std::string_view what) {
  throw io::InputError(fmt::format("{}: {} {}", io::printable_path(path), what, start_again));
}

/// Sizes and numbers of a matrix or vector.
template <class Archive, class Matrix>
void transfer_matrix(Archive& archive, Matrix& matrix) {
  Index rows = matrix.rows();
  Index columns = matrix.cols();
  archive(rows, columns);
  if constexpr (Archive::is_loading::value) {
    matrix.resize(rows, columns);
  }
  archive(cereal::binary_data(matrix.data(), static_cast<std::size_t>(matrix.size()) * sizeof(double)));
}

/// Every field by name: a field that is added to the record does not compile until it is listed
/// here.
template <class Archive>
void transfer_stage(Archive& archive, tmcmc::StageRecord& record) {
  auto& [stage, beta, step, effective_sample_size, coefficient_of_variation, log_evidence_increment,
         acceptance_rate, feasible, distinct_ancestors, evaluations, redraws, move_steps, proposal_scale,
         equilibrium_t, transition_evaluations] = record;
  archive(stage, beta, step, effective_sample_size, coefficient_of_variation, log_evidence_increment,
          acceptance_rate, feasible, distinct_ancestors, evaluations, redraws, move_steps, proposal_scale,
          equilibrium_t, transition_evaluations);
}

/// Writes or reads a progress with the given bridge sums.
template <class Archive>
void transfer(Archive& archive, tmcmc::Progress& progress, tmcmc::BridgeSums& sums) {
  tmcmc::State& state = progress.state;
  archive(state.stage, state.beta, state.log_evidence, state.evaluations, state.proposal_scale,
          state.genealogy.chains, state.genealogy.parents);
  transfer_matrix(archive, state.points);
  transfer_matrix(archive, state.log_likelihood);
  std::size_t stages = progress.stages.size();
  archive(stages);
  progress.stages.resize(stages);
  for (tmcmc::StageRecord& record : progress.stages) {
    transfer_stage(archive, record);
  }
  archive(sums.log_evidence, sums.least_variance, sums.influence);
}

void require_same(const Settings& theirs, const std::filesystem::path& path, const Settings& ours) {
  for (std::size_t i = 0; i < ours.size(); ++i) {
    const auto& [name, value] = ours[i];
    if (i >= theirs.size() || theirs[i].first != name) {
      fail(path, fmt::format("checkpoint without the setting {}: expected one of this version", name));
    }
    if (theirs[i].second != value) {
      throw io::InputError(fmt::format(
          "{}: checkpoint was made with {} = {}, this run has {}: expected the same, or another file",
          io::printable_path(path), name, io::printable(theirs[i].second, longest_value),
          io::printable(value, longest_value)));
    }
  }
}

/// The bytes after the line with the checksum.
std::string checked(const std::string& text, const std::filesystem::path& path) {
  constexpr std::string_view magic = first_line.substr(0, first_line.rfind(' ') + 1);
  const std::string_view version = first_line.substr(magic.size(), first_line.size() - magic.size() - 1);
  if (!text.starts_with(magic)) {
    throw io::InputError(fmt::format("{}: not a checkpoint: expected '{}{}' in its first line",
                                     io::printable_path(path), magic, version));
  }
  if (!text.starts_with(first_line)) {
    const auto found = text.substr(magic.size(), text.find('\n') - magic.size());
    fail(path, fmt::format("checkpoint of format '{}': expected format {}", io::printable(found), version));
  }
  const std::string sum = text.substr(first_line.size(), checksum_size);
  std::string body = text.substr(std::min(text.size(), first_line.size() + checksum_size));
  if (sum != checksum_line(body)) {
    fail(path, "damaged or cut off: expected another checksum");
  }
  return body;
}

/// Settings do not show everything of which a model consists, such as the modules that a program
/// imports: therefore a few samples are evaluated again.
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
  std::ostringstream body(std::ios::binary);
  {
    cereal::PortableBinaryOutputArchive archive(body);
    archive(settings(run));
    tmcmc::Progress copy = progress;  // reading and writing share a function
    tmcmc::BridgeSums sums = progress.bridge.sums();
    transfer(archive, copy, sums);
  }
  io::OutputFile file(path);
  file.write(first_line);
  file.write(checksum_line(body.view()));
  file.write(body.view());
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
    throw io::InputError(fmt::format("{}: cannot be read: expected a checkpoint", io::printable_path(path)));
  }
  const std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  std::istringstream body(checked(text, path), std::ios::binary);
  tmcmc::Progress progress;
  try {
    cereal::PortableBinaryInputArchive archive(body);
    Settings theirs;
    archive(theirs);
    require_same(theirs, path, expected);
    tmcmc::BridgeSums sums;
    transfer(archive, progress, sums);
    if (body.peek() != std::char_traits<char>::eof()) {
      fail(path, "more than a checkpoint: expected its end");
    }
    progress.bridge = tmcmc::BridgeEvidence(std::move(sums));
    tmcmc::require_valid(progress, run.prior, run.options);
  } catch (const cereal::Exception&) {
    fail(path, "less than a checkpoint: expected more bytes");
  } catch (const errors::InvalidValue& invalid) {
    fail(path, fmt::format("{}: expected {}", invalid.field(), invalid.expected()));
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
                                  const tmcmc::LogLikelihood& log_likelihood, const tmcmc::Observer& observer,
                                  const std::function<void()>& look) {
  const tmcmc::Problem problem{log_likelihood, run.prior, look};
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

}  // namespace storage
