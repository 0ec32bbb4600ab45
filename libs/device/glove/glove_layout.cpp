#include "handway/device/glove/glove_layout.h"

#include <algorithm>
#include <array>
#include <stdexcept>

namespace handway::device {
namespace {

constexpr std::array<GloveSensor, kGloveSensors> kSensors{{
    {"ThumbRotate", "Thumb roll", 'c', 0,
     "Roll of the thumb's base, positive towards the little finger"},
    {"ThumbMPJ", "Thumb inner", 'e', 1, "Knuckle of the thumb, positive bent"},
    {"ThumbIJ", "Thumb outer", 'f', 2, "Outer joint of the thumb, positive bent"},
    {"ThumbAbduct", "Thumb abduction", 'd', 3, "Thumb away from the index finger, positive spread"},
    {"IndexMPJ", "Index inner", 'g', 4, "Knuckle of the index finger, positive bent"},
    {"IndexPIJ", "Index middle", 'h', 5, "Middle joint of the index finger, positive bent"},
    {"IndexDIJ", "Index outer", 'i', 6, "Outer joint of the index finger, positive bent"},
    {"MiddleMPJ", "Middle inner", 'k', 8, "Knuckle of the middle finger, positive bent"},
    {"MiddlePIJ", "Middle middle", 'l', 9, "Middle joint of the middle finger, positive bent"},
    {"MiddleDIJ", "Middle outer", 'm', 10, "Outer joint of the middle finger, positive bent"},
    {"MiddleIndexAbduct", "Index abduction", 'j', 11,
     "Index away from the middle finger, positive spread"},
    {"RingMPJ", "Ring inner", 'o', 12, "Knuckle of the ring finger, positive bent"},
    {"RingPIJ", "Ring middle", 'p', 13, "Middle joint of the ring finger, positive bent"},
    {"RingDIJ", "Ring outer", 'q', 14, "Outer joint of the ring finger, positive bent"},
    {"RingMiddleAbduct", "Ring abduction", 'n', 15,
     "Ring away from the middle finger, positive spread"},
    {"PinkieMPJ", "Little inner", 's', 16, "Knuckle of the little finger, positive bent"},
    {"PinkiePIJ", "Little middle", 't', 17, "Middle joint of the little finger, positive bent"},
    {"PinkieDIJ", "Little outer", 'u', 18, "Outer joint of the little finger, positive bent"},
    {"PinkieRingAbduct", "Little abduction", 'r', 19,
     "Little away from the ring finger, positive spread"},
    {"PalmArch", "Palm arch", 'v', 20, "Arch of the palm at the little finger, positive hollow"},
    {"WristPitch", "Wrist flexion", 'b', 21, "Wrist towards the palm, positive bent"},
    {"WristYaw", "Wrist abduction", 'a', 22, "Wrist towards the little finger, positive"},
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
