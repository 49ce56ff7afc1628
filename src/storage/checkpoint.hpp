/// \file
/// The progress of a run in a file, so that a run that was killed resumes after its last stage and
/// ends with the same bytes.
///
/// The file holds the line `tmcmc checkpoint 3`, a line with the CRC-32 (as in zlib) of all bytes
/// after it, and, in the portable binary format of the library cereal, the settings on which the
/// run depends (storage::settings) and its tmcmc::Progress.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "storage/settings.hpp"
#include "tmcmc/sampler.hpp"

namespace storage {

/// Writes the file anew; the file appears complete or not at all (io::OutputFile).
/// \throws io::OutputError; errors::InvalidValue as settings.
void write_checkpoint(const std::filesystem::path& path, const RunDescription& run,
                      const tmcmc::Progress& progress);

/// Reads a checkpoint of this run; returns nothing if there is no such file, or if it is a device
/// such as /dev/null.
/// \throws io::InputError, with one line that names the file and the fault: the file cannot be
///         read, is not a checkpoint or has another format, is damaged or cut off, was made by a
///         run with other settings (naming the first that differs and both values), or holds values
///         that tmcmc::require_valid refuses.
[[nodiscard]] std::optional<tmcmc::Progress> read_checkpoint(const std::filesystem::path& path,
                                                             const RunDescription& run);

/// CRC-64 (as in xz) of the file's bytes, in sixteen hexadecimal digits. It distinguishes versions
/// of a model or its data in RunDescription::model.
/// \throws io::InputError if the file cannot be read.
[[nodiscard]] std::string file_checksum(const std::filesystem::path& path);

/// Removes a checkpoint whose results are in place. Only a file is removed, including the one to
/// which a symbolic link points; devices, pipes, descriptors such as /dev/stdout and the link
/// itself stay, and nothing happens if there is no file.
/// \throws io::OutputError if the file cannot be removed.
void remove_checkpoint(const std::filesystem::path& path);

/// A run that keeps its progress in a file: it resumes from the file if it exists and starts anew
/// otherwise, and it writes the file after the draws from the prior and after each stage. The file
/// stays after the end, so that the next call returns the result; call remove_checkpoint when the
/// result is in place. Before a run resumes, three samples of the file are evaluated again and must
/// have the same log-likelihoods, so that no result mixes two models.
/// \param observer  called after the file has been written
/// \param look  tmcmc::Problem::look
/// \throws io::InputError if the model gives other log-likelihoods, leaving the file untouched;
///         also as tmcmc::run, read_checkpoint and write_checkpoint; a path that cannot be written
///         is detected at the start.
[[nodiscard]] tmcmc::Result run_with_checkpoint(const std::filesystem::path& path, const RunDescription& run,
                                                const tmcmc::LogLikelihood& log_likelihood,
                                                const tmcmc::Observer& observer = {},
                                                const std::function<void()>& look = {});

}  // namespace storage
