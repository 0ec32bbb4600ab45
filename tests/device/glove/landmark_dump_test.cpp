/// Landmarks as scripts with hand trackers write them: each says the angles that it was made from.
#include "handway/device/emulators/landmark_unit.h"
#include "handway/device/glove/human_hand.h"
#include "handway/device/glove/recording.h"
#include "handway_test/input_errors.h"
#include "handway_test/paths.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

namespace handway::device {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;

constexpr int kFrames = 6;

// A hand that bends its fingers, frame by frame.
GloveAngles angles_of(int frame) {
  GloveAngles angles;
  angles.angles.fill(0.1);
  for (const char* unseen : {"PalmArch", "WristPitch", "WristYaw"}) {
    angles.angles.at(static_cast<std::size_t>(*find_sensor(unseen))) = 0.0;
  }
  for (const char* name : {"IndexMPJ", "IndexPIJ", "IndexDIJ", "MiddleMPJ", "MiddlePIJ"}) {
    angles.angles.at(static_cast<std::size_t>(*find_sensor(name))) = 0.2 + 0.1 * frame;
  }
  return angles;
}

// Returns landmarks in m about their own middle, as MediaPipe's world landmarks: x right, y down, z
// away.
HandLandmarks world(int frame, bool left = false) {
  HandLandmarks points = hand_landmarks(angles_of(frame));
  points.colwise() -= points.rowwise().mean().eval();
  if (left) {
    points.row(1) *= -1.0;
  }
  return points;
}

// Returns the hand in shares of a picture of 4:3.
HandLandmarks in_picture(int frame) {
  HandLandmarks points = 2.0 * world(frame);
  points.row(0) = (points.row(0) / (4.0 / 3.0)).array() + 0.5;
  points.row(1) = points.row(1).array() + 0.5;
  points.row(2) /= 4.0 / 3.0;
  return points;
}

class LandmarkDump : public testing::Test {
 protected:
  [[nodiscard]] Recording read(const std::string& name, const std::string& text) const {
    const std::filesystem::path file = folder_.path() / name;
    std::ofstream(file) << text;
    return read_recording(file);
  }

  static std::string cells(const HandLandmarks& points) {
    return fmt::format("{}", fmt::join(points.reshaped().begin(), points.reshaped().end(), ","));
  }

  // A table of frames below its header.
  static std::string table(const std::string& header, const std::function<std::string(int)>& row) {
    std::string text = header.empty() ? "" : header + "\n";
    for (int frame = 0; frame < kFrames; ++frame) {
      text += row(frame) + "\n";
    }
    return text;
  }

  static std::string header(const std::string& pattern, int base = 0) {
    std::string text;
    for (int point = 0; point < 21; ++point) {
      for (const char* axis : {"x", "y", "z"}) {
        text += (text.empty() ? "" : ",") + fmt::format(fmt::runtime(pattern), fmt::arg("a", axis),
                                                        fmt::arg("n", point + base));
      }
    }
    return text;
  }

  static void expect_angles(const Recording& recording, const char* what) {
    ASSERT_EQ(recording.times.size(), kFrames) << what;
    for (int frame = 0; frame < kFrames; ++frame) {
      const GloveAngles read = angles_of_row(recording, frame);
      for (const int sensor : landmark_sensors()) {
        const auto index = static_cast<std::size_t>(sensor);
        EXPECT_NEAR(read.angles.at(index), angles_of(frame).angles.at(index), 1e-4)
            << what << ", " << cyberglove_sensors()[index].name;
      }
    }
  }

