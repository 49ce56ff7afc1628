/// \file
/// Where the files of the tests are.
#pragma once

#include <string>

namespace test_data {

/// The folder of the project that the tests were built from.
const std::string& source_directory();

}  // namespace test_data
