#include "build_info.hpp"

namespace experiments {

const std::string& version() {
  static const std::string text = COMPANION_VERSION;
  return text;
}

const std::string& source_directory() {
  static const std::string text = COMPANION_SOURCE_DIR;
  return text;
}

}  // namespace experiments
