/// \file
/// Reference tables of the tests: comma-separated numbers below one line of names.
#pragma once

#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "data/directories.hpp"
#include "friction/observations.hpp"

namespace test_data {

using Columns = std::map<std::string, std::vector<double>>;

inline Columns read_columns(const std::string& path) {
  std::ifstream file(path);
  std::string line;
  if (!std::getline(file, line)) {
    throw std::runtime_error(path + ": not found or empty");
  }
  std::vector<std::string> names;
  std::istringstream header(line);
  for (std::string name; std::getline(header, name, ',');) {
    names.push_back(name);
  }
  Columns columns;
  while (std::getline(file, line)) {
    std::istringstream row(line);
    for (const std::string& name : names) {
      std::string cell;
      if (!std::getline(row, cell, ',')) {
        throw std::runtime_error(path + ": a row is too short");
      }
      columns[name].push_back(std::stod(cell));
    }
  }
  return columns;
}

/// Table 1 as printed.
inline friction::Observations table1() {
  const Columns columns = read_columns(source_directory() + "/data/published/table1_observations.csv");
  return {columns.at("r_nominal"), columns.at("r_measured"), columns.at("driving_frequency_hz"),
          columns.at("phase_deg")};
}

}  // namespace test_data
