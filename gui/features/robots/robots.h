#pragma once

namespace handway::gui {

class Workbench;

/// Adds the commands that add robots to the scene, mount, export and set them up, and that open a
/// robot's file as a scene of its own: `open_robot`.
void add_robots(Workbench& workbench);

}  // namespace handway::gui
