#pragma once

#include "handway_test/paths.h"

#include <filesystem>
#include <string>

namespace handway::test {

/// A small problem in a folder of its own, to load as it is or to break: two arm
/// joints (Turn, Lift), a fixed Palm, a thumb, and a finger whose last joint
/// follows the one before; controls Turn, Lift, Thumb, Close, Spread; one cube
/// of 20 mm for every link and, at scale 5, for the obstacle.
class SmallProblem {
 public:
  SmallProblem();

  [[nodiscard]] std::filesystem::path folder() const { return scratch_.path(); }
  [[nodiscard]] std::filesystem::path problem() const { return folder() / "problem.xml"; }
  [[nodiscard]] std::filesystem::path robot() const { return folder() / "robots" / "small.rob"; }
  [[nodiscard]] std::filesystem::path cube() const { return folder() / "robots" / "cube.iv"; }

  /// Replaces the first `from` in the file. @throws std::logic_error if there is none.
  static void edit(const std::filesystem::path& file, const std::string& from,
                   const std::string& to);

 private:
  ScratchFolder scratch_;
};

void write_text(const std::filesystem::path& file, const std::string& text);

}  // namespace handway::test
