#pragma once

#include <filesystem>

namespace handway::geometric {

/// The URDF that the program `xacro` makes of a file, without arguments: a file of its own for as
/// long as this is there.
class ExpandedXacro {
 public:
  /// @throws InputError if there is no such program, or with what it says if it fails or takes
  /// longer than a minute.
  explicit ExpandedXacro(const std::filesystem::path& xacro);
  ~ExpandedXacro();
  ExpandedXacro(const ExpandedXacro&) = delete;
  ExpandedXacro& operator=(const ExpandedXacro&) = delete;

  [[nodiscard]] std::filesystem::path file() const { return folder_ / "robot.urdf"; }

 private:
  std::filesystem::path folder_;
};

}  // namespace handway::geometric
