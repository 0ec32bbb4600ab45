#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

namespace handway::test {

/// A move of a module.
struct RapidMove {
  std::array<double, 6> angles{};  ///< deg
  double duration = 0.0;           ///< s
};

/// A module as far as its moves are concerned, read by its text alone.
struct RapidModule {
  std::string name;
  std::string procedure;
  std::vector<std::string> faults;                      ///< A sentence each, with its line.
  std::map<std::string, std::array<double, 6>> points;  ///< deg
  std::vector<RapidMove> moves;
  double waited = 0.0;                ///< s
  std::vector<std::string> comments;  ///< Without "! ".
  std::vector<std::string> outputs;   ///< "do1 1"
};

/// Reads a module. The grammar is that of ABB's "RAPID kernel": MODULE … ENDMODULE with
/// declarations before procedures, PROC … ENDPROC, statements that end with ";", identifiers of at
/// most 32 characters, strings of at most 80.
[[nodiscard]] RapidModule read_rapid(const std::string& text);

}  // namespace handway::test
