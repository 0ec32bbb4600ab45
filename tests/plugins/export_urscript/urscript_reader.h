#pragma once

#include <array>
#include <string>
#include <vector>

namespace handway::test {

/// A move of a program.
struct UrMove {
  std::array<double, 6> q{};  ///< rad
  double acceleration = 0.0;  ///< rad/s², of movej.
  double velocity = 0.0;      ///< rad/s, of movej.
  double duration = 0.0;      ///< s
};

/// A program as far as its moves are concerned, read by its text alone.
struct UrProgram {
  std::string name;
  std::vector<std::string> faults;    ///< A sentence each, with its line.
  std::vector<UrMove> moves;          ///< movej and servoj.
  double slept = 0.0;                 ///< s
  std::vector<std::string> comments;  ///< Without "# ".
  std::vector<std::string> outputs;   ///< "1 True"
};

/// Reads a program. The grammar is that of "The URScript Programming Language": one statement a
/// line, blocks from `def`, `if` or `while` with a colon to `end`, calls with positional arguments
/// before named ones, lists of numbers in square brackets.
[[nodiscard]] UrProgram read_urscript(const std::string& text);

}  // namespace handway::test
