#pragma once

#include <catch2/catch.hpp>
#include <fstream>
#include <string>

#include "io/csv.hpp"
#include "temporary_directory.hpp"

/// Files called x.csv in a fresh directory, and the messages of what refuses them.
class CsvFixture {
 protected:
  std::filesystem::path put(const std::string& content) {
    const std::filesystem::path path = directory.path() / "x.csv";
    std::ofstream(path, std::ios::binary) << content;
    return path;
  }
  io::CsvTable table(const std::string& content) { return io::CsvTable::read(put(content)); }

  // The message, with the path cut down to x.csv, of what the call throws.
  template <class Call>
  std::string message(Call call) {
    try {
      call();
    } catch (const io::InputError& error) {
      std::string text = error.what();
      const std::string prefix = directory.path().string() + "/";
      if (text.starts_with(prefix)) text.erase(0, prefix.size());
      CHECK(text.find('\n') == std::string::npos);
      return text;
    }
    return "no InputError";
  }
  std::string refusal(const std::string& content) {
    return message([&] { table(content); });
  }
  std::string number_refusal(const std::string& cell) {
    return message([&] { table("a,b\n1,2\n3," + cell + "\n").numbers("b"); });
  }

  TemporaryDirectory directory;
};
