#pragma once

#include "handway/planning/core/planning_problem.h"
#include "handway/planning/edits/scene_state.h"
#include "handway/planning/export.h"
#include "handway/planning/grasps/pregrasp_search.h"

#include <filesystem>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

/// Grasps that were found elsewhere, measured like those of Handway's search.

namespace handway::planning {

/// A grasp from elsewhere: a file, another program, a person.
struct GivenGrasp {
  std::string source;                                  ///< For messages, as "grasps.json:12".
  geometric::Pose X_OP = geometric::Pose::Identity();  ///< Pose of the palm in the object's frame.
  Configuration q;  ///< Its joints of the hand are used alone: in contact or near it.
  /// The hand before it closes, likewise; nothing: the fingers of `q` open as far as they must.
  std::optional<Configuration> open = {};
};

/// Reads grasps of an object from a YAML or JSON file: a grasp file of Handway's
/// (grasp_file_text()), or a list of grasps, each with a pose and the joints of the hand:
///
///     link: "hand_base"   # that the poses are of; the palm if absent
///     grasps:
///       - pose: [x, y, z, qx, qy, qz, qw]   # m, in the object's frame; or rows of a 4×4 matrix
///         joints: {"joint_1": 0.31, …}      # rad or m
///         pregrasp: {"joint_1": 0.2, …}     # of the open hand; may be absent
///
/// Joints that are not given are those of the start; joints of the arm are not used. A coupled
/// joint gives the joint that it follows. Unknown names are those of another arm if all joints of
/// the hand are given.
/// @throws InputError naming the line if the file can't be read, has unknown joints instead of
/// those of the hand, values in another unit, or no grasps; and as find_pregrasps() for the object.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::vector<GivenGrasp> read_given_grasps(
    const std::filesystem::path& file, const PlanningProblem& problem, std::string_view object);

/// Given grasps that are possible, and why the others are not.
struct MeasuredGrasps {
  Pregrasps grasps;                   ///< In their order, each with its source.
  std::vector<std::string> left_out;  ///< A sentence for each that is not possible.
};

/// Measures given grasps as find_pregrasps() measures those that it finds. The arm gets the posture
/// nearest to the start that is free. The fingers close up to contact from where they are given;
/// those that are in the object open as far as they must. In the pre-grasp they are
/// PregraspOptions::gap or more from it. Any number of threads gives the same bits.
/// @param object that the grasps are of. @param stop ends within 100 ms, with those that are
/// measured.
/// @throws InputError as find_pregrasps().
[[nodiscard]] HANDWAY_PLANNING_EXPORT MeasuredGrasps measure_given_grasps(
    const PlanningProblem& problem, std::string_view object, const std::vector<GivenGrasp>& given,
    const PregraspOptions& options = {}, const std::stop_token& stop = {});

/// Measures the grasps of a file, as measure_given_grasps().
/// @throws InputError as read_given_grasps().
[[nodiscard]] HANDWAY_PLANNING_EXPORT MeasuredGrasps measure_grasps_of_file(
    const std::filesystem::path& file, const PlanningProblem& problem, std::string_view object,
    const PregraspOptions& options = {}, const std::stop_token& stop = {});

/// Returns a found grasp as one that is given, to be measured again where its object has moved.
/// @param palm link, from Pregrasps::palm. @param source for messages.
/// @pre the scene has the object.
[[nodiscard]] HANDWAY_PLANNING_EXPORT GivenGrasp as_given(const PlanningProblem& problem,
                                                          std::string_view object,
                                                          const Pregrasp& grasp, int palm,
                                                          const std::string& source = {});

/// Makes a file of grasps that of an object: tasks pick the object with these first.
/// @throws InputError as read_given_grasps() and make_problem().
[[nodiscard]] HANDWAY_PLANNING_EXPORT SceneState with_grasps(const SceneState& state,
                                                             std::string_view object,
                                                             const std::filesystem::path& file);

}  // namespace handway::planning
