#include "glove/manus_ergonomics.h"

#include "glove/hand_json.h"
#include "handway/device/core/line_protocol.h"
#include "handway/geometric/math/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>

namespace handway::device {
namespace {

constexpr std::size_t kAnglesOfFinger = 4;
constexpr double kWidestDegrees = 360.0;

/// Sensor of each angle that one sensor measures; empty: a spread, which is measured between
/// fingers.
constexpr std::array<const char*, kManusAngles> kSensors{"ThumbAbduct",
                                                         "ThumbRotate",
                                                         "ThumbMPJ",
                                                         "ThumbIJ",
                                                         "",
                                                         "IndexMPJ",
                                                         "IndexPIJ",
                                                         "IndexDIJ",
                                                         "",
                                                         "MiddleMPJ",
                                                         "MiddlePIJ",
                                                         "MiddleDIJ",
                                                         "",
                                                         "RingMPJ",
                                                         "RingPIJ",
                                                         "RingDIJ",
                                                         "",
                                                         "PinkieMPJ",
                                                         "PinkiePIJ",
                                                         "PinkieDIJ"};

std::size_t sensor_index(const char* name) { return static_cast<std::size_t>(*find_sensor(name)); }

/// Index of the spread of a finger from index (1) to little finger (4).
constexpr std::size_t spread_of_finger(std::size_t finger) { return kAnglesOfFinger * finger; }

/// Names of the SDK, as in "LeftFingerIndexMCPSpread", have MCP in the spread of the fingers.
std::optional<std::size_t> angle_named(std::string_view name) {
  const auto& names = manus_names();
  for (std::size_t i = 0; i < names.size(); ++i) {
    std::string longer = names.at(i);
    if (i >= kAnglesOfFinger && i % kAnglesOfFinger == 0) {
      longer.insert(longer.find("Spread"), "MCP");
    }
    if (name == names.at(i) || name == longer) {
      return i;
    }
  }
  return std::nullopt;
}

double checked_degrees(double value, const std::string& name) {
  if (!(std::abs(value) <= kWidestDegrees)) {
    throw LineProtocolError(fmt::format("{} of {:g}, expected degrees", name, value));
  }
  return value;
}

void take_angle(const std::string& name, const HandJson& value, ManusAngles& degrees) {
  if (const auto angle = angle_named(name)) {
    degrees.at(*angle) = checked_degrees(finite_number(value, name), name);
  }
}

ManusAngles read_ergonomics(const HandJson& ergonomics) {
  ManusAngles degrees;
  degrees.fill(std::numeric_limits<double>::quiet_NaN());
  if (ergonomics.is_object()) {
    for (const auto& [name, value] : ergonomics.items()) {
      take_angle(name, value, degrees);
    }
  } else if (ergonomics.is_array()) {
    for (const HandJson& one : ergonomics) {
      if (!one.is_object() || !member_of(one, "type").is_string()) {
        throw LineProtocolError("an element of ergonomics without type and value");
      }
      take_angle(one.at("type").get<std::string>(), member_of(one, "value"), degrees);
    }
  } else {
    throw LineProtocolError("ergonomics are neither a list nor an object");
  }
  const auto missing =
      std::ranges::find_if(degrees, [](double angle) { return std::isnan(angle); });
  if (missing != degrees.end()) {
    const auto index = static_cast<std::size_t>(missing - degrees.begin());
    throw LineProtocolError(fmt::format("no {} in ergonomics", manus_names().at(index)));
  }
  return degrees;
}

/// Gloves that are not there are sent as zeros.
HandObservation hand_of_degrees(const ManusAngles& degrees, bool left) {
  HandObservation hand;
  hand.left = left;
  if (std::ranges::any_of(degrees, [](double angle) { return angle != 0.0; })) {
    hand.angles = glove_angles_of_manus(degrees);
    hand.raw.assign(degrees.begin(), degrees.end());
  }
  return hand;
}

}  // namespace

const std::array<std::string, kManusAngles>& manus_names() {
  static const std::array<std::string, kManusAngles> kNames = [] {
    std::array<std::string, kManusAngles> names;
    std::size_t i = 0;
    for (const char* finger : {"Thumb", "Index", "Middle", "Ring", "Pinky"}) {
      names.at(i) = fmt::format("{}{}", finger, i == 0 ? "MCPSpread" : "Spread");
      names.at(i + 1) = fmt::format("{}MCPStretch", finger);
      names.at(i + 2) = fmt::format("{}PIPStretch", finger);
      names.at(i + 3) = fmt::format("{}DIPStretch", finger);
      i += kAnglesOfFinger;
    }
    return names;
  }();
  return kNames;
}

std::array<double, kGloveSensors> glove_angles_of_manus(const ManusAngles& degrees) {
  std::array<double, kGloveSensors> angles{};
  angles.fill(std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < kSensors.size(); ++i) {
    if (*kSensors.at(i) != '\0') {
      angles.at(sensor_index(kSensors.at(i))) = degrees.at(i) * geometric::kDegree;
    }
  }
  const auto between = [&](std::size_t finger) {
    return (degrees.at(spread_of_finger(finger)) - degrees.at(spread_of_finger(finger + 1))) *
           geometric::kDegree;
  };
  angles.at(sensor_index("MiddleIndexAbduct")) = between(1);
  angles.at(sensor_index("RingMiddleAbduct")) = between(2);
  angles.at(sensor_index("PinkieRingAbduct")) = between(3);
  return angles;
}

ManusAngles manus_angles_of_glove(const std::array<double, kGloveSensors>& angles) {
  ManusAngles degrees{};
  const auto angle = [&](const char* sensor) {
    const double value = angles.at(sensor_index(sensor));
    return std::isfinite(value) ? value / geometric::kDegree : 0.0;
  };
  for (std::size_t i = 0; i < kSensors.size(); ++i) {
    if (*kSensors.at(i) != '\0') {
      degrees.at(i) = angle(kSensors.at(i));
    }
  }
  degrees.at(spread_of_finger(1)) = angle("MiddleIndexAbduct");
  degrees.at(spread_of_finger(3)) = -angle("RingMiddleAbduct");
  degrees.at(spread_of_finger(4)) = degrees.at(spread_of_finger(3)) - angle("PinkieRingAbduct");
  return degrees;
}

HandObservation read_manus_hand(const HandJson& message) {
  const HandJson& glove = message.contains("msg") ? message.at("msg") : message;
  if (!glove.is_object()) {
    throw LineProtocolError("msg is no message of a Manus glove");
  }
  const ManusAngles degrees = read_ergonomics(member_of(glove, "ergonomics"));
  HandObservation hand = hand_of_degrees(
      degrees, is_left_hand(glove.contains("side") ? glove.at("side") : member_of(glove, "hand")));
  hand.time = time_of_hand(glove);
  return hand;
}

std::vector<HandObservation> read_manus_numbers(std::string_view text) {
  constexpr std::size_t kNumbers = 2 * std::size_t{kManusAngles};
  std::vector<double> numbers;
  while (numbers.size() <= kNumbers) {
    const std::size_t end = std::min(text.find(','), text.size());
    std::string_view word = text.substr(0, end);
    while (word.starts_with(' ')) {
      word.remove_prefix(1);
    }
    numbers.push_back(
        checked_degrees(number_of(word), fmt::format("angle {}", numbers.size() + 1)));
    if (end == text.size()) {
      break;
    }
    text.remove_prefix(end + 1);
  }
  if (numbers.size() != kNumbers) {
    throw LineProtocolError(
        fmt::format("{} numbers, expected {}: 20 angles of the left and 20 of the right hand",
                    numbers.size() > kNumbers ? "more" : std::to_string(numbers.size()), kNumbers));
  }
  std::vector<HandObservation> hands;
  for (const bool left : {false, true}) {
    ManusAngles degrees;
    std::copy_n(numbers.begin() + (left ? 0 : kManusAngles), kManusAngles, degrees.begin());
    hands.push_back(hand_of_degrees(degrees, left));
  }
  return hands;
}

}  // namespace handway::device
