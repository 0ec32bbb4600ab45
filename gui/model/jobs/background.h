#pragma once

#include <functional>

namespace handway::gui {

/// Has a thread of the global pool do something whose end nobody waits for.
void run_in_background(std::function<void()> work);

}  // namespace handway::gui
