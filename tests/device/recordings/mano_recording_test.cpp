/// Recordings of parameters of MANO: arrays, JSON and tables of text.
#include "handway/device/glove/mano_hand.h"
#include "handway/device/glove/recording.h"
#include "handway/device/recordings/recording_contents.h"
#include "handway_test/input_errors.h"
#include "handway_test/paths.h"

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zip.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace handway::device {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

using Numbers = std::vector<double>;

std::string npy(const std::string& shape, const Numbers& numbers) {
  const std::string text =
      fmt::format("{{'descr': '<f8', 'fortran_order': False, 'shape': {}, }}\n", shape);
  std::string bytes = "\x93NUMPY\x01";
  bytes += '\x00';
  bytes += static_cast<char>(text.size() & 0xFF);
  bytes += static_cast<char>(text.size() >> 8);
  bytes += text;
  const std::size_t at = bytes.size();
  bytes.resize(at + numbers.size() * sizeof(double));
  std::memcpy(bytes.data() + at, numbers.data(), numbers.size() * sizeof(double));
  return bytes;
}

// A posture whose fingers bend towards the palm.
ManoPose bent(double angle, bool left = false) {
  ManoPose pose = ManoPose::Zero();
  for (int joint = 0; joint < 12; ++joint) {
    pose(2, joint) = (left ? -1.0 : 1.0) * (angle + 0.01 * joint);
  }
  return pose;
}

Numbers numbers_of(const ManoPose& pose) { return {pose.data(), pose.data() + pose.size()}; }

Numbers joined(const std::vector<Numbers>& parts) {
  Numbers all;
  for (const Numbers& part : parts) {
    all.insert(all.end(), part.begin(), part.end());
  }
  return all;
}

const std::vector<double> kAngles{0.2, 0.5, 0.9};

// Postures with these angles, a row each, with `before` in front of each.
Numbers rows_of(bool left = false, const Numbers& before = {}) {
  Numbers all;
  for (const double angle : kAngles) {
    all = joined({all, before, numbers_of(bent(angle, left))});
  }
  return all;
}

double expected(double angle, std::string_view sensor) {
  const HandLandmarks points = mano_landmarks(bent(angle), usual_mano_joints(false));
  return glove_angles(in_palm_frame(points, false))
      .angles.at(static_cast<std::size_t>(find_sensor(sensor).value()));
}

void expect_postures(const Recording& recording) {
  ASSERT_EQ(recording.times.size(), std::ssize(kAngles));
  for (const std::string_view sensor : {"IndexMPJ", "MiddlePIJ", "RingDIJ", "PinkieRingAbduct"}) {
    const int column = column_of(recording.header, *find_sensor(sensor));
    for (std::size_t row = 0; row < kAngles.size(); ++row) {
      EXPECT_NEAR(recording.values(static_cast<Eigen::Index>(row), column),
                  expected(kAngles[row], sensor), 1e-9)
          << sensor;
    }
  }
}

class ManoRecording : public testing::Test {
 protected:
  fs::path write(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_.path() / name, std::ios::binary) << bytes;
    return folder_.path() / name;
  }
  fs::path write_npz(const std::vector<std::pair<std::string, std::string>>& arrays) const {
    const fs::path file = folder_.path() / "hands.npz";
    fs::remove(file);
    zip_t* archive = zip_open(file.c_str(), ZIP_CREATE, nullptr);
    for (const auto& [name, bytes] : arrays) {
      zip_source_t* source = zip_source_buffer(archive, bytes.data(), bytes.size(), 0);
      EXPECT_GE(zip_file_add(archive, (name + ".npy").c_str(), source, 0), 0);
    }
    EXPECT_EQ(zip_close(archive), 0);
    return file;
  }
  static std::string refusal(const fs::path& file) {
    return test::refusal_of([&] { static_cast<void>(read_recording(file)); });
  }

  test::ScratchFolder folder_;
};

TEST_F(ManoRecording, OfRotationVectorsIsReadInAllShapes) {
  expect_postures(read_recording(write("hands.npy", npy("(3, 45)", rows_of()))));
  expect_postures(read_recording(write("hands.npy", npy("(3, 15, 3)", rows_of()))));
  expect_postures(read_recording(write("hands.npy", npy("(3, 48)", rows_of(false, {1, 2, 3})))));
  expect_postures(read_recording(write("hands.npy", npy("(3, 16, 3)", rows_of(false, {1, 2, 3})))));
  for (const char* name : {"hand_pose", "pose", "poses", "mano_pose", "fullpose", "right/theta"}) {
    expect_postures(read_recording(write_npz(
        {{"betas", npy("(3, 10)", Numbers(30, 0.0))}, {name, npy("(3, 45)", rows_of())}})));
  }
}

