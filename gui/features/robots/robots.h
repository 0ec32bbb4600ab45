#pragma once

namespace handway::gui {

class Workbench;

/// Adds the commands that add robots to the scene, mount, export and set them up.
void add_robots(Workbench& workbench);

}  // namespace handway::gui
