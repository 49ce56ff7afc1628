/// \file
/// What stands in a file that is to be read as CSV.
#pragma once

#include <filesystem>
#include <string>

namespace io {

/// All bytes of the file or pipe, up to and with the first block that holds a NUL: the parser refuses that byte with its place,
/// and a source of zeros has no end.
/// \throws InputError naming the file, if it cannot be read, is a directory or has more than 4 GiB.
[[nodiscard]] std::string csv_bytes(const std::filesystem::path& path);

}  // namespace io
