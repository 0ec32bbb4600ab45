#pragma once

#include <handway_test/paths.h>

#include <filesystem>
#include <string>

namespace handway::test {

/// Scene files with a flat arm in a scratch folder: joints "shoulder" and "elbow"
/// about z with links of 0.3 m, a palm, and two fingers, "left" and "right", that
/// a PMD basis moves together; "tip" follows "left" half-way.
class SmallCell {
 public:
  SmallCell();

  /// Returns a scene with a motion from one side of a post to the other; there is a way around it.
  [[nodiscard]] std::filesystem::path post() const { return scene(kPost, "1.5"); }
  /// The post stands far from the straight motion.
  [[nodiscard]] std::filesystem::path post_aside() const { return scene(kPostAside, "1.5"); }
  /// A wall between start and goal: no way at all.
  [[nodiscard]] std::filesystem::path wall() const { return scene(kWall, "1.5"); }
  /// The goal is inside the wall.
  [[nodiscard]] std::filesystem::path goal_in_wall() const { return scene(kWall, "0.75"); }
  /// A scene file with a key that there is not, in line 5.
  [[nodiscard]] std::filesystem::path broken() const;

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_.path(); }

 private:
  static constexpr const char* kPost =
      "  - {name: post, box: {size: [0.04, 0.04, 0.4]}, pose: {xyz: [0.41, 0.38, 0]}}\n";
  static constexpr const char* kPostAside =
      "  - {name: post, box: {size: [0.04, 0.04, 0.4]}, pose: {xyz: [-0.9, -0.9, 0]}}\n";
  static constexpr const char* kWall =
      "  - {name: wall, box: {size: [1, 0.04, 1]}, "
      "pose: {xyz: [0.45, 0.42, 0], rpy_deg: [0, 0, 43]}}\n";

  std::filesystem::path scene(const std::string& objects, const std::string& goal) const;
  std::filesystem::path write(const std::string& name, const std::string& content) const;

  ScratchFolder folder_;
};

}  // namespace handway::test
