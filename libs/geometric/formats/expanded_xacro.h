#pragma once

#include "handway/geometric/robot/robot_description.h"

#include <filesystem>

namespace handway::geometric {

/// The URDF that the program `xacro` makes of a file: a temporary file during the lifetime of this
/// object. Packages near the file are given to the program, for `$(find NAME)`.
class ExpandedXacro {
 public:
  /// @throws InputError if the file declares no such argument, if there is no such program, or
  /// with its output if it fails or takes longer than a minute.
  ExpandedXacro(const std::filesystem::path& xacro, const XacroArguments& arguments);
  ~ExpandedXacro();
  ExpandedXacro(const ExpandedXacro&) = delete;
  ExpandedXacro& operator=(const ExpandedXacro&) = delete;

  [[nodiscard]] std::filesystem::path file() const { return folder_ / "robot.urdf"; }

 private:
  std::filesystem::path folder_;
};

}  // namespace handway::geometric
