#include "command_line/build_info.hpp"

#include <filesystem>
#include <system_error>

namespace command_line {

const std::string& version() {
  static const std::string text = COMPANION_VERSION;
  return text;
}

const std::string& source_directory() {
  static const std::string text = COMPANION_SOURCE_DIR;
  return text;
}

std::string data_file(const std::string& directory, const std::string& file) {
  const std::filesystem::path here = std::filesystem::path("data") / directory / file;
  std::error_code ignored;
  return std::filesystem::exists(here, ignored) ? here.string()
                                                : (std::filesystem::path(source_directory()) / here).string();
}

}  // namespace command_line