TEST_F(ManoRecording, OfRotationMatricesIsRead) {
  Numbers rows;
  for (const double angle : kAngles) {
    const ManoPose pose = bent(angle);
    for (int joint = 0; joint < kManoJoints; ++joint) {
      const double turn = pose.col(joint).norm();
      const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> R =
          Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ()).toRotationMatrix();
      rows.insert(rows.end(), R.data(), R.data() + R.size());
    }
  }
  expect_postures(read_recording(write_npz({{"hand_pose", npy("(3, 15, 3, 3)", rows)}})));
}

TEST_F(ManoRecording, OfALeftHandIsMirroredByNameOrByItsFingers) {
  const Recording named =
      read_recording(write_npz({{"left_hand_pose", npy("(3, 45)", rows_of(true))}}));
  expect_postures(named);
  EXPECT_THAT(named.warnings, Contains(AllOf(HasSubstr("left hand"), Not(HasSubstr("bend")))));
  const Recording unnamed = read_recording(write_npz({{"pose", npy("(3, 45)", rows_of(true))}}));
  expect_postures(unnamed);
  EXPECT_THAT(unnamed.warnings, Contains(AllOf(HasSubstr("left hand"), HasSubstr("bend"))));
  EXPECT_FALSE(unnamed.bones) << "they are not the person's";
}

TEST_F(ManoRecording, OfOneOfSeveralHandsIsChosenByNameAndColumns) {
  const fs::path file = write_npz(
      {{"left_pose", npy("(3, 45)", rows_of(true))}, {"right_pose", npy("(3, 45)", rows_of())}});
  EXPECT_THAT(refusal(file), AllOf(HasSubstr("left_pose (3 x 45)"), HasSubstr("#")));
  expect_postures(read_recording(file.string() + "#left_pose"));
  expect_postures(read_recording(file.string() + "#right_pose"));
  Numbers body;
  for (const double angle : kAngles) {
    body = joined({body, Numbers(66, 0.1), numbers_of(bent(angle, true)), numbers_of(bent(angle))});
  }
  const fs::path whole = write_npz({{"poses", npy("(3, 156)", body)}});
  expect_postures(read_recording(whole.string() + "#poses[66:111]"));
  expect_postures(read_recording(whole.string() + "#poses[111:156]"));
}

TEST_F(ManoRecording, GivesWayToLandmarks) {
  Numbers points;
  for (const double angle : kAngles) {
    const HandLandmarks seen = mano_landmarks(bent(angle), usual_mano_joints(false));
    points.insert(points.end(), seen.data(), seen.data() + seen.size());
  }
  const Recording recording = read_recording(write_npz(
      {{"joints", npy("(3, 21, 3)", points)}, {"hand_pose", npy("(3, 45)", Numbers(135, 0.0))}}));
  expect_postures(recording);
  EXPECT_EQ(recording.header.device, "landmarks of a hand");
}

TEST_F(ManoRecording, AddsTheMeanPostureOfTheModel) {
  const ManoPose mean = ManoPose::Constant(0.1);
  Numbers rows;
  for (const double angle : kAngles) {
    rows = joined({rows, numbers_of(bent(angle) - mean)});
  }
  const std::pair<std::string, std::string> model{"hands_mean", npy("(45,)", numbers_of(mean))};
  const Recording added = read_recording(write_npz({{"hand_pose", npy("(3, 45)", rows)}, model}));
  expect_postures(added);
  EXPECT_THAT(added.warnings, Contains(HasSubstr("hands_mean is added")));
  expect_postures(read_recording(write_npz({{"fullpose", npy("(3, 45)", rows_of())}, model})));
}

TEST_F(ManoRecording, OfPrincipalComponentsTakesThoseOfTheModel) {
  const ManoPose mean = bent(0.2);
  const ManoPose direction = bent(0.5) - bent(0.2);
  const Numbers components = joined({numbers_of(direction), Numbers(45, 0.7)});
  const std::pair<std::string, std::string> coefficients{
      "pca", npy("(3, 2)", {0.0, 0.0, 1.0, 0.0, 7.0 / 3.0, 0.0})};
  expect_postures(read_recording(write_npz({coefficients,
                                            {"hands_components", npy("(2, 45)", components)},
                                            {"hands_mean", npy("(45,)", numbers_of(mean))}})));
  EXPECT_THAT(refusal(write_npz({coefficients})),
              AllOf(HasSubstr("hands_components"), HasSubstr("hands_mean"), HasSubstr("pickle")));
  EXPECT_THAT(refusal(write_npz({coefficients,
                                 {"hands_components", npy("(1, 45)", numbers_of(direction))},
                                 {"hands_mean", npy("(45,)", numbers_of(mean))}})),
              HasSubstr("hands_components (1 x 45)"));
}

