#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

namespace handway::test {

/// A PTP move of a program.
struct KrlMove {
  std::array<double, 6> angles{};  ///< deg
  int velocity = 0;                ///< %
  int acceleration = 0;            ///< %
  double pause = 0.0;              ///< s, of the waits up to the next move.
};

/// A program as far as its moves are concerned, read by the text of its two files alone.
struct KrlProgram {
  std::string name;
  std::vector<std::string> faults;                      ///< A sentence each, with its line.
  std::map<std::string, std::array<double, 6>> points;  ///< deg
  std::vector<KrlMove> moves;         ///< The first one goes to where the arm is, at any rates.
  std::vector<std::string> comments;  ///< Without "; ".
  std::vector<std::string> outputs;   ///< "1 TRUE"
};

/// Reads a program. The grammar is that of KUKA's KRL reference: one statement a line, DEF … END,
/// DEFDAT … ENDDAT, IF … ENDIF, FOR … ENDFOR, names of at most 24 characters, declarations before
/// instructions.
[[nodiscard]] KrlProgram read_krl(const std::string& source, const std::string& data);

}  // namespace handway::test
