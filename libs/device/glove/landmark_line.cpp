#include "handway/device/glove/landmark_line.h"

#include "glove/hand_json.h"
#include "handway/device/core/line_protocol.h"

#include <fmt/format.h>

#include <cstddef>

namespace handway::device {
namespace {

HandLandmarks read_landmarks(const HandJson& points) {
  HandLandmarks landmarks;
  if (!points.is_array() || points.size() != static_cast<std::size_t>(landmarks.cols())) {
    throw LineProtocolError(
        fmt::format("{} landmarks, expected {}", points.size(), landmarks.cols()));
  }
  for (Eigen::Index i = 0; i < landmarks.cols(); ++i) {
    landmarks.col(i) =
        point_of_json(points.at(static_cast<std::size_t>(i)), fmt::format("landmark {}", i));
  }
  check_hand(landmarks);
  return landmarks;
}

}  // namespace

HandObservation read_landmark_hand(const HandJson& object) {
  HandObservation hand;
  hand.time = time_of_hand(object);
  if (const auto side = object.find("hand"); side != object.end()) {
    hand.left = is_left_hand(*side);
  }
  const HandJson& points = member_of(object, "landmarks");
  if (!points.empty()) {  // null is empty
    hand.landmarks = read_landmarks(points);
    hand.raw.assign(hand.landmarks->data(), hand.landmarks->data() + hand.landmarks->size());
  }
  return hand;
}

LandmarkLine read_landmark_line(std::string_view text) {
  const HandObservation hand = read_landmark_hand(read_hand_json(text));
  return {hand.time, hand.left, hand.landmarks};
}

std::string write_landmark_line(const LandmarkLine& line) {
  HandJson object;
  if (line.time) {
    object["time"] = *line.time;
  }
  object["hand"] = line.left ? "left" : "right";
  HandJson& points = object["landmarks"] = HandJson::array();
  if (line.landmarks) {
    for (const auto& point : line.landmarks->colwise()) {
      points.push_back({point.x(), point.y(), point.z()});
    }
  }
  return object.dump();
}

}  // namespace handway::device
