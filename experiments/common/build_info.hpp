/// \file
/// What the build knows of itself. Only one source is compiled with it, so that a compiler cache can serve other copies of the tree.
#pragma once

#include <string>

namespace experiments {

/// The version of the project, such as "1.0.0".
[[nodiscard]] const std::string& version();

/// The folder that the executables were built from, where the published data are.
[[nodiscard]] const std::string& source_directory();

}  // namespace experiments
