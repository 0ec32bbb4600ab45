#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/math/pose.h"
#include "handway/geometric/robot/robot_model.h"

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace handway::geometric {

/// Part of a composed robot, in which robots are mounted on each other: an arm, a hand, a tool, a
/// camera, a fixture.
struct RobotPart {
  std::string name;                         ///< Unique in the scene.
  std::filesystem::path file;               ///< Model file, see RobotInstance::file.
  std::shared_ptr<const RobotModel> model;  ///< Model of this part alone, with its own names.
  int carrier = -1;  ///< Index of the part that carries it, before its own; -1 for the first.
  std::string link;  ///< Link of the carrier, by the carrier's own name; empty for the first.
  Pose X_LB = Pose::Identity();  ///< Base (root link) of this part in that link.
  /// Names in the composed robot by own names; set by compose_robots().
  std::map<std::string, std::string> links = {};
  std::map<std::string, std::string> joints = {};
};

/// Names the links and joints of all parts, and makes one kinematic tree of them.
///
/// Names stay unless parts share them; then the first part keeps its own, and the others put theirs
/// after their part's: `hand/joint_1`. A part is fixed to the link that carries it by the joint
/// `PART_mount`.
///
/// The groups "arm" and "hand" are those of all parts together; for a part whose SRDF names
/// neither, those of propose_groups(). Each moving part is a group of its own name, too, unless
/// that group exists. Other groups, end effectors and postures keep their names as links do. A pair
/// of links may touch if it may in the part that has both; of different parts, only the links next
/// to the mount may.
///
/// @param parts @pre carriers are before what they carry.
/// @throws InputError if a carrier has no such link.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT RobotDescription
compose_robots(std::vector<RobotPart>& parts);

/// The variable of the joint of that name; else of the only joint with that name in its part:
/// "joint_1" is found as "hand/joint_1".
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::optional<int> find_variable_of_part(
    const RobotModel& model, std::string_view joint);

}  // namespace handway::geometric
