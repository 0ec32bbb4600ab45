#pragma once

#include "features/glove/joint_coverage.h"
#include "handway/device/glove/hand_mapping.h"

#include <QStringList>

namespace handway::gui {

/// Returns instructions for the person that cover more of the hand's workspace, the most useful
/// first; none if all joints have been through most of their ranges.
/// @param mapping that the coverage was computed with.
/// @param most hints to give.
[[nodiscard]] QStringList capture_hints(const JointCoverage& coverage,
                                        const device::HandMapping& mapping, int most = 3);

}  // namespace handway::gui
