#pragma once

#include "model/document/scene_edits.h"

#include <Eigen/Core>

namespace handway::gui {

/// Where the middle of the underside of a box along the world's axes may stand (world, m) so that
/// nothing is in it: no object, no robot as it is shown, and not the first one at start or goal.
/// The nearest such place beside `wanted`, at its height where something is below it there, or else
/// as low as it falls, at whole 5 mm along x and y. It keeps kRestingGap to what it stands on and
/// some millimetres to the rest.
/// @param size of the box, m.
[[nodiscard]] Eigen::Vector3d free_foot(const geometric::Scene& scene,
                                        const geometric::Configuration& q,
                                        const Eigen::Vector3d& size, const Eigen::Vector3d& wanted);

/// How to move objects that are to be added so that they are in free space as a whole, as
/// free_foot() has it; where they float they stay at their height.
/// @param added a scene with them, which may be `scene` itself: then it is beside where they are.
/// @param names at least one object of `added`.
[[nodiscard]] geometric::Pose motion_into_free(const geometric::Scene& scene,
                                               const geometric::Configuration& q,
                                               const geometric::Scene& added,
                                               const ObjectNames& names);

}  // namespace handway::gui
