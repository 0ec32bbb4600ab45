/// Hand landmarks as lines of JSON.
#include "handway/device/core/line_protocol.h"
#include "handway/device/glove/human_hand.h"
#include "handway/device/glove/landmark_line.h"
#include "pieces.h"

#include <cmath>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace handway;
  device::LineBuffer lines;
  try {
    lines.add({data, size});
    while (const auto text = lines.next()) {
      try {
        const device::LandmarkLine line = device::read_landmark_line(*text);
        fuzz::require(!line.time || std::isfinite(*line.time));
        fuzz::require(device::read_landmark_line(write_landmark_line(line)).left == line.left);
        if (line.landmarks) {
          const device::GloveAngles angles =
              device::glove_angles(device::in_palm_frame(*line.landmarks, line.left));
          for (const int sensor : device::landmark_sensors()) {
            fuzz::require(std::isfinite(angles.angles.at(static_cast<std::size_t>(sensor))));
          }
        }
      } catch (const device::LineProtocolError&) {
      }
    }
  } catch (const device::LineProtocolError&) {
  }
  return 0;
}
