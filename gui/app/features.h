#pragma once

namespace handway::gui {

class Workbench;

/// Adds all features to a window. Each is a folder below features/, and a line here.
void add_features(Workbench& workbench);

}  // namespace handway::gui
