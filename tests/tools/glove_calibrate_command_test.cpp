/// `handway glove generate`, `handway glove calibrate` and `handway glove map`.
#include "command_line.h"
#include "handway/device/glove/glove_calibration.h"
#include "handway/device/glove/human_hand.h"
#include "handway/device/glove/landmark_line.h"
#include "handway/device/glove/recording.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

namespace handway::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string held(int index_knuckle, int index_middle) {
  const std::string row =
      ',' + std::to_string(index_knuckle) + ',' + std::to_string(index_middle) + '\n';
  return "time,g,h\n0" + row + "0.01" + row + "0.02" + row;
}

class GloveCalibrate : public testing::Test {
 protected:
  GloveCalibrate() {
    line_.write("flat.csv", held(80, 40));
    line_.write("angle.csv", held(180, 42));
    line_.write("hook.csv", held(82, 140));
  }

  CommandLine line_;
};

TEST_F(GloveCalibrate, FitsPosesAndTakesTheRestFromAFreeMotion) {
  ASSERT_EQ(line_.run("glove generate --samples 3000 --seed 4 --out free.csv").exit_code, 0);
  EXPECT_EQ(device::read_recording(line_.folder() / "free.csv").times.size(), 3000);
  const Outcome run = line_.run(
      "glove calibrate --pose flat=flat.csv --pose right_angle=angle.csv --pose "
      "hook=hook.csv --free free.csv --person Ada --out hand.yaml");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("IndexMPJ"));
  const device::GloveCalibration calibration =
      device::read_calibration(line_.folder() / "hand.yaml");
  EXPECT_EQ(calibration.person, "Ada");
  ASSERT_TRUE(calibration.sensors[4] && calibration.sensors[11]);
  EXPECT_NEAR(calibration.sensors[4]->gain, 1.5708 / 99, 1e-3);
  EXPECT_TRUE(calibration.sensors[4]->residual);
  EXPECT_FALSE(calibration.sensors[11]->residual);
  EXPECT_EQ(line_.run("pca free.csv --calibration hand.yaml").exit_code, 0);
}

std::string landmark_rows() {
  const device::HandBones bones = device::typical_bones(0.17);
  std::string text;
  for (int row = 0; row < 100; ++row) {
    device::GloveAngles angles;
    angles.angles.fill(0.0);
    angles.angles.at(static_cast<std::size_t>(*device::find_sensor("IndexMPJ"))) = 0.012 * row;
    text +=
        device::write_landmark_line({0.03 * row, false, device::hand_landmarks(angles, bones)}) +
        '\n';
  }
  return text;
}

TEST(PersonOfLandmarks, HasRangesAndBonesThatPcaTakes) {
  const CommandLine line;
  line.write("ada.jsonl", landmark_rows());
  const Outcome run = line.run(
      "glove calibrate --free ada.jsonl --bones ring=80,45,30,20 --person Ada --out a.yaml");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, AllOf(HasSubstr("range"), HasSubstr("bones")));
  const device::GloveCalibration person = device::read_calibration(line.folder() / "a.yaml");
  ASSERT_TRUE(person.ranges[4] && person.bones);
  EXPECT_NEAR(person.ranges[4]->second, 1.188, 0.03);
  EXPECT_NEAR(person.bones->at(1)[1], device::typical_bones(0.17).at(1)[1], 1e-4);
  EXPECT_NEAR(person.bones->at(3)[2], 0.030, 1e-6);
  line.write("retarget.yaml", "hand: sah_right\nretargeting:\n  self_collision: false\n");
  const std::string retarget = "pca ada.jsonl --mapping retarget.yaml --fingertips";
  const Outcome typical = line.run(retarget);
  const Outcome own = line.run(retarget + " --calibration a.yaml");
  EXPECT_EQ(own.exit_code, 0) << own.err;
  EXPECT_NE(own.out, typical.out) << "the person's bones count";
  const std::string mapped = "pca ada.jsonl --fingertips";
  EXPECT_NE(line.run(mapped + " --calibration a.yaml").out, line.run(mapped).out);
  EXPECT_EQ(line.run("glove calibrate --bones rng=1,2,3,4").exit_code, 2);
  EXPECT_EQ(line.run("glove calibrate --bones ring=1,2,3").exit_code, 2);
  EXPECT_EQ(line.run("glove calibrate --hand-length 170 --out b.yaml").exit_code, 0);
  EXPECT_NEAR(device::read_calibration(line.folder() / "b.yaml").bones->at(1)[1],
              device::typical_bones(0.17).at(1)[1], 1e-4);
}

TEST(GloveMap, ProposesAMappingThatPcaTakes) {
  const CommandLine line;
  ASSERT_EQ(line.run("glove generate --samples 1000 --out hand.csv").exit_code, 0);
  const Outcome map = line.run("glove map shadow_class_right --fit hand.csv --out map.yaml");
  EXPECT_EQ(map.exit_code, 0) << map.err;
  EXPECT_THAT(map.out, AllOf(HasSubstr("index_proximal"), HasSubstr("IndexMPJ")));
  const Outcome pca = line.run("pca hand.csv --mapping map.yaml --out basis.yaml");
  EXPECT_EQ(pca.exit_code, 0) << pca.err;
  EXPECT_EQ(line.run("glove map tx90").exit_code, 3) << "an arm has no fingers";
}

TEST(GloveMap, NamesAHandOfNoLibraryByItsFile) {
  const char* const reference = std::getenv("HANDWAY_REFERENCE_DIR");
  if (!reference) {
    GTEST_SKIP() << "no robots of others here";
  }
  const CommandLine line;
  const std::filesystem::path hand =
      std::filesystem::path(reference) / "robots/allegro_hand/allegro_hand_right.urdf";
  ASSERT_EQ(line.run("glove generate --samples 1000 --out hand.csv").exit_code, 0);
  EXPECT_EQ(line.run("glove map " + hand.string()).exit_code, 0);
  ASSERT_EQ(line.run("glove map " + hand.string() + " --out map.yaml").exit_code, 0);
  const Outcome pca = line.run("pca hand.csv --mapping map.yaml --out basis.yaml");
  EXPECT_EQ(pca.exit_code, 0) << pca.err;
}

TEST_F(GloveCalibrate, TellsWhatToAskFor) {
  const Outcome run = line_.run("glove calibrate --list");
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_THAT(run.out, AllOf(HasSubstr("flat"), HasSubstr("Lay the hand flat")));
}

TEST_F(GloveCalibrate, NamesWhatIsWrong) {
  EXPECT_EQ(line_.run("glove calibrate").exit_code, 2);
  EXPECT_EQ(line_.run("glove calibrate --pose flat").exit_code, 2);
  const Outcome unknown = line_.run("glove calibrate --pose falt=flat.csv");
  EXPECT_EQ(unknown.exit_code, 3);
  EXPECT_THAT(unknown.err, HasSubstr("flat"));
  line_.write("poses.yaml", "poses:\n  - {name: a, degrees: {IndxMPJ: 0}}\n");
  EXPECT_THAT(line_.run("glove calibrate --poses poses.yaml --list").err,
              AllOf(HasSubstr("poses.yaml:2"), HasSubstr("IndexMPJ")));
}

}  // namespace
}  // namespace handway::test
