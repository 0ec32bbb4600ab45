#pragma once

#include "handway/planning/extensions/plugin.h"
#include "handway_test/paths.h"

#include <filesystem>
#include <string>

namespace handway::import_moveit {

/// A problem of a small arm on a table, in a folder of its own, in the layout of
/// MotionBenchMaker: `scene0001.yaml`, `request0001.yaml` and `robots/crane.urdf` with its SRDF.
///
/// The arm turns about z (`turn`), lifts about y (`lift`) and reaches out (`reach`); its gripper
/// opens (`grip`, coupled: `grip_2`). A pillar stands between start and goal.
class SmallProblem {
 public:
  SmallProblem();

  [[nodiscard]] std::filesystem::path scene() const { return folder_.path() / "scene0001.yaml"; }
  [[nodiscard]] std::filesystem::path request() const {
    return folder_.path() / "request0001.yaml";
  }
  [[nodiscard]] std::filesystem::path folder() const { return folder_.path(); }

  /// Replaces a text, which must be there once, in the scene or the request.
  void replace(const std::filesystem::path& file, const std::string& from,
               const std::string& to) const;

  [[nodiscard]] planning::SceneState read() const;
  /// Returns the message with which reading is refused.
  [[nodiscard]] std::string refusal() const;

 private:
  test::ScratchFolder folder_;
};

}  // namespace handway::import_moveit
