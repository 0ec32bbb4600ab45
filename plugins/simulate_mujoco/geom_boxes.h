#pragma once

#include <mujoco/mujoco.h>

namespace handway::simulate_mujoco {

/// Boxes around geoms, for models with `nuser_geom='6'` (kSolver). MuJoCo compares two meshes,
/// which takes long, wherever their bounding spheres overlap; the spheres of long parts mostly do.

/// Sets the box of each geom, in its frame: the middle, then half the edges, m.
void set_geom_boxes(mjModel& model);

/// Makes MuJoCo leave out pairs of geoms whose boxes do not overlap, for the whole program. Models
/// without boxes have the pairs that they have without this.
void install_box_filter();

}  // namespace handway::simulate_mujoco
