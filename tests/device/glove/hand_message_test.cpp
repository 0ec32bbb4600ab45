#include "handway/device/glove/hand_message.h"

#include "handway/device/core/line_protocol.h"
#include "handway/device/emulators/landmark_unit.h"
#include "handway/device/glove/human_hand.h"
#include "handway/geometric/math/units.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <string>
#include <vector>

namespace handway::device {
namespace {

using Json = nlohmann::ordered_json;
using testing::HasSubstr;

std::size_t sensor(const char* name) { return static_cast<std::size_t>(*find_sensor(name)); }

/// Angles that the ergonomics of Manus can express: the middle finger is not spread.
GloveAngles bent_hand() {
  GloveAngles angles;
  angles.angles.fill(0.0);
  angles.angles.at(sensor("ThumbRotate")) = 0.5;
  angles.angles.at(sensor("ThumbAbduct")) = 0.4;
  angles.angles.at(sensor("ThumbIJ")) = 0.2;
  angles.angles.at(sensor("IndexPIJ")) = 0.7;
  angles.angles.at(sensor("PinkieDIJ")) = 0.3;
  angles.angles.at(sensor("MiddleIndexAbduct")) = 0.10;
  angles.angles.at(sensor("RingMiddleAbduct")) = 0.05;
  angles.angles.at(sensor("PinkieRingAbduct")) = 0.15;
  return angles;
}

/// The first message of an emulated sender.
std::string message_of(HandWire wire, bool left = false, bool plugged = true) {
  LandmarkUnitSettings settings;
  settings.wire = wire;
  settings.left = left;
  const auto unit = make_landmark_unit(settings, [](double) { return bent_hand(); });
  unit->set_plugged(plugged);
  const auto messages = unit->advance(0.0);
  std::string text(messages.at(0).begin(), messages.at(0).end());
  if (wire != HandWire::kRokokoLz4) {
    text.pop_back();  // the end of the line
  }
  return text;
}

/// The hand of that side in a message; fails if there is none.
HandObservation hand_of(const HandMessage& message, bool left) {
  for (const HandObservation& hand : message.hands) {
    if (hand.left == left) {
      return hand;
    }
  }
  ADD_FAILURE() << "no such hand";
  return {};
}

GloveAngles measured(const HandObservation& hand) {
  return hand.landmarks ? glove_angles(in_palm_frame(*hand.landmarks, hand.left))
                        : GloveAngles{0.0, *hand.angles};
}

std::string refusal_of_message(const std::string& text) {
  try {
    static_cast<void>(read_hand_message(text));
  } catch (const LineProtocolError& error) {
    return error.what();
  }
  return "";
}

class EveryWire : public testing::TestWithParam<HandWire> {};

TEST_P(EveryWire, GivesTheAnglesOfTheHand) {
  for (const bool left : {false, true}) {
    const HandMessage message = read_hand_message(message_of(GetParam(), left));
    EXPECT_EQ(message.wire, GetParam());
    const HandObservation hand = hand_of(message, left);
    ASSERT_TRUE(hand.is_seen());
    EXPECT_EQ(hand.time, 0.0);
    const GloveAngles angles = measured(hand);
    for (const int index : landmark_sensors()) {
      const auto which = static_cast<std::size_t>(index);
      EXPECT_NEAR(angles.angles.at(which), bent_hand().angles.at(which), 1e-7)
          << name_of(GetParam()) << " " << cyberglove_sensors()[which].name;
    }
  }
}

TEST_P(EveryWire, TellsThatNoHandIsSeen) {
  const HandMessage message = read_hand_message(message_of(GetParam(), false, false));
  ASSERT_FALSE(message.hands.empty());
  for (const HandObservation& hand : message.hands) {
    EXPECT_FALSE(hand.is_seen());
    EXPECT_FALSE(hand.X_SH);
  }
}

TEST_P(EveryWire, RefusesEveryMessageThatIsCutOff) {
  const std::string whole = message_of(GetParam());
  for (std::size_t length = 0; length < whole.size(); length += 1 + whole.size() / 100) {
    EXPECT_NE(refusal_of_message(whole.substr(0, length)), "") << length;
  }
}

std::string name_of_case(const testing::TestParamInfo<HandWire>& info) {
  std::string name = name_of(info.param);
  std::erase_if(name, [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; });
  return name;
}

INSTANTIATE_TEST_SUITE_P(HandMessage, EveryWire,
                         testing::Values(HandWire::kLandmarks, HandWire::kOpenXr, HandWire::kRokoko,
                                         HandWire::kRokokoLz4, HandWire::kManus),
                         name_of_case);

// -Z points to the fingers, +Y out of the back of the hand, as OpenXR defines it.
TEST(HandMessage, HasTheWristOfOpenXrAndRokokoInARightHandedFrame) {
  for (const HandWire wire : {HandWire::kOpenXr, HandWire::kRokoko, HandWire::kRokokoLz4}) {
    for (const bool left : {false, true}) {
      const HandObservation hand = hand_of(read_hand_message(message_of(wire, left)), left);
      ASSERT_TRUE(hand.X_SH);
      const HandLandmarks& points = *hand.landmarks;
      EXPECT_TRUE(hand.X_SH->translation().isApprox(points.col(kWristLandmark), 1e-9));
      const Eigen::Vector3d along =
          (points.col(base_landmark(Finger::kMiddle)) - points.col(kWristLandmark)).normalized();
      EXPECT_TRUE((-hand.X_SH->linear().col(2)).isApprox(along, 1e-6)) << name_of(wire);
      EXPECT_NEAR(hand.X_SH->linear().determinant(), 1.0, 1e-9);
      const Eigen::Vector3d to_little =
          points.col(base_landmark(Finger::kLittle)) - points.col(base_landmark(Finger::kIndex));
      EXPECT_EQ(hand.X_SH->linear().col(0).dot(to_little) > 0.0, !left)
          << "x points to the right of a hand whose palm is down";
    }
  }
  EXPECT_FALSE(hand_of(read_hand_message(message_of(HandWire::kManus)), false).X_SH);
}

TEST(HandMessage, TakesTheFirstHandsOfRokokoWithGloves) {
  Json frame = Json::parse(message_of(HandWire::kRokoko, true));
  Json second = frame["scene"]["actors"][0];
  frame["scene"]["actors"][0]["meta"]["hasLeftGlove"] = false;
  second["body"]["leftHand"]["position"]["y"] =
      second["body"]["leftHand"]["position"]["y"].get<double>() + 1e-3;
  frame["scene"]["actors"].push_back(second);
  const HandMessage message = read_hand_message(frame.dump());
  EXPECT_FALSE(hand_of(message, false).is_seen());
  const HandObservation left = hand_of(message, true);
  ASSERT_TRUE(left.is_seen());
  EXPECT_DOUBLE_EQ(left.landmarks->col(kWristLandmark).y(),
                   second["body"]["leftHand"]["position"]["y"].get<double>());
  EXPECT_DOUBLE_EQ(left.landmarks->col(kWristLandmark).x(),
                   -second["body"]["leftHand"]["position"]["x"].get<double>());
}

TEST(HandMessage, NamesWhatIsWrongInAFrameOfRokoko) {
  const Json good = Json::parse(message_of(HandWire::kRokoko));
  Json old = good;
  old["version"] = "2,0";
  EXPECT_THAT(refusal_of_message(old.dump()), HasSubstr("version 2, expected 3 or 4"));
  Json boneless = good;
  boneless["scene"]["actors"][0]["body"].erase("rightRingTip");
  EXPECT_THAT(refusal_of_message(boneless.dump()), HasSubstr("rightRingTip"));
  Json turned = good;
  turned["scene"]["actors"][0]["body"]["rightHand"]["rotation"]["w"] = 3.0;
  EXPECT_THAT(refusal_of_message(turned.dump()), HasSubstr("quaternion of length"));
  std::string damaged = message_of(HandWire::kRokokoLz4);
  damaged[4] ^= 0x55;  // its version
  EXPECT_EQ(refusal_of_message(damaged), "a damaged frame of LZ4");
}

TEST(HandMessage, TakesJointsOfOpenXrAsPointsPosesAndObjects) {
  const Json poses = Json::parse(message_of(HandWire::kOpenXr));
  const HandObservation expected = hand_of(read_hand_message(poses.dump()), false);
  Json points = poses;
  Json objects = poses;
  for (std::size_t i = 0; i < poses["joints"].size(); ++i) {
    const Json& pose = poses["joints"][i];
    points["joints"][i] = Json::array({pose[0], pose[1], pose[2]});
    objects["joints"][i] = {{"position", {{"x", pose[0]}, {"y", pose[1]}, {"z", pose[2]}}},
                            {"orientation", {pose[3], pose[4], pose[5], pose[6]}},
                            {"flags", 15},
                            {"radius", 0.01}};
  }
  const HandObservation of_points = hand_of(read_hand_message(points.dump()), false);
  EXPECT_TRUE(*of_points.landmarks == *expected.landmarks);
  EXPECT_FALSE(of_points.X_SH);
  const HandObservation of_objects = hand_of(read_hand_message(objects.dump()), false);
  EXPECT_TRUE(*of_objects.landmarks == *expected.landmarks);
  ASSERT_TRUE(of_objects.X_SH);
  EXPECT_TRUE(of_objects.X_SH->isApprox(*expected.X_SH));
}

TEST(HandMessage, SeesNoHandWhoseJointsAreNotValid) {
  const Json good = Json::parse(message_of(HandWire::kOpenXr));
  Json inactive = good;
  inactive["isActive"] = false;
  EXPECT_FALSE(read_hand_message(inactive.dump()).hands.at(0).is_seen());
  Json hidden = good;
  hidden["joints"][25] = nullptr;
  EXPECT_FALSE(read_hand_message(hidden.dump()).hands.at(0).is_seen());
  Json palmless = good;
  palmless["joints"][0] = nullptr;  // not a landmark
  EXPECT_TRUE(read_hand_message(palmless.dump()).hands.at(0).is_seen());
  Json unlocated = good;
  unlocated["joints"][7] = {{"position", {0.0, 0.0, 0.0}}, {"flags", 1}};
  EXPECT_FALSE(read_hand_message(unlocated.dump()).hands.at(0).is_seen());
}

TEST(HandMessage, NamesWhatIsWrongWithJointsOfOpenXr) {
  const Json good = Json::parse(message_of(HandWire::kOpenXr));
  Json few = good;
  few["joints"].erase(25);
  EXPECT_EQ(refusal_of_message(few.dump()), "25 joints of a hand, expected 26");
  Json odd = good;
  odd["joints"][9] = {1.0, 2.0};
  EXPECT_THAT(refusal_of_message(odd.dump()), HasSubstr("joint 9 is neither a point nor a pose"));
  Json millimetres = good;
  for (Json& joint : millimetres["joints"]) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      joint[axis] = 1000.0 * joint[axis].get<double>();
    }
  }
  EXPECT_THAT(refusal_of_message(millimetres.dump()), HasSubstr("expected metres"));
}

