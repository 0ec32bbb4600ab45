#include "command_line.h"
#include "handway_test/paths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace handway::test {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

namespace fs = std::filesystem;

std::string shipped(const std::string& robot) {
  return (source_dir() / "resources/robots" / robot / (robot + ".urdf")).string();
}

struct Arm {
  std::string file;
  std::string link;  ///< It carries the hand, …
  bool along_x;      ///< … along its x axis, else along z.
  std::string goal;  ///< The hand is level then, …
  double x;          ///< … and its mount there, m.
  double z;
};

struct Hand {
  std::string file;
  double offset;  ///< From the arm's link to the hand's root, m.
  double length;  ///< From the mount to the fingertips, m.
};

std::string mount_pose(const Arm& arm, const Hand& hand) {
  const std::string offset = std::to_string(hand.offset);
  return arm.along_x ? "{xyz: [" + offset + ", 0, 0], rpy_deg: [0, 90, 0]}"
                     : "{xyz: [0, 0, " + offset + "]}";
}

/// A can on a table in front of the hand at the goal, and a bar between the upright arm and it.
std::string reach(const Arm& arm, const Hand& hand) {
  const auto box = [](const std::string& name, const std::string& size, double x, double z) {
    return "  - {name: " + name + ", box: {size: " + size + "}, pose: {xyz: [" + std::to_string(x) +
           ", 0, " + std::to_string(z) + "]}}\n";
  };
  const double x_can = arm.x + hand.length + 0.06;
  return "handway: 1\nrobots:\n  - {name: arm, model: " + arm.file +
         "}\n  - {name: hand, model: " + hand.file + ", mount: {robot: arm, link: " + arm.link +
         ", pose: " + mount_pose(arm, hand) + "}}\nobjects:\n" +
         box("table", "[0.4, 1.2, 0.05]", x_can + 0.1, arm.z - 0.145) +
         "  - {name: can, cylinder: {radius: 0.033, length: 0.24}, pose: {xyz: [" +
         std::to_string(x_can) + ", 0, " + std::to_string(arm.z) + "]}}\n" +
         box("bar", "[0.05, 0.5, 0.05]", arm.x, 1.0) + "start: {}\ngoal: " + arm.goal + "\n";
}

TEST(MountedRobots, PlanAReachToACanWithEveryPairOfArmAndHand) {
  HANDWAY_NEED_REFERENCE(reference);
  const fs::path robots = reference / "robots";
  const std::vector<Arm> arms = {{(robots / "iiwa14/iiwa14.urdf").string(), "ee_link", true,
                                  "{A2: 0.7, A4: -1.57, A6: -0.7}", 0.7, 0.425},
                                 {shipped("tx90"), "flange_link", false,
                                  "{joint_2: 0.7, joint_3: 1.57, joint_5: -0.7}", 0.75, 0.53}};
  const std::vector<Hand> hands = {
      {(robots / "allegro_hand/allegro_hand_right.urdf").string(), 0.1, 0.25},
      {(robots / "shadow_hand/shadow_hand_right.urdf").string(), 0.0, 0.45},
      {shipped("sah_right"), 0.0, 0.3}};
  const CommandLine line;
  for (const Arm& arm : arms) {
    for (const Hand& hand : hands) {
      line.write("reach.yaml", reach(arm, hand));
      const Outcome plan = line.run("plan reach.yaml --out path.csv --time-limit 60");
      EXPECT_EQ(plan.exit_code, 0) << arm.file << '\n' << hand.file << '\n' << plan.err;
      const Outcome check = line.run("check reach.yaml path.csv");
      EXPECT_EQ(check.exit_code, 0) << check.out << check.err;
      EXPECT_THAT(check.out, HasSubstr("valid"));
      EXPECT_THAT(plan.err, Not(HasSubstr("overlap in every posture")));
    }
  }
}