  test::ScratchFolder folder_;
};

/// Messages of an emulated sender as lines of a file, one for each frame.
std::string lines_of_sender(HandWire wire, bool left) {
  LandmarkUnitSettings unit;
  unit.wire = wire;
  unit.left = left;
  unit.rate = 10.0;
  const auto sender = make_landmark_unit(
      unit, [](double time) { return angles_of(static_cast<int>(std::lround(10.0 * time))); });
  std::string text;
  for (int frame = 0; frame < kFrames; ++frame) {
    for (const auto& line : sender->advance(*sender->next_due())) {
      text.append(line.begin(), line.end());
    }
  }
  return text;
}

TEST_F(LandmarkDump, ReadsLinesOfOpenXrRokokoAndManus) {
  for (const HandWire wire : {HandWire::kOpenXr, HandWire::kRokoko, HandWire::kManus}) {
    for (const bool left : {false, true}) {
      const Recording recording = read("hand.jsonl", lines_of_sender(wire, left));
      expect_angles(recording, name_of(wire).c_str());
      EXPECT_NEAR(recording.times[kFrames - 1], 0.1 * (kFrames - 1), 1e-9);
      EXPECT_EQ(recording.bones.has_value(), wire != HandWire::kManus);
      EXPECT_TRUE(recording.warnings.empty()) << recording.warnings.front();
    }
  }
}

TEST_F(LandmarkDump, NeedsTheTimeOfAMessage) {
  std::string text = lines_of_sender(HandWire::kManus, false);
  const std::size_t time = text.find("\"time\":0.0,");
  ASSERT_NE(time, std::string::npos);
  text.erase(time, std::string("\"time\":0.0,").size());
  const std::string refusal =
      test::refusal_of([&] { static_cast<void>(read("hand.jsonl", text)); });
  EXPECT_THAT(refusal, AllOf(HasSubstr("hand.jsonl:1"), HasSubstr("no key \"time\"")));
}

TEST_F(LandmarkDump, ReadsColumnsByTheirNames) {
  for (const auto& [pattern, base] :
       {std::pair("{a}{n}", 0), std::pair("{n}_{a}", 0), std::pair("landmark_{n}_{a}", 1),
        std::pair("right_{a}_{n}", 0)}) {
    const Recording recording =
        read("hand.csv", table("frame,handedness," + header(pattern, base), [](int frame) {
               return fmt::format("{},Right,{}", frame, cells(world(frame)));
             }));
    expect_angles(recording, pattern);
    EXPECT_THAT(recording.warnings,
                Contains(AllOf(HasSubstr("right hand"), HasSubstr("30 frames"))));
  }
}

TEST_F(LandmarkDump, ReadsTheNamesOfMediaPipe) {
  std::string names = "timestamp_ms";
  for (const char* point : {"WRIST",
                            "THUMB_CMC",
                            "THUMB_MCP",
                            "THUMB_IP",
                            "THUMB_TIP",
                            "INDEX_FINGER_MCP",
                            "INDEX_FINGER_PIP",
                            "INDEX_FINGER_DIP",
                            "INDEX_FINGER_TIP",
                            "MIDDLE_FINGER_MCP",
                            "MIDDLE_FINGER_PIP",
                            "MIDDLE_FINGER_DIP",
                            "MIDDLE_FINGER_TIP",
                            "RING_FINGER_MCP",
                            "RING_FINGER_PIP",
                            "RING_FINGER_DIP",
                            "RING_FINGER_TIP",
                            "PINKY_MCP",
                            "PINKY_PIP",
                            "PINKY_DIP",
                            "PINKY_TIP"}) {
    names += fmt::format(",{0}_x,{0}_y,{0}_z", point);
  }
  const Recording recording =
      read("hand.csv", table(names, [](int frame) {
             return fmt::format("{},{}", 1000 + 40 * frame, cells(world(frame)));
           }));
  expect_angles(recording, "names");
  EXPECT_NEAR(recording.times[kFrames - 1], 0.04 * (kFrames - 1), 1e-9);
}

TEST_F(LandmarkDump, ReadsColumnsWithoutNames) {
  expect_angles(
      read("hand.csv", table("", [](int frame) { return "fist," + cells(world(frame)); })),
      "63 columns behind a label");
}

TEST_F(LandmarkDump, TakesCoordinatesInAPictureForOneOfFourToThree) {
  const Recording recording =
      read("hand.csv", table(header("{a}{n}"), [](int frame) { return cells(in_picture(frame)); }));
  expect_angles(recording, "picture");
  EXPECT_THAT(recording.warnings, Contains(HasSubstr("shares of a picture of 4:3")));
}

TEST_F(LandmarkDump, SeesALeftHandFromWhereItBends) {
  const Recording recording = read(
      "hand.csv", table(header("{a}{n}"), [](int frame) { return cells(world(frame, true)); }));
  expect_angles(recording, "left");
  EXPECT_THAT(recording.warnings, Contains(HasSubstr("left hand")));
}

std::string json(const HandLandmarks& points) {
  std::string text;
  for (const auto& point : points.colwise()) {
    text += fmt::format(R"({}{{"x": {}, "y": {}, "z": {}, "visibility": 0}})",
                        text.empty() ? "" : ",\n", point.x(), point.y(), point.z());
  }
  return "[" + text + "]";
}

TEST_F(LandmarkDump, FindsHandsInJsonOfAnyNesting) {
  std::string list;
  std::string nested;
  std::string lines;
  for (int frame = 0; frame < kFrames; ++frame) {
    const std::string comma = frame == 0 ? "" : ",";
    list += comma + json(world(frame));
    nested += comma +
              fmt::format(R"({{"time": {}, "hands": [{{"handedness": "Right", "landmarks": {},
 "world_landmarks": {}}}, {{"landmarks": {}}}]}})",
                          0.1 * frame, json(in_picture(frame)), json(world(frame)), json(world(0)));
    std::string row = json(world(frame));
    std::erase(row, '\n');
    lines += fmt::format("{{\"t\": {}, \"multi_hand_landmarks\": [{}]}}\n", frame, row);
  }
  expect_angles(read("list.json", "[" + list + "]"), "list");
  const Recording recording = read("nested.json", "{\n\"frames\": [" + nested + "]}");
  expect_angles(recording, "nested");
  EXPECT_NEAR(recording.times[1], 0.1, 1e-9);
  expect_angles(read("lines.jsonl", lines), "lines");
}

TEST_F(LandmarkDump, KeepsTimesWhoseUnitIsNamed) {
  std::string lines;
  for (int frame = 0; frame < kFrames; ++frame) {
    std::string row = json(world(frame));
    std::erase(row, '\n');
    lines += fmt::format("{{\"timestamp_us\": {}, \"hand\": {}}}\n", 10'000'000 * frame, row);
  }
  EXPECT_NEAR(read("lines.jsonl", lines).times[1], 10.0, 1e-9);
  const Recording recording = read("hand.csv", table("time [s]," + header("{a}{n}"), [](int frame) {
                                     return fmt::format("{},{}", 10 * frame, cells(world(frame)));
                                   }));
  EXPECT_NEAR(recording.times[1], 10.0, 1e-9) << "not 10 ms";
}

TEST_F(LandmarkDump, LeavesOutFramesWithoutAHand) {
  const Recording recording =
      read("hand.csv", table(header("{a}{n}"), [](int frame) {
             return cells(frame == 2 ? HandLandmarks::Zero().eval() : world(frame));
           }));
  EXPECT_EQ(recording.times.size(), kFrames - 1);
  EXPECT_THAT(recording.warnings, Contains(HasSubstr("1 of 6 frames left out")));
  EXPECT_THAT(test::refusal_of([&] { static_cast<void>(read("none.json", "[1, 2]")); }),
              AllOf(HasSubstr("none.json"), HasSubstr("no hand"), HasSubstr("21 landmarks")));
}

}  // namespace
}  // namespace handway::device
