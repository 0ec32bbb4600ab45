#pragma once

#include "handway/device/recordings/recorded_table.h"
#include "handway/planning/tasks/object_choice.h"
#include "handway/planning/tasks/timed_task.h"
#include "task_request.h"

#include <cstdint>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

namespace handway::tools {

/// Differences of the scenes of a data set from the given one.
struct SceneVariation {
  double spread = 0.15;  ///< m: distance up to which an object is moved from its place.
  /// Objects of which each motion uses one in place of the picked object; empty: always that one.
  std::vector<planning::ObjectChoice> objects = {};
};

/// Describes the variation for the command line, but the objects.
[[nodiscard]] std::vector<geometric::BoundParameter> parameters_of(SceneVariation& variation);

/// Returns the scene with each of some objects at a random place on what it stands on, turned
/// anyhow about the vertical, and clear of other objects. An object without such a place stays.
/// Same arguments, same scene.
/// @param objects names; those that the scene lacks or that are attached stay.
[[nodiscard]] planning::SceneState with_random_places(const planning::SceneState& state,
                                                      const std::vector<std::string>& objects,
                                                      const SceneVariation& variation,
                                                      std::uint64_t seed);

/// A motion of a data set, or the reason why there is none.
struct Episode {
  std::uint64_t seed = 0;
  planning::Task task;                         ///< With the drawn object.
  std::optional<planning::DrawnObject> drawn;  ///< If SceneVariation has objects.
  planning::SceneState state;
  planning::TaskPlan plan;
  planning::TimedTask timed;
  std::string reason;  ///< Why there is no motion, a sentence; empty if there is one.
};

/// Plans and times a task in a varied scene. Same arguments, same episode.
/// @param loaded task, whose scene is varied. @param request its planner and options.
[[nodiscard]] Episode make_episode(const LoadedTask& loaded, const TaskRequest& request,
                                   const planning::PluginManager& plugins,
                                   const planning::TimingOptions& timing,
                                   const SceneVariation& variation, std::uint64_t seed,
                                   const std::stop_token& stop);

/// Returns the object of the scene that an episode with a drawn object picks.
/// @pre an object was drawn.
[[nodiscard]] const geometric::SceneObject& drawn_object(const Episode& episode);

/// Returns the rows of an episode's motion: the joints (rad or m), for "palm" and each picked
/// object its pose in the world (`NAME.x`, `.y`, `.z` in m, and `.qx`, `.qy`, `.qz`, `.qw`), and
/// `stage`, the index of the stage. A drawn object has the name "object", its index among the
/// choices in `object.choice`, and the edges of the box around it in `object.size_x`, `_y`, `_z`.
/// @pre the episode has a motion.
[[nodiscard]] device::RecordedTable table_of(const Episode& episode);

}  // namespace handway::tools