TEST_F(ManoRecording, TakesTheJointsOfTheModelForBones) {
  const ManoJoints joints = 0.9 * usual_mano_joints(true);
  const Recording recording =
      read_recording(write_npz({{"hand_pose", npy("(3, 45)", rows_of(true))},
                                {"J", npy("(16, 3)", {joints.data(), joints.data() + 48})}}));
  expect_postures(recording);
  ASSERT_TRUE(recording.bones);
  EXPECT_NEAR((*recording.bones)[2][1], 0.9 * typical_bones()[2][1], 1e-12);
  EXPECT_THAT(refusal(write_npz({{"hand_pose", npy("(3, 45)", rows_of(true))},
                                 {"J", npy("(16, 3)", Numbers(48, 0.0))}})),
              AllOf(HasSubstr("variable J"), HasSubstr("in a line")));
}

TEST_F(ManoRecording, LeavesOutFramesWithGapsAndNamesImpossibleAngles) {
  Numbers rows = joined({rows_of(), numbers_of(bent(0.3))});
  rows[3 * 45 + 7] = std::numeric_limits<double>::quiet_NaN();
  const Recording recording = read_recording(write("hands.npy", npy("(4, 45)", rows)));
  expect_postures(recording);
  EXPECT_THAT(recording.warnings, Contains(HasSubstr("1 of 4 frames left out")));
  rows[45] = 57.0;
  EXPECT_THAT(refusal(write("hands.npy", npy("(4, 45)", rows))),
              AllOf(HasSubstr("row 2, joint 1"), HasSubstr("57"), HasSubstr("rad")));
}

TEST_F(ManoRecording, OfJsonIsReadInFramesAndInLists) {
  std::string frames;
  std::string lines;
  std::string list;
  std::vector<double> times;
  for (std::size_t i = 0; i < kAngles.size(); ++i) {
    const std::string pose = fmt::format(
        "[{}]", fmt::join(joined({{0, 0, 1}, numbers_of(bent(kAngles[i], true))}), ","));
    const std::string row = fmt::format(
        "{{\"time_s\": {}, \"left\": {{\"pose\": {}, \"shape\": [0, 1]}}, \"right\": {{\"pose\": "
        "{}}}}}",
        0.1 * static_cast<double>(i), pose, fmt::format("[{}]", fmt::join(Numbers(48, 0.0), ",")));
    frames += (i > 0 ? "," : "") + row;
    lines += row + "\n";
    list += (i > 0 ? "," : "") + pose;
    times.push_back(0.1 * static_cast<double>(i));
  }
  for (const std::string& text :
       {"[" + frames + "]", lines,
        fmt::format("{{\"time_s\": [{}], \"left\": {{\"t\": 0, \"x\": 1}}, \"left_pose\": [{}], "
                    "\"right_pose\": []}}",
                    fmt::join(times, ","), list)}) {
    const Recording recording = read_recording(write("hands.json", text));
    expect_postures(recording);
    EXPECT_NEAR(recording.times[2], 0.2, 1e-9) << text;
    EXPECT_THAT(recording.warnings, Contains(HasSubstr("left hand")));
  }
  EXPECT_THAT(read_recording(write("hands.json", "[" + frames + "]")).warnings,
              Contains(HasSubstr("3 postures of another hand left out")));
}

TEST_F(ManoRecording, OfTablesIsReadByNamesAndByTheNumberOfColumns) {
  std::string named = "time";
  std::string unnamed;
  for (int i = 0; i < 45; ++i) {
    named += fmt::format(",hand_pose_{}", i);
  }
  named += ",grip\n";
  for (std::size_t i = 0; i < kAngles.size(); ++i) {
    const std::string pose = fmt::format("{}", fmt::join(numbers_of(bent(kAngles[i])), ","));
    named += fmt::format("{},{},7\n", 0.1 * static_cast<double>(i), pose);
    unnamed += pose + "\n";
  }
  const Recording recording = read_recording(write("hands.csv", named));
  expect_postures(recording);
  EXPECT_NEAR(recording.times[2], 0.2, 1e-9);
  expect_postures(read_recording(write("hands.csv", unnamed)));
}

TEST_F(ManoRecording, RefusesPicklesWithAdvice) {
  for (const auto& [name, bytes] : {std::pair<std::string, std::string>{"MANO_RIGHT.pkl", "(dp0\n"},
                                    {"hands.bin", std::string("\x80\x04\x95", 3)}}) {
    EXPECT_THAT(refusal(write(name, bytes)),
                AllOf(HasSubstr(name), HasSubstr("pickle"), HasSubstr("numpy.savez()"),
                      HasSubstr("hands_components")));
  }
}

}  // namespace
}  // namespace handway::device
