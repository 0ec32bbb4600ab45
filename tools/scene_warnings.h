#pragma once

#include "handway/geometric/scene/scene.h"

namespace handway::tools {

/// What readers noticed but could live with, as one summary on stderr; nothing if there is nothing.
void print_warnings(const geometric::Scene& scene);

}  // namespace handway::tools
