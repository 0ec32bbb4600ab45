#include "handway/device/glove/landmark_line.h"

#include "handway/device/core/line_protocol.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>

namespace handway::device {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kShortestHand = 0.04;  // m from wrist to the farthest point
constexpr double kLongestHand = 0.5;

double finite(const Json& value, const std::string& name) {
  if (!value.is_number() || !std::isfinite(value.get<double>())) {
    throw LineProtocolError(name + " is no number");
  }
  return value.get<double>();
}

Eigen::Vector3d read_point(const Json& point, std::size_t index) {
  constexpr std::array kNames{"x", "y", "z"};
  if (point.size() != kNames.size() && !point.is_object()) {
    throw LineProtocolError(fmt::format("landmark {} is no point of x, y and z", index));
  }
  Eigen::Vector3d result;
  for (std::size_t axis = 0; axis < kNames.size(); ++axis) {
    const std::string name = fmt::format("{} of landmark {}", kNames.at(axis), index);
    if (point.is_object() && !point.contains(kNames.at(axis))) {
      throw LineProtocolError("no " + name);
    }
    result[static_cast<Eigen::Index>(axis)] =
        finite(point.is_object() ? point.at(kNames.at(axis)) : point.at(axis), name);
  }
  return result;
}

HandLandmarks read_points(const Json& points) {
  HandLandmarks landmarks;
  if (!points.is_array() || points.size() != static_cast<std::size_t>(landmarks.cols())) {
    throw LineProtocolError(
        fmt::format("{} landmarks, expected {}", points.size(), landmarks.cols()));
  }
  for (Eigen::Index i = 0; i < landmarks.cols(); ++i) {
    const auto index = static_cast<std::size_t>(i);
    landmarks.col(i) = read_point(points.at(index), index);
  }
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
  return landmarks;
}

bool read_left(const Json& hand) {
  for (const char* name : {"right", "Right", "left", "Left"}) {
    if (hand == name) {
      return name[0] == 'l' || name[0] == 'L';
    }
  }
  throw LineProtocolError("hand " +
                          quote(hand.dump(-1, ' ', true, Json::error_handler_t::replace)) +
                          ", expected \"right\" or \"left\"");
}

}  // namespace

LandmarkLine read_landmark_line(std::string_view text) {
  const Json object = Json::parse(text, nullptr, false);
  if (!object.is_object()) {
    throw LineProtocolError(quote(text) + " is no JSON object");
  }
  LandmarkLine line;
  if (const auto time = object.find("time"); time != object.end()) {
    line.time = finite(*time, "time");
  }
  if (const auto hand = object.find("hand"); hand != object.end()) {
    line.left = read_left(*hand);
  }
  const auto points = object.find("landmarks");
  if (points == object.end()) {
    throw LineProtocolError("no key \"landmarks\"");
  }
  if (!points->empty()) {  // null is empty
    line.landmarks = read_points(*points);
  }
  return line;
}

std::string write_landmark_line(const LandmarkLine& line) {
  Json object;
  if (line.time) {
    object["time"] = *line.time;
  }
  object["hand"] = line.left ? "left" : "right";
  Json& points = object["landmarks"] = Json::array();
  if (line.landmarks) {
    for (const auto& point : line.landmarks->colwise()) {
      points.push_back({point.x(), point.y(), point.z()});
    }
  }
  return object.dump();
}

}  // namespace handway::device
