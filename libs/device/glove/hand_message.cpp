#include "handway/device/glove/hand_message.h"

#include "glove/hand_json.h"
#include "glove/manus_ergonomics.h"
#include "glove/openxr_joints.h"
#include "glove/rokoko_frame.h"

#include <fmt/format.h>

#include <array>
#include <cstddef>

namespace handway::device {
namespace {

HandMessage message_of_json(const HandJson& object) {
  if (object.contains("joints")) {
    return {HandWire::kOpenXr, {read_openxr_hand(object)}};
  }
  if (object.contains("scene") || object.contains("actors")) {
    return {HandWire::kRokoko, read_rokoko_hands(object)};
  }
  if (object.contains("ergonomics") || object.contains("msg")) {
    return {HandWire::kManus, {read_manus_hand(object)}};
  }
  return {HandWire::kLandmarks, {read_landmark_hand(object)}};
}

bool begins_as_number(std::string_view text) {
  return !text.empty() && (text.front() == '-' || (text.front() >= '0' && text.front() <= '9'));
}

}  // namespace

const std::string& name_of(HandWire wire) {
  static const std::array<std::string, 5> kNames{"hand landmarks", "OpenXR hand joints",
                                                 "Rokoko Studio", "Rokoko Studio, LZ4",
                                                 "Manus ergonomics"};
  return kNames.at(static_cast<std::size_t>(wire));
}

namespace {

/// Adds a pose's position (m) and quaternion.
void add_pose(const std::string& name, RawColumns& columns) {
  for (const char* part : {".x", ".y", ".z"}) {
    columns.add(name + part, "m");
  }
  for (const char* part : {".qx", ".qy", ".qz", ".qw"}) {
    columns.add(name + part, "");
  }
}

}  // namespace

RawColumns raw_columns_of(HandWire wire, bool left) {
  RawColumns columns;
  switch (wire) {
    case HandWire::kLandmarks:
      for (Eigen::Index i = 0; i < HandLandmarks::ColsAtCompileTime; ++i) {
        for (const char* part : {".x", ".y", ".z"}) {
          columns.add(fmt::format("landmark_{}{}", i, part), "m");
        }
      }
      break;
    case HandWire::kOpenXr:
      for (const std::string& joint : openxr_names()) {
        add_pose(joint, columns);
      }
      break;
    case HandWire::kRokoko:
    case HandWire::kRokokoLz4:
      for (const std::string& bone : rokoko_bones()) {
        add_pose((left ? "left" : "right") + bone, columns);
      }
      break;
    case HandWire::kManus:
      for (const std::string& angle : manus_names()) {
        columns.add(angle, "deg");
      }
      break;
  }
  return columns;
}

HandMessage read_hand_message(std::string_view message) {
  if (is_lz4_frame(message)) {
    HandMessage read = message_of_json(read_hand_json(decompressed_lz4_frame(message)));
    read.wire = read.wire == HandWire::kRokoko ? HandWire::kRokokoLz4 : read.wire;
    return read;
  }
  if (begins_as_number(message)) {
    return {HandWire::kManus, read_manus_numbers(message)};
  }
  return message_of_json(read_hand_json(message));
}

}  // namespace handway::device