TEST(HandMessage, ReadsErgonomicsOfManusInEverySpelling) {
  const Json list = Json::parse(message_of(HandWire::kManus));
  const auto expected = *hand_of(read_hand_message(list.dump()), false).angles;
  Json object = list;
  object["ergonomics"] = Json::object();
  std::vector<double> numbers(20, 0.0);  // no left glove
  for (const Json& one : list["ergonomics"]) {
    std::string name = one["type"];
    if (name == "RingSpread") {
      name = "RingMCPSpread";  // as in the names of the SDK
    }
    object["ergonomics"][name] = one["value"];
    numbers.push_back(one["value"]);
  }
  object["ergonomics"]["Unknown"] = "ignored";
  const Json of_rosbridge{{"op", "publish"}, {"topic", "/manus_glove_0"}, {"msg", list}};
  for (const std::string& text :
       {object.dump(), of_rosbridge.dump(), fmt::format("{}", fmt::join(numbers, ", "))}) {
    const HandMessage message = read_hand_message(text);
    EXPECT_EQ(message.wire, HandWire::kManus);
    const HandObservation hand = hand_of(message, false);
    ASSERT_TRUE(hand.angles) << text;
    for (const int index : landmark_sensors()) {
      EXPECT_NEAR(hand.angles->at(static_cast<std::size_t>(index)),
                  expected.at(static_cast<std::size_t>(index)), 1e-12);
    }
  }
}

