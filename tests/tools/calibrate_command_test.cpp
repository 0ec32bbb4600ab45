#include "command_line.h"
#include "handway/geometric/formats/camera_measurements.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <string>

namespace handway::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const geometric::Pose kCamera = geometric::pose_from_rpy({0.05, -0.02, 0.09}, 0.1, -0.2, 1.4);

/// A table of touched points; that of `wrong` is off by 40 mm.
std::string touched_points(int wrong) {
  std::string text = "robot_x,robot_y,robot_z,camera_x,camera_y,camera_z\n";
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3d p_A(0.3 + 0.1 * (i % 3), 0.1 * (i / 3), 0.02 * i * (i % 4));
    Eigen::Vector3d p_C = kCamera.inverse() * p_A;
    p_C.z() += i == wrong ? 0.04 : 0.0;
    text +=
        fmt::format("{},{},{},{},{},{}\n", p_A.x(), p_A.y(), p_A.z(), p_C.x(), p_C.y(), p_C.z());
  }
  return text;
}

/// Pairs of poses of a camera on the hand.
std::string pose_pairs(int count) {
  const geometric::Pose target = geometric::pose_from_rpy({0.6, 0.1, 0.0}, 3.0, 0.1, 0.2);
  std::string text =
      "hand_x,hand_y,hand_z,hand_qx,hand_qy,hand_qz,hand_qw,"
      "target_x,target_y,target_z,target_qx,target_qy,target_qz,target_qw\n";
  for (int i = 0; i < count; ++i) {
    const geometric::Pose X_BH = geometric::pose_from_rpy({0.5, 0.05 * i, 0.4}, 3.0 + 0.3 * (i % 2),
                                                          0.4 * (i % 3), 0.5 * (i % 4));
    const geometric::Pose X_CT = kCamera.inverse() * X_BH.inverse() * target;
    std::string row;
    for (const geometric::Pose& X : {X_BH, X_CT}) {
      const Eigen::Vector3d p = X.translation();
      const Eigen::Quaterniond q(X.linear());
      row += fmt::format("{}{},{},{},{},{},{},{}", row.empty() ? "" : ",", p.x(), p.y(), p.z(),
                         q.x(), q.y(), q.z(), q.w());
    }
    text += row + "\n";
  }
  return text;
}

TEST(CalibrateCamera, FindsACameraByPosesAndWritesIt) {
  const CommandLine line;
  line.write("pairs.csv", pose_pairs(6));
  const Outcome json = line.run("calibrate camera pairs.csv --mount hand --out camera.yaml --json");
  ASSERT_EQ(json.exit_code, 0) << json.err;
  const auto found = nlohmann::json::parse(json.out);
  EXPECT_NEAR(found.at("pose").at("xyz").at(2).get<double>(), 0.09, 1e-6);
  EXPECT_EQ(found.at("used"), 6);
  EXPECT_LT(found.at("rms_mm"), 1e-4);
  EXPECT_THAT(line.read("camera.yaml"), AllOf(HasSubstr("camera: hand\n"), HasSubstr("0.0500")));
  const Outcome unknown = line.run("calibrate camera pairs.csv");
  EXPECT_EQ(unknown.exit_code, 3);
  EXPECT_THAT(unknown.err, HasSubstr("--mount"));
}

TEST(CalibrateCamera, NamesTheOutlierAmongTouchedPoints) {
  const CommandLine line;
  line.write("points.csv", touched_points(4));
  const Outcome outcome = line.run("calibrate camera points.csv");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("8 points, 7 used"),
                                 HasSubstr("points.csv:6: 40.000 mm  outlier, not used"),
                                 HasSubstr("--xyz 0.05000 -0.02000 0.09000")));
  EXPECT_THAT(line.run("calibrate camera points.csv --keep-outliers").out,
              HasSubstr("8 points, 8 used"));
}

TEST(CalibrateCamera, RefusesWhatDeterminesNoCamera) {
  const CommandLine line;
  line.write("pairs.csv", pose_pairs(2));
  const Outcome few = line.run("calibrate camera pairs.csv --mount fixed");
  EXPECT_EQ(few.exit_code, 3);
  EXPECT_THAT(few.err, AllOf(HasSubstr("pairs.csv"), HasSubstr("3 or more")));
  EXPECT_EQ(line.run("calibrate camera missing.csv").exit_code, 3);
  EXPECT_EQ(line.run("calibrate").exit_code, 2);
}

}  // namespace
}  // namespace handway::test
