#include "command_line.h"
#include "handway/geometric/formats/robot_loader.h"
#include "handway/geometric/robot/group_proposal.h"
#include "handway_test/paths.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace handway::test {
namespace {

namespace fs = std::filesystem;
using geometric::RobotModel;
using testing::HasSubstr;

struct Robot {
  std::string name;
  double length;  ///< Length of its links to the tip, m.
  bool is_hand;
};

double length_to(const RobotModel& model, int link) {
  double length = 0.0;
  for (; link > 0; link = model.parent(link)) {
    length += model.joint(link).X_PJ.translation().norm();
  }
  return length;
}

Robot examined(const std::string& name, const RobotModel& model) {
  const geometric::GroupProposal groups = geometric::propose_groups(model);
  const std::optional<int> tip = model.find_link(groups.tip);
  return {name, length_to(model, tip.value_or(0)), !groups.palm.empty()};
}

/// A can on a table beside the arm, as far away and high as suits its length.
struct Reach {
  double distance;
  double height;

  explicit Reach(const Robot& arm) : distance(0.5 * arm.length), height(0.4 * arm.length) {}

  [[nodiscard]] std::string scene(const Robot& arm, const Robot& hand) const {
    return fmt::format(
        "handway: 1\nrobots:\n  - {{name: arm, model: {}.urdf}}\n"
        "  - {{name: hand, model: {}.urdf, mount: {{robot: arm}}}}\nobjects:\n"
        "  - {{name: table, box: {{size: [0.3, 0.3, 0.02]}}, pose: {{xyz: [0, {}, {}]}}}}\n"
        "  - {{name: can, cylinder: {{radius: 0.033, length: 0.2}}, pose: {{xyz: [0, {}, {}]}}}}\n"
        "start: {{}}\n",
        arm.name, hand.name, distance, height - 0.111, distance, height);
  }

  /// Returns the goal of the hand, in any orientation, beside the can.
  [[nodiscard]] std::string goal() const {
    return fmt::format("--goal-pose 0,{},{}", distance - 0.15, height + 0.1);
  }
};

/// Row of a table about robots, to which commands are applied in turn.
class Row {
 public:
  Row(const CommandLine& folder, const std::string& name) : folder_(folder), name_(name) {}
  Row(const Row&) = delete;
  Row& operator=(const Row&) = delete;
  ~Row() { fmt::print("{:45}{}\n", name_, steps_); }

  Outcome run(const std::string& step, const std::string& arguments) {
    const Outcome outcome = folder_.run(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << name_ << ": " << arguments << '\n'
                                    << outcome.out << outcome.err;
    steps_ += fmt::format(" {:12}", outcome.exit_code == 0 ? step : "NOT " + step);
    return outcome;
  }

 private:
  const CommandLine& folder_;
  std::string name_;
  std::string steps_;
};

// Each robot with its SRDF in the folder.
std::vector<Robot> set_up(const CommandLine& folder, const fs::path& robots) {
  std::vector<Robot> found;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(robots)) {
    if (entry.path().extension() == ".urdf") {
      const std::string name = entry.path().stem().string();
      Row row(folder, name);
      row.run("read", "info \"" + entry.path().string() + '"');
      row.run("set up",
              "setup \"" + entry.path().string() + "\" --samples 2000 --out " + name + ".urdf");
      found.push_back(examined(name, *geometric::load_robot(folder.folder() / (name + ".urdf"))));
    }
  }
  std::ranges::sort(found, {}, &Robot::name);
  return found;
}

void plan_with(const CommandLine& folder, const Robot& arm, const Robot& hand) {
  const Reach reach(arm);
  folder.write("reach.yaml", reach.scene(arm, hand));
  Row row(folder, arm.name + " with " + hand.name);
  EXPECT_THAT(row.run("combined", "info reach.yaml").out, HasSubstr("start: free"));
  row.run("planned", "plan reach.yaml --out path.csv --time-limit 60 " + reach.goal());
  EXPECT_THAT(row.run("checked", "check reach.yaml path.csv " + reach.goal()).out,
              HasSubstr("valid:"));
}

TEST(ReferencePairs, PlanAReachToACanWithEveryArmAndHand) {
  HANDWAY_NEED_REFERENCE(reference);
  const CommandLine folder;
  const std::vector<Robot> robots = set_up(folder, reference / "robots");
  int pairs = 0;
  for (const Robot& arm : robots) {
    for (const Robot& hand : robots) {
      if (!arm.is_hand && hand.is_hand) {
        plan_with(folder, arm, hand);
        ++pairs;
      }
    }
  }
  EXPECT_GT(pairs, 0);
}

}  // namespace
}  // namespace handway::test
