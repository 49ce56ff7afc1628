/// \file
/// The progress of a run in a file, so that a run that was killed goes on after its last stage and
/// ends with the same bytes.
///
/// The file holds the line `tmcmc checkpoint 3`, a line with the CRC-32 (that of zlib) of all bytes
/// behind it, and in the portable binary form of the library cereal what the run depends on
/// (storage::settings) and its tmcmc::Progress.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "storage/settings.hpp"
#include "tmcmc/sampler.hpp"

namespace storage {

/// Writes the file anew; it appears complete or not at all (io::OutputFile).
/// \throws io::OutputError; errors::InvalidValue as settings.
void write_checkpoint(const std::filesystem::path& path, const RunDescription& run,
                      const tmcmc::Progress& progress);

/// Reads a checkpoint of this run; nothing if there is no such file, or a device such as /dev/null.
/// \throws io::InputError, one line that names the file and what is wrong with it: it cannot be
///         read, is no checkpoint or one of another format, is damaged or cut off, was made by a
///         run of other settings (naming the first that differs and both values), or holds what
///         tmcmc::require_valid refuses.
[[nodiscard]] std::optional<tmcmc::Progress> read_checkpoint(const std::filesystem::path& path,
                                                             const RunDescription& run);

/// CRC-64 (that of xz) of the file's bytes, sixteen hexadecimal digits: to tell versions of a model
/// or its data apart in RunDescription::model.
/// \throws io::InputError if the file cannot be read.
[[nodiscard]] std::string file_checksum(const std::filesystem::path& path);

/// Removes a checkpoint whose results are in place. Only a file is removed, the one that a symbolic
/// link points to; devices, pipes, descriptors such as /dev/stdout and the link itself stay, and
/// nothing happens if there is no file.
/// \throws io::OutputError if the file cannot be removed.
void remove_checkpoint(const std::filesystem::path& path);

/// A run that keeps its progress in a file: it goes on from there if the file exists, else it
/// starts, and writes the file after the draws from the prior and after each stage. The file stays
/// after the end, so that the next call returns the result: remove_checkpoint when the result is in
/// place. Before a run goes on, three samples of the file are evaluated again and must have the
/// same log-likelihoods, so that no result mixes two models.
/// \param observer  is called after the file was written
/// \param look  tmcmc::Problem::look
/// \throws io::InputError for a model that gives other log-likelihoods, the file untouched; as
///         tmcmc::run, read_checkpoint and write_checkpoint; a path that cannot be written is found
///         out at the start.
[[nodiscard]] tmcmc::Result run_with_checkpoint(const std::filesystem::path& path, const RunDescription& run,
                                                const tmcmc::LogLikelihood& log_likelihood,
                                                const tmcmc::Observer& observer = {},
                                                const std::function<void()>& look = {});

}  // namespace storage
