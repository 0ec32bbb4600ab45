/// Small inputs of strangers with the right values beside them: see case.md of each in the
/// reference folder.
#include "command_line.h"
#include "handway_test/paths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

namespace handway::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

/// One run of the program in the folder of a trial, and what it has to leave.
struct Trial {
  std::string folder;     ///< Beginning of its name, with the number.
  std::string arguments;  ///< Arguments of `handway`.
  int exit_code;
  std::vector<std::string> has;  ///< In what it prints.
  std::vector<std::string> lacks = {};
};

const std::vector<Trial> kTrials{
    // A continuous joint that is recorded within ±π goes the short way round.
    {"01",
     "time recorded.csv --scene free.yaml --no-blend",
     0,
     {"joint pan jumps by -356° after waypoint 2", "cleared"}},
    {"01", "check free.yaml recorded.csv", 0, {"valid"}},
    {"01", "plan free2.yaml", 0, {}},
    // Limits of positions beside the robot, and in a file of its own.
    {"04", "time line.csv --scene scene.yaml --limits msa_default.yaml", 0, {"cleared: ", "1.75"}},
    {"04", "time line.csv --scene scene.yaml --limits zero_acc.yaml", 3, {"max_acceleration"}},
    {"04", "time line.csv --scene scene.yaml --limits positions.yaml", 1, {"lift", "0.400000"}},
    {"04", "time line.csv --scene scene.yaml --limits positions_noflag.yaml", 1, {"lift"}},
    {"04", "time line.csv --scene scene.yaml --limits param.yaml", 1, {"lift"}},
    {"04", "time line.csv --scene scene.yaml --limits deg.yaml", 1, {"lift", "0.349066"}},
    {"04", "time line.csv --scene scene.yaml --limits wide.yaml", 0, {"cleared"}},
    {"04", "time line.csv --scene scene.yaml --limits typo.yaml", 3, {"min_positon"}},
    {"04", "plan beside/scene.yaml", 4, {"lift", "allowed -0.4000 to 0.4000"}},
    {"04", "check beside/scene.yaml beside/line.csv", 1, {"lift"}},
    // Limits up to rounding; slides in their own unit.
    {"06", "plan hair.yaml", 0, {}, {"The start has"}},
    {"06", "plan micron.yaml", 0, {}, {"The start has"}},
    {"06", "plan f32.yaml", 0, {}, {"The start has"}},
    {"06", "plan f32goal.yaml", 0, {}},
    {"06", "plan lib.yaml", 0, {}},
    {"06", "plan back.yaml", 0, {}},
    {"06", "plan ff.yaml", 4, {"-0.0009 m", "0.9 mm beyond", "lift +0.9 mm"}},
    // Joints outside of the group need not be within their limits.
    {"07", "plan scene.yaml", 0, {"joint gripper at -0.2467", "not in the group"}},
    // Soft limits.
    {"08", "info soft.urdf", 0, {"-18.49", "57.30"}},
    {"08", "plan soft.yaml", 4, {"lift", "allowed -0.3227 to 1.0000"}},
    {"08", "info zeros.urdf", 0, {"114.59"}},
    // Round shapes to a tenth of a millimetre.
    {"09", "info capsule_a.yaml", 0, {"at 199.9"}},
    {"09", "info capsule_c.yaml", 0, {"at 99.9"}},
    {"09", "info capsule_d.yaml", 0, {"IN COLLISION"}},
    {"09", "info cyl_par.yaml", 0, {}, {"IN COLLISION"}},
    {"09", "info cyl_t070.yaml", 0, {"at 0.6"}},
    {"09", "info cyl_t080.yaml", 0, {"IN COLLISION"}},
    // MoveIt's messages.
    {"11", "info scene_echo.yaml", 0, {"box1"}, {"identity", "normalised"}},
    {"11", "info scene_zeroquat.yaml", 0, {"box1", "taken for the identity"}},
    {"11", "info scene_w2.yaml", 0, {"box1", "normalised"}},
    {"11", "info scene_unnorm.yaml", 0, {"box1"}},
    {"11", "info scene_removed.yaml", 0, {"box1"}, {"gone"}},
    {"13", "plan n/request0001.yaml", 4, {"lower", "cup", "touch_links"}},
    // A cell around the robot.
    {"15", "plan cell.yaml", 4, {"inside of cell", "solid: false", "--hollow cell"}},
    {"15", "plan cell.yaml --hollow cell", 0, {}},
    {"15", "plan cell_hollow.yaml", 0, {}},
    {"15", "plan cell.yaml --hollow sell", 3, {"Did you mean \"cell\"?"}},
    // Meshes that are none.
    {"18", "info pointer.yaml", 3, {"Git LFS pointer", "git lfs pull"}},
    {"18", "info lfs_robot.urdf", 3, {"Git LFS pointer", "git lfs pull"}},
    {"18", "info html.yaml", 3, {"a web page"}},
    {"18", "info empty.yaml", 3, {"an empty file"}},
    {"18", "info count_wrong.yaml", 3, {"triangles, in a file with room for 12"}},
    {"18", "info ascii_upper.yaml", 0, {"thing"}},
    {"18", "info ascii_crlf.yaml", 0, {"thing"}},
    {"18", "info solid_binary.yaml", 0, {"thing"}},
    {"19", "info urdf/rail.urdf", 0, {"where <mujoco><compiler meshdir="}},
    {"19", "info urdf2/rail.urdf", 0, {"where <mujoco><compiler meshdir="}},
    // Times.
    {"24", "pca seconds.csv", 0, {"300 rows", "5.0 s at 60.0 Hz"}},
    {"24", "pca pandas_index.csv", 0, {"300 rows", "5.0 s at 60.0 Hz"}},
    {"24", "pca epoch_s.csv", 0, {"300 rows", "5.0 s at 60.0 Hz"}},
    {"24", "pca epoch_ms.csv", 0, {"300 rows", "5.0 s at 60.0 Hz", "ms since 1970"}},
    {"24", "pca epoch_ns.csv", 0, {"300 rows", "5.0 s at 60.0 Hz", "ns since 1970"}},
    {"24", "pca ms_named.csv", 0, {"300 rows", "5.0 s at 60.0 Hz"}},
    {"24", "pca iso.csv", 0, {"300 rows", "5.0 s at 60.0 Hz"}, {"passed over"}},
    {"24", "pca iso_space.csv", 0, {"300 rows", "5.0 s at 60.0 Hz"}, {"passed over"}},
    {"24", "pca clock.csv", 0, {"300 rows", "5.0 s at 60.0 Hz"}, {"passed over"}},
    {"24", "pca date_time.csv", 0, {"300 rows", "5.0 s at 60.0 Hz"}, {"passed over"}},
    {"24", "pca german.csv", 0, {"300 rows", "5.0 s at 60.0 Hz"}, {"passed over"}},
    {"24", "pca quoted_comma.csv", 0, {"300 rows", "5.0 s at 60.0 Hz"}},
    {"24", "pca epoch_ns.csv --resample 30", 0, {"300 rows"}},
    {"24", "pca seconds.csv --resample 1e12", 3, {"rows at 1e+12 Hz", "at most 5000000 rows"}},
    {"25", "pca truth.csv --joints-of leap_class_right", 0, {"39.67   69.19   81.48"}},
    {"25", "pca lists.csv --joints-of leap_class_right", 0, {"39.67   69.19   81.48"}},
    {"25", "pca rostopic_p.csv --joints-of leap_class_right", 0, {"39.67   69.19   81.48"}},
    {"25", "pca plotjuggler.csv --joints-of leap_class_right", 0, {"39.67   69.19   81.48"}},
    {"25", "pca degrees.csv --joints-of leap_class_right", 0, {"39.67   69.19   81.48"}},
    {"26", "pca ntp.csv", 0, {"300 rows", "time runs back by"}},
    {"27", "check scene.yaml degrees.csv", 3, {"look like degrees"}},
    {"27", "check scene.yaml lerobot_deg.csv", 3, {"look like degrees"}},
    {"27", "check scene.yaml lerobot.csv", 0, {"valid"}},
    {"27", "check scene.yaml v1.csv", 0, {"valid"}},
    {"27", "check scene.yaml v2.csv", 0, {"valid"}},
    {"27", "check scene.yaml v3.csv", 0, {"valid"}},
    {"27", "check scene.yaml v4.csv", 0, {"valid"}},
    {"27", "check scene.yaml v5.csv", 0, {"valid"}},
    {"27", "check scene.yaml v6.yaml", 0, {"valid"}},
    {"27", "check scene.yaml v7.csv", 0, {"valid", "battery, gripper_left"}},
    {"29", "pca right_labelled_left.jsonl --fingertips", 0, {"taken for a right one"}},
    {"29", "pca left_labelled_right.jsonl", 0, {"taken for a left one"}},
    {"29", "pca right_right.jsonl", 0, {}, {"taken for a"}},
    {"29", "pca left_left.jsonl", 0, {}, {"taken for a"}},
    {"30", "pca eight.csv", 0, {"8 different rows for 12 joints"}},
    {"30", "pca same.csv --out basis.yaml", 3, {"equal rows"}},
    {"30", "pca spike.csv", 3, {"spike.csv:", "4000"}},
    // Samples miss this.
    {"16", "check foil.yaml through.csv", 1, {"NOT VALID"}},
    {"16", "check needle.yaml needle.csv", 1, {"NOT VALID"}},
    // Robots without collision geometry.
    {"23", "info s.yaml", 0, {}},
    {"23", "plan s.yaml --out p.csv", 0, {}},
    {"23", "plan so.yaml", 0, {}},
    {"23", "plan a.yaml", 0, {}},
};

