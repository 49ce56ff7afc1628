/// \file
/// What the build knows of itself, and the data that come with it.
#pragma once

#include <string>

namespace command_line {

/// The version of the project, such as "1.0.0".
[[nodiscard]] const std::string& version();

/// The folder that the executables were built from.
[[nodiscard]] const std::string& source_directory();

/// Path of a file in data/DIRECTORY of the current directory, or else of the source tree.
[[nodiscard]] std::string data_file(const std::string& directory, const std::string& file);

}  // namespace command_line
