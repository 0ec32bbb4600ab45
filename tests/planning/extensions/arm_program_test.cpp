#include "handway/planning/extensions/arm_program.h"

#include "handway_test/input_errors.h"
#include "handway_test/motions.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <variant>
#include <vector>

namespace handway::planning {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using testing::StartsWith;

const Motion& motion() {
  static const Motion kMotion = test::tx90_sah_motion(false, 0.5);
  return kMotion;
}

/// A word for each instruction: "move 1", "wait", "wait more", "output 3 on", or the comment.
std::vector<std::string> words(const std::vector<ArmInstruction>& instructions) {
  std::vector<std::string> all;
  for (const ArmInstruction& instruction : instructions) {
    if (const auto* move = std::get_if<ArmMove>(&instruction)) {
      all.push_back("move " + std::to_string(move->point));
    } else if (const auto* wait = std::get_if<ArmWait>(&instruction)) {
      all.emplace_back(wait->rests ? "rest" : wait->is_waypoint ? "wait" : "wait more");
    } else if (const auto* output = std::get_if<GripperOutput>(&instruction)) {
      all.push_back("output " + std::to_string(output->number) + (output->closes ? " on" : " off"));
    } else if (const auto* set = std::get_if<ArmOutput>(&instruction)) {
      all.push_back("set " + set->output.name);
    } else {
      all.push_back(std::get<ArmComment>(instruction).text);
    }
  }
  return all;
}

TEST(ArmInstructions, WaitWhileTheHandMovesAlone) {
  EXPECT_THAT(words(arm_instructions(motion(), {})),
              ElementsAre("hand: see wave_hand_targets.csv", "move 1", "wait", "move 3"));
}

TEST(ArmInstructions, NameStagesAndTheObject) {
  EXPECT_THAT(words(arm_instructions(test::with_stages(motion()), {})),
              ElementsAre("stage: approach (pick can)", "move 1", "stage: close (pick can)",
                          "hand: closes, see wave_hand_targets.csv", "wait", "attach: can",
                          "stage: lift (pick can)", "move 3"));
}

TEST(ArmInstructions, SetAnOutputForTheHand) {
  Motion staged = test::with_stages(motion());
  const double pause = staged.waypoint_times[2] - staged.waypoint_times[1];
  const ExportOptions options{.gripper_output = 3, .gripper_time = pause + 0.2};
  const auto instructions = arm_instructions(staged, options);
  EXPECT_THAT(
      words(instructions),
      ElementsAre("stage: approach (pick can)", "move 1", "stage: close (pick can)", "output 3 on",
                  "wait", "wait more", "attach: can", "stage: lift (pick can)", "move 3"));
  EXPECT_NEAR(std::get<ArmWait>(instructions[5]).duration, 0.2, 1e-12);
  staged.stages[1].hand = HandAction::kOpen;
  EXPECT_THAT(
      words(arm_instructions(staged, {.gripper_output = 3, .gripper_time = 0.0})),
      ElementsAre("stage: approach (pick can)", "move 1", "stage: close (pick can)", "detach: can",
                  "output 3 off", "wait", "stage: lift (pick can)", "move 3"));
}

TEST(ArmInstructions, SetOutputsAndRest) {
  const auto instructions = arm_instructions(
      test::with_outputs_and_wait(test::with_stages(motion()), {{"do3"}}, 2.0), {});
  EXPECT_THAT(words(instructions),
              ElementsAre("stage: approach (pick can)", "move 1", "stage: close (pick can)",
                          "hand: closes, see wave_hand_targets.csv", "wait", "attach: can",
                          "stage: lift (pick can)", "move 3", "stage: output (set do3 to true)",
                          "set do3", "stage: wait (wait)", "rest"));
  EXPECT_NEAR(std::get<ArmWait>(instructions.back()).duration, 2.0, 1e-9);
}

TEST(OutputNumber, IsTheEndOfTheName) {
  EXPECT_EQ(output_number("do3"), 3);
  EXPECT_EQ(output_number("12"), 12);
  EXPECT_EQ(output_number("$OUT[17]"), 17);
  for (const char* name : {"", "gripper", "do3b", "do12345", "[]"}) {
    EXPECT_EQ(output_number(name), std::nullopt) << name;
  }
}

TEST(ArmInstructions, HaveNamesWithoutLineEnds) {
  Motion staged = test::with_stages(motion());
  staged.stages[0].step = "pick \"a\nb\"";
  EXPECT_EQ(words(arm_instructions(staged, {}))[0], "stage: approach (pick ?a?b?)");
}

TEST(HandTargets, HaveARowForEveryWaypointAndTheHold) {
  const Motion staged = test::with_stages(motion());
  const std::vector<ExportedFile> files = hand_target_files(staged, {});
  ASSERT_THAT(files, SizeIs(1));
  EXPECT_EQ(files[0].name, "wave_hand_targets.csv");
  std::vector<std::string> starts;
  std::istringstream lines(files[0].content);
  std::string line;
  std::getline(lines, line);
  EXPECT_THAT(line, StartsWith("move,time,stage,"));
  while (std::getline(lines, line)) {
    const std::size_t stage = line.find(',', line.find(',') + 1) + 1;
    starts.push_back(line.substr(0, line.find(',')) + " " +
                     line.substr(stage, line.find(',', stage) - stage));
  }
  EXPECT_THAT(starts, ElementsAre("0 approach", "1 approach", "2 close", "2 hold", "3 lift"));
  EXPECT_THAT(hand_target_files(staged, {.gripper_output = 1}), IsEmpty());
  Motion arm_alone = staged;
  arm_alone.hand.clear();
  EXPECT_THAT(hand_target_files(arm_alone, {}), IsEmpty());
}

TEST(RequireArm, NamesWhatIsWrong) {
  const auto refusal = [](const Motion& bad, const ArmRequirements& required) {
    return test::refusal_of([&] { require_arm(bad, required); });
  };
  EXPECT_NO_THROW(require_arm(motion(), {.language = "KRL"}));
  EXPECT_THAT(refusal(motion(), {.language = "KRL", .joints = 7, .advice = "Buy one"}),
              AllOf(HasSubstr("6 joints"), HasSubstr("7 revolute joints"), HasSubstr("Buy one")));
  Motion turned = motion();
  std::swap(turned.arm[0], turned.arm[1]);
  EXPECT_THAT(refusal(turned, {.language = "KRL"}), HasSubstr("joint_1 on another branch"));
  Motion handless = motion();
  handless.hand.clear();
  EXPECT_THAT(refusal(handless, {.language = "KRL"}), HasSubstr("neither of the arm nor"));
}

TEST(RequireArm, RefusesPrismaticJoints) {
  Motion sliding = motion();
  geometric::RobotDescription description = sliding.model->description();
  for (geometric::Joint& joint : description.joints) {
    if (joint.name == "joint_2") {
      joint.type = geometric::JointType::kPrismatic;
    }
  }
  sliding.model = std::make_shared<const geometric::RobotModel>(description);
  EXPECT_THAT(test::refusal_of([&] { require_arm(sliding, {.language = "KRL"}); }),
              HasSubstr("the prismatic joint joint_2"));
}

}  // namespace
}  // namespace handway::planning
