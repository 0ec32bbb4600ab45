#include "handway/device/glove/glove_layout.h"

#include <algorithm>
#include <array>
#include <stdexcept>

namespace handway::device {
namespace {

constexpr std::array<GloveSensor, kGloveSensors> kSensors{{
    {"ThumbRotate", "Thumb roll", 'c', 0},
    {"ThumbMPJ", "Thumb inner", 'e', 1},
    {"ThumbIJ", "Thumb outer", 'f', 2},
    {"ThumbAbduct", "Thumb abduction", 'd', 3},
    {"IndexMPJ", "Index inner", 'g', 4},
    {"IndexPIJ", "Index middle", 'h', 5},
    {"IndexDIJ", "Index outer", 'i', 6},
    {"MiddleMPJ", "Middle inner", 'k', 8},
    {"MiddlePIJ", "Middle middle", 'l', 9},
    {"MiddleDIJ", "Middle outer", 'm', 10},
    {"MiddleIndexAbduct", "Index abduction", 'j', 11},
    {"RingMPJ", "Ring inner", 'o', 12},
    {"RingPIJ", "Ring middle", 'p', 13},
    {"RingDIJ", "Ring outer", 'q', 14},
    {"RingMiddleAbduct", "Ring abduction", 'n', 15},
    {"PinkieMPJ", "Little inner", 's', 16},
    {"PinkiePIJ", "Little middle", 't', 17},
    {"PinkieDIJ", "Little outer", 'u', 18},
    {"PinkieRingAbduct", "Little abduction", 'r', 19},
    {"PalmArch", "Palm arch", 'v', 20},
    {"WristPitch", "Wrist flexion", 'b', 21},
    {"WristYaw", "Wrist abduction", 'a', 22},
}};

constexpr std::array<int, 22> kAll{0,  1,  2,  3,  4,  5,  6,  7,  8,  9,  10,
                                   11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21};
constexpr std::array<int, 18> kWithoutDistal{0,  1,  2,  3,  4,  5,  7,  8,  10,
                                             11, 12, 14, 15, 16, 18, 19, 20, 21};

}  // namespace

std::span<const GloveSensor> cyberglove_sensors() { return kSensors; }

std::span<const int> cyberglove_wired(int sensors) {
  switch (sensors) {
    case 18:
      return kWithoutDistal;
    case 22:
      return kAll;
    default:
      throw std::invalid_argument("a CyberGlove has 18 or 22 sensors");
  }
}

std::optional<int> find_sensor(std::string_view name) {
  const auto found = std::ranges::find_if(kSensors, [&](const GloveSensor& sensor) {
    return sensor.name == name || (name.size() == 1 && sensor.letter == name.front());
  });
  if (found == kSensors.end()) {
    return std::nullopt;
  }
  return static_cast<int>(found - kSensors.begin());
}

}  // namespace handway::device
