#include "directories.hpp"

namespace test_data {

const std::string& source_directory() {
  static const std::string directory = SOURCE_DIRECTORY;
  return directory;
}

}  // namespace test_data
