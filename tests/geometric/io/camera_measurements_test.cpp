#include "handway/geometric/formats/camera_measurements.h"

#include "handway_test/input_errors.h"
#include "handway_test/paths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>

namespace handway::geometric {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class Measurements : public testing::Test {
 protected:
  [[nodiscard]] std::filesystem::path write(const std::string& name,
                                            const std::string& text) const {
    std::ofstream(folder_.path() / name) << text;
    return folder_.path() / name;
  }
  [[nodiscard]] std::string refusal(const std::string& name, const std::string& text) const {
    return test::refusal_of(
        [&] { static_cast<void>(read_camera_measurements(write(name, text))); });
  }
  test::ScratchFolder folder_;
};

const Pose kQuarterTurn = pose_from_rpy({0.1, -0.2, 0.3}, 0.0, 0.0, std::numbers::pi / 2);

TEST_F(Measurements, OfPosesAreReadInEveryNotation) {
  const CameraMeasurements yaml = read_camera_measurements(write("m.yaml", R"(camera: fixed
pairs:
  - hand: {xyz: [0.1, -0.2, 0.3], rpy_deg: [0, 0, 90]}
    target: {xyz: [0.1, -0.2, 0.3], quaternion: [0, 0, 0.70710678, 0.70710678]}
  - hand: {xyz: [0.1, -0.2, 0.3], rotation_vector: [0, 0, 1.5707963267948966]}
    target: {xyz: [0.1, -0.2, 0.3], rpy_deg: [0, 0, 90]}
)"));
  EXPECT_EQ(yaml.mount, CameraMount::kFixed);
  ASSERT_EQ(yaml.pairs.size(), 2U);
  for (const HandEyePair& pair : yaml.pairs) {
    EXPECT_TRUE(pair.X_BH.isApprox(kQuarterTurn, 1e-8));
    EXPECT_TRUE(pair.X_CT.isApprox(kQuarterTurn, 1e-8));
  }
  EXPECT_THAT(yaml.pairs[1].place, HasSubstr("m.yaml:5"));

  const CameraMeasurements table = read_camera_measurements(
      write("m.csv",
            "# a remark\n"
            "target_qx,target_qy,target_qz,target_qw,target_x,target_y,target_z,"
            "hand_x,hand_y,hand_z,hand_rx,hand_ry,hand_rz\n"
            "0,0,0.70710678,0.70710678,0.1,-0.2,0.3,0.1,-0.2,0.3,0,0,1.5707963267948966\n"));
  EXPECT_FALSE(table.mount);
  ASSERT_EQ(table.pairs.size(), 1U);
  EXPECT_TRUE(table.pairs[0].X_BH.isApprox(kQuarterTurn, 1e-8));
  EXPECT_TRUE(table.pairs[0].X_CT.isApprox(kQuarterTurn, 1e-8));
  EXPECT_THAT(table.pairs[0].place, HasSubstr("m.csv:3"));
}

TEST_F(Measurements, OfPointsAreRead) {
  const CameraMeasurements yaml = read_camera_measurements(
      write("m.yaml", "points:\n  - {robot: [0.5, 0, 0.1], camera: [0.1, 0.2, 0.8]}\n"));
  ASSERT_EQ(yaml.points.size(), 1U);
  EXPECT_EQ(yaml.points[0].p_C, Eigen::Vector3d(0.1, 0.2, 0.8));
  const CameraMeasurements table = read_camera_measurements(write(
      "m.csv", "robot_x;robot_y;robot_z;camera_x;camera_y;camera_z\n0,5;0;0,1;0,1;0,2;0,8\n"));
  ASSERT_EQ(table.points.size(), 1U);
  EXPECT_EQ(table.points[0].p_A, Eigen::Vector3d(0.5, 0.0, 0.1));
}

TEST_F(Measurements, SayWhatIsWrongAndWhere) {
  EXPECT_THAT(refusal("m.yaml",
                      "pairs:\n  - hand: {xyz: [500, 0, 0], rpy_deg: [0, 0, 0]}\n"
                      "    target: {xyz: [0, 0, 1], rpy_deg: [0, 0, 0]}\n"),
              AllOf(HasSubstr("m.yaml:2"), HasSubstr("pairs[0].hand"), HasSubstr("metres")));
  EXPECT_THAT(refusal("m.yaml", "pairs:\n  - hand: {xyz: [0, 0, 0]}\n"), HasSubstr("rpy_deg"));
  EXPECT_THAT(refusal("m.yaml", "camera: head\n"), HasSubstr("hand or fixed"));
  EXPECT_THAT(refusal("m.yaml", "camera: hand\n"), HasSubstr("neither pairs nor points"));
  EXPECT_THAT(refusal("m.csv", "a,b\n1,2\n"), HasSubstr("hand_roll_deg"));
  EXPECT_THAT(refusal("m.csv", "robot_x,robot_y,robot_z,camera_x,camera_y,camera_z\n1,2,3\n"),
              AllOf(HasSubstr("m.csv:2"), HasSubstr("6 as in the header")));
  EXPECT_THAT(refusal("m.csv", "robot_x,robot_y,robot_z,camera_x,camera_y,camera_z\n1,2,3,x,5,6\n"),
              HasSubstr("column camera_x"));
}

TEST(CameraCalibrationText, HasPoseAndResiduals) {
  CameraCalibration calibration;
  calibration.X_AC = kQuarterTurn;
  calibration.rms_position = 0.5e-3;
  calibration.used = 1;
  calibration.residuals = {{"a", 0.5e-3, 0.01, false}, {"b", 0.1, 0.2, true}};
  const std::string text = camera_calibration_text(calibration, CameraMount::kOnHand);
  EXPECT_THAT(text, AllOf(HasSubstr("camera: hand\n"), HasSubstr("target_in_base: "),
                          HasSubstr("pose: {xyz: [0.100000, -0.200000, 0.300000], rpy_deg: ["),
                          HasSubstr("rms_mm: 0.5000\n"), HasSubstr("mm: 100.0000"),
                          HasSubstr("outlier: true")));
  EXPECT_THAT(camera_calibration_text(calibration, {}),
              AllOf(testing::Not(HasSubstr("rms_deg")), testing::Not(HasSubstr("camera:"))));
}

}  // namespace
}  // namespace handway::geometric