TEST(MountedRobots, AreWrittenAsOneRobotThatPlansTheSame) {
  const CommandLine line;
  const std::string scene = reach({shipped("tx90"), "flange_link", false,
                                   "{joint_2: 0.7, joint_3: 1.57, joint_5: -0.7}", 0.75, 0.53},
                                  {shipped("sah_right"), 0.0, 0.3});
  line.write("reach.yaml", scene);
  const Outcome setup = line.run("setup reach.yaml --out one.urdf --samples 500");
  EXPECT_EQ(setup.exit_code, 0) << setup.err;
  EXPECT_THAT(setup.out, AllOf(HasSubstr("group arm: joint_1"), HasSubstr("group hand: thumb_base"),
                               HasSubstr("end effector hand: group hand on flange_link")));
  std::string again = scene.substr(0, scene.find("  - {name: arm")) + "  - model: one.urdf\n" +
                      scene.substr(scene.find("objects:"));
  line.write("again.yaml", again);
  EXPECT_EQ(line.run("plan reach.yaml --out path.csv").exit_code, 0);
  const Outcome check = line.run("check again.yaml path.csv");
  EXPECT_EQ(check.exit_code, 0) << check.out << check.err;
}

TEST(Setup, WritesAnSrdfWithGroupsAndSampledPairs) {
  const CommandLine line;
  fs::create_directory_symlink(source_dir() / "resources/robots/sah_right/meshes",
                               line.folder() / "meshes");
  fs::copy_file(shipped("sah_right"), line.folder() / "hand.urdf");
  EXPECT_THAT(line.run("info hand.urdf").out, HasSubstr("no SRDF disables collisions"));
  const Outcome setup = line.run("setup hand.urdf -o hand.srdf --samples 300 --json");
  ASSERT_EQ(setup.exit_code, 0) << setup.err;
  const auto report = nlohmann::json::parse(setup.out);
  EXPECT_EQ(report["palm"], "palm");
  EXPECT_EQ(report["fingertips"].size(), 4U);
  EXPECT_EQ(report["samples"], 300);
  EXPECT_THAT(line.read("hand.srdf"),
              AllOf(HasSubstr("<group name=\"hand\">"), HasSubstr("reason=\"Never\""),
                    HasSubstr("<end_effector name=\"hand\"")));
  EXPECT_THAT(line.run("info hand.urdf").out, Not(HasSubstr("no SRDF")));
}

TEST(Setup, AsksWhoseTheWristIs) {
  HANDWAY_NEED_REFERENCE(reference);
  const CommandLine line;
  const std::string shadow =
      (reference / "robots/shadow_hand/shadow_hand_right.urdf").string() + " --samples 50";
  EXPECT_THAT(line.run("setup " + shadow).out,
              AllOf(HasSubstr("suspicious: WRJ2, WRJ1 lead to the palm (palm)"),
                    HasSubstr("palm: palm\nfingertips: fftip, mftip, rftip, lftip, thtip\n")));
  const auto of_arm = nlohmann::json::parse(line.run("setup --json --wrist arm " + shadow).out);
  EXPECT_THAT(of_arm["groups"]["arm"], ElementsAre("WRJ2", "WRJ1"));
  EXPECT_EQ(of_arm["groups"]["hand"].size(), 22U);
  const auto of_hand = nlohmann::json::parse(line.run("setup --json --wrist hand " + shadow).out);
  EXPECT_EQ(of_hand["groups"]["hand"].size(), 24U);
  EXPECT_FALSE(of_hand["groups"].contains("arm"));
}

TEST(Setup, RefusesToWriteWhatIsNoRobotFile) {
  const CommandLine line;
  const Outcome setup = line.run("setup " + shipped("tx90") + " --samples 1 --out tx90.txt");
  EXPECT_EQ(setup.exit_code, 3);
  EXPECT_THAT(setup.err, HasSubstr("NAME.srdf"));
}

}  // namespace
}  // namespace handway::test
