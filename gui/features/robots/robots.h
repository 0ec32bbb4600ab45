#pragma once

namespace handway::gui {

class Workbench;

/// Adds the commands that add robots to the scene, mount, export and set them up.
void add_robots(Workbench& workbench);

/// Asks for a robot's file and opens it as a scene of its own.
void open_robot_file(Workbench& workbench);

}  // namespace handway::gui
