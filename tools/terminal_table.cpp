#include "terminal_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

namespace handway::tools {

void print_line(const std::string& line) {
  fmt::print("{}\n", line);
  std::fflush(stdout);
}

void print_table(const std::string& table, bool first) {
  if (!first) {
    fmt::print("\033[{}A", std::count(table.begin(), table.end(), '\n'));
  }
  std::string cleared;
  for (const char c : table) {
    cleared += c == '\n' ? std::string("\033[K\n") : std::string(1, c);
  }
  fmt::print("{}", cleared);
  std::fflush(stdout);
}

}  // namespace handway::tools
