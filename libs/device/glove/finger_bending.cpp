#include "glove/finger_bending.h"

#include "handway/device/glove/glove_layout.h"

#include <cmath>
#include <cstddef>
#include <string_view>

namespace handway::device {

double bending(const HandLandmarks& points, bool left) {
  const GloveAngles angles = glove_angles(in_palm_frame(points, left));
  double sum = 0.0;
  for (std::size_t sensor = 0; sensor < angles.angles.size(); ++sensor) {
    const std::string_view name = cyberglove_sensors()[sensor].name;
    if (name.ends_with("PIJ") || name.ends_with("DIJ")) {
      sum += std::isfinite(angles.angles[sensor]) ? angles.angles[sensor] : 0.0;
    }
  }
  return sum;
}

}  // namespace handway::device
