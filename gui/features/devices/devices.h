#pragma once

namespace handway::gui {

class Workbench;

/// Adds the panel, and a STOP button to the window.
void add_devices(Workbench& workbench);

}  // namespace handway::gui
