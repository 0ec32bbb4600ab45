#include "handway/device/glove/hand_message.h"

#include "glove/hand_json.h"

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