class Trials : public testing::TestWithParam<Trial> {};

TEST_P(Trials, HaveTheirRightValues) {
  const Trial& trial = GetParam();
  HANDWAY_NEED_REFERENCE(reference);
  fs::path folder;
  for (const fs::directory_entry& entry : fs::directory_iterator(reference / "trials")) {
    if (entry.path().filename().string().starts_with(trial.folder + "-")) {
      folder = entry.path();
    }
  }
  ASSERT_FALSE(folder.empty()) << trial.folder;
  const CommandLine handway;
  copy_folder(folder, handway.folder() / "trial");
  const Outcome outcome = handway.run(trial.arguments, "trial");
  const std::string said = outcome.out + outcome.err;
  EXPECT_EQ(outcome.exit_code, trial.exit_code) << trial.arguments << "\n" << said;
  for (const std::string& text : trial.has) {
    EXPECT_THAT(said, HasSubstr(text)) << trial.arguments;
  }
  for (const std::string& text : trial.lacks) {
    EXPECT_THAT(said, Not(HasSubstr(text))) << trial.arguments;
  }
}

INSTANTIATE_TEST_SUITE_P(Strangers, Trials, testing::ValuesIn(kTrials), [](const auto& one) {
  return "Number" + one.param.folder + "Run" + std::to_string(one.index);
});

}  // namespace
}  // namespace handway::test
