#include "handway/device/glove/landmark_line.h"

#include "handway/device/core/line_protocol.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace handway::device {
namespace {

using testing::HasSubstr;

HandLandmarks flat_hand() {
  GloveAngles flat;
  flat.angles.fill(0.0);
  return hand_landmarks(flat);
}

std::string written() { return write_landmark_line({1.5, false, flat_hand()}); }

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  return text.replace(text.find(what), what.size(), by);
}

std::string refusal_of(const std::string& text) {
  try {
    static_cast<void>(read_landmark_line(text));
  } catch (const LineProtocolError& error) {
    return error.what();
  }
  return "";
}

TEST(LandmarkLine, ReadsWhatItWrites) {
  for (const bool left : {false, true}) {
    const LandmarkLine line = read_landmark_line(write_landmark_line({1.5, left, flat_hand()}));
    EXPECT_EQ(line.time, 1.5);
    EXPECT_EQ(line.left, left);
    ASSERT_TRUE(line.landmarks);
    EXPECT_TRUE(line.landmarks->isApprox(flat_hand(), 1e-12));
  }
}

TEST(LandmarkLine, NeedsNeitherTimeNorHandAndTakesMediaPipesSpelling) {
  const LandmarkLine bare =
      read_landmark_line(replaced(written(), R"("time":1.5,"hand":"right",)", ""));
  EXPECT_FALSE(bare.time);
  EXPECT_FALSE(bare.left);
  EXPECT_TRUE(read_landmark_line(replaced(written(), R"("right")", R"("Left")")).left);
}

TEST(LandmarkLine, TakesPointsByTheirCoordinates) {
  std::string text = R"({"hand": "right", "score": 0.9, "landmarks": [)";
  const auto hand = flat_hand();
  for (const auto& p : hand.colwise()) {
    text += (text.ends_with('[') ? "{\"x\":" : ",{\"x\":") + std::to_string(p.x()) +
            ",\"y\":" + std::to_string(p.y()) + ",\"z\":" + std::to_string(p.z()) + "}";
  }
  EXPECT_TRUE(read_landmark_line(text + "]}").landmarks->isApprox(hand, 1e-4));
}

TEST(LandmarkLine, SaysThatNoHandIsSeen) {
  EXPECT_FALSE(read_landmark_line(R"({"landmarks": []})").landmarks);
  EXPECT_FALSE(read_landmark_line(R"({"time": 3, "landmarks": null})").landmarks);
}

TEST(LandmarkLine, RefusesWhatIsNoHandAndSaysWhy) {
  EXPECT_THAT(refusal_of("hello"), HasSubstr("\"hello\" is no JSON object"));
  EXPECT_THAT(refusal_of(R"({"time": 1})"), HasSubstr("no key \"landmarks\""));
  EXPECT_THAT(refusal_of(R"({"landmarks": [[0, 0, 0]]})"), HasSubstr("1 landmarks, expected 21"));
  EXPECT_THAT(refusal_of(replaced(written(), "[0.0,0.0,0.0]", "[0.0,0.0]")),
              HasSubstr("landmark 0 is no point"));
  EXPECT_THAT(refusal_of(replaced(written(), "[0.0,0.0,0.0]", "[0.0,\"0\",0.0]")),
              HasSubstr("y of landmark 0 is no number"));
  EXPECT_THAT(refusal_of(replaced(written(), "\"right\"", "\"both\"")), HasSubstr("\"both\""));
  EXPECT_THAT(refusal_of(replaced(written(), "1.5", "null")), HasSubstr("time is no number"));
  EXPECT_THAT(refusal_of(write_landmark_line({{}, false, 1000.0 * flat_hand()})),
              HasSubstr("expected metres"));
  EXPECT_THAT(refusal_of(write_landmark_line({{}, false, 0.01 * flat_hand()})),
              HasSubstr("expected metres"));
  HandLandmarks line = flat_hand();
  line.bottomRows<2>().setZero();
  EXPECT_THAT(refusal_of(write_landmark_line({{}, false, line})), HasSubstr("lie in a line"));
}

}  // namespace
}  // namespace handway::device
