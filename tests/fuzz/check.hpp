#pragma once

#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

/// Ends the fuzzer, which keeps the input that broke the rule.
inline void require(bool condition, std::string_view rule, std::string_view found) {
  if (condition) return;
  std::fprintf(stderr, "broken: %s\nfound: %s\n", std::string(rule).c_str(), std::string(found).c_str());
  std::abort();
}

/// One line, without control characters and not endless.
inline void require_one_line(std::string_view message) {
  require(!message.empty() && message.size() < 10000, "a message has a length that can be read", message);
  for (const char c : message) {
    require(static_cast<unsigned char>(c) >= 0x20U && c != 0x7F,
            "a message is one line of printable characters", message);
  }
}
