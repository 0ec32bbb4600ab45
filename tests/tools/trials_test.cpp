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
  std::string arguments;  ///< Of `handway`.
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
    {"06", "plan hair.yaml", 0, {}, {"warning"}},
    {"06", "plan micron.yaml", 0, {}, {"warning"}},
    {"06", "plan f32.yaml", 0, {}, {"warning"}},
    {"06", "plan f32goal.yaml", 0, {}},
    {"06", "plan lib.yaml", 0, {}},
    {"06", "plan back.yaml", 0, {}},
    {"06", "plan ff.yaml", 4, {"-0.0009 m", "0.9 mm beyond", "lift +0.9 mm"}},
    // What the group leaves alone need not be within its limits.
    {"07", "plan scene.yaml", 0, {"joint gripper at -0.2467", "not of the group"}},
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
    // What samples miss.
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