TEST(HandMessage, TakesSpreadOfManusAsPositiveTowardsTheThumb) {
  Json message = Json::parse(message_of(HandWire::kManus));
  for (Json& one : message["ergonomics"]) {
    one["value"] = one["type"] == "IndexSpread" ? 12.0 : one["type"] == "RingSpread" ? -5.0 : 0.0;
  }
  const auto angles = *hand_of(read_hand_message(message.dump()), false).angles;
  EXPECT_NEAR(angles.at(sensor("MiddleIndexAbduct")), 12.0 * geometric::kDegree, 1e-12);
  EXPECT_NEAR(angles.at(sensor("RingMiddleAbduct")), 5.0 * geometric::kDegree, 1e-12);
  EXPECT_NEAR(angles.at(sensor("PinkieRingAbduct")), -5.0 * geometric::kDegree, 1e-12);
  EXPECT_TRUE(std::isnan(angles.at(sensor("PalmArch"))));
}

TEST(HandMessage, NamesWhatIsWrongWithErgonomicsOfManus) {
  const Json good = Json::parse(message_of(HandWire::kManus));
  Json few = good;
  few["ergonomics"].erase(6);
  EXPECT_EQ(refusal_of_message(few.dump()), "no IndexPIPStretch in ergonomics");
  Json sideless = good;
  sideless.erase("side");
  EXPECT_EQ(refusal_of_message(sideless.dump()), "no key \"hand\"");
  Json large = good;
  large["ergonomics"][0]["value"] = 5000.0;
  EXPECT_THAT(refusal_of_message(large.dump()), HasSubstr("expected degrees"));
  EXPECT_THAT(refusal_of_message("1, 2, 3"), HasSubstr("3 numbers, expected 40"));
  EXPECT_THAT(refusal_of_message("1, x"), HasSubstr("is no number"));
  EXPECT_THAT(refusal_of_message("hello"), HasSubstr("is no JSON object"));
}

}  // namespace
}  // namespace handway::device
