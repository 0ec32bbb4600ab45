#include "glove/hand_json.h"

#include "handway/device/core/line_protocol.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>

namespace handway::device {
namespace {

constexpr double kShortestHand = 0.04;  // m from wrist to the farthest point
constexpr double kLongestHand = 0.5;

constexpr std::array kCoordinates{"x", "y", "z", "w"};

/// Reads `Count` coordinates of an array or by their names.
template <int Count>
Eigen::Matrix<double, Count, 1> coordinates(const HandJson& value, const std::string& name,
                                            const char* what) {
  constexpr auto kSize = static_cast<std::size_t>(Count);
  if (!value.is_object() && (!value.is_array() || value.size() != kSize)) {
    throw LineProtocolError(fmt::format("{} is no {}", name, what));
  }
  Eigen::Matrix<double, Count, 1> result;
  for (std::size_t axis = 0; axis < kSize; ++axis) {
    const std::string element = fmt::format("{} of {}", kCoordinates.at(axis), name);
    if (value.is_object() && !value.contains(kCoordinates.at(axis))) {
      throw LineProtocolError("no " + element);
    }
    result[static_cast<Eigen::Index>(axis)] = finite_number(
        value.is_object() ? value.at(kCoordinates.at(axis)) : value.at(axis), element);
  }
  return result;
}

}  // namespace

HandJson read_hand_json(std::string_view text) {
  HandJson object = HandJson::parse(text, nullptr, false);
  if (!object.is_object()) {
    throw LineProtocolError(quote(text) + " is no JSON object");
  }
  return object;
}

const HandJson& member_of(const HandJson& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end()) {
    throw LineProtocolError(fmt::format("no key \"{}\"", key));
  }
  return *found;
}

std::optional<double> time_of_hand(const HandJson& object) {
  const auto time = object.find("time");
  return time == object.end() ? std::nullopt : std::optional(finite_number(*time, "time"));
}

double finite_number(const HandJson& value, const std::string& name) {
  if (!value.is_number() || !std::isfinite(value.get<double>())) {
    throw LineProtocolError(name + " is no number");
  }
  return value.get<double>();
}

Eigen::Vector3d point_of_json(const HandJson& point, const std::string& name) {
  return coordinates<3>(point, name, "point of x, y and z");
}

Eigen::Vector4d quaternion_of_json(const HandJson& rotation, const std::string& name) {
  return coordinates<4>(rotation, name, "quaternion of x, y, z and w");
}

Eigen::Quaterniond rotation_of(const Eigen::Vector4d& xyzw, const std::string& name) {
  constexpr double kTolerance = 0.01;
  if (!(std::abs(xyzw.norm() - 1.0) <= kTolerance)) {
    throw LineProtocolError(
        fmt::format("{} has a quaternion of length {:.3g}, expected 1", name, xyzw.norm()));
  }
  return Eigen::Quaterniond(xyzw).normalized();
}

bool is_left_hand(const HandJson& hand) {
  for (const char* name : {"right", "Right", "left", "Left"}) {
    if (hand == name) {
      return name[0] == 'l' || name[0] == 'L';
    }
  }
  throw LineProtocolError("hand " +
                          quote(hand.dump(-1, ' ', true, HandJson::error_handler_t::replace)) +
                          ", expected \"right\" or \"left\"");
}

void check_hand(const HandLandmarks& landmarks) {
  const double reach =
      (landmarks.colwise() - landmarks.col(kWristLandmark).eval()).colwise().norm().maxCoeff();
  if (!(reach >= kShortestHand && reach <= kLongestHand)) {
    throw LineProtocolError(fmt::format("a hand of {:.3g} m, expected metres: {} to {} m", reach,
                                        kShortestHand, kLongestHand));
  }
  try {
    static_cast<void>(palm_frame(landmarks));
  } catch (const std::invalid_argument& error) {
    throw LineProtocolError(error.what());
  }
}

}  // namespace handway::device
