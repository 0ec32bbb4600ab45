#include "handway/planning/extensions/arm_program.h"

#include "handway/geometric/io/input_error.h"
#include "handway/planning/extensions/program_text.h"
#include "handway/planning/paths/path_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <regex>
#include <string>
#include <utility>

namespace handway::planning {
namespace {

using geometric::InputError;
using geometric::JointType;

[[noreturn]] void refuse_arm(const Motion& motion, const ArmRequirements& required,
                             const std::string& found) {
  throw InputError({"robot " + motion.model->name(), "", found,
                    fmt::format("an arm of {} revolute joints from the base to the flange for {}",
                                required.joints, required.language),
                    required.advice.empty() ? "The group \"arm\" of the SRDF file names them"
                                            : required.advice});
}

bool is_below(const geometric::RobotModel& model, int link, int ancestor) {
  while (link > ancestor) {
    link = model.parent(link);
  }
  return link == ancestor;
}

bool moves(const Motion& motion, int variable) {
  const auto& waypoints = motion.path.waypoints;
  return std::ranges::any_of(waypoints, [&](const geometric::Configuration& q) {
    return q[variable] != waypoints.front()[variable];
  });
}

bool hand_moves(const Motion& motion) {
  return std::ranges::any_of(motion.hand, [&](int v) { return moves(motion, v); });
}

void refuse_other_joints(const Motion& motion, const std::string& language) {
  for (int v = 0; v < motion.model->variable_count(); ++v) {
    const bool is_own = std::ranges::count(motion.arm, v) + std::ranges::count(motion.hand, v) > 0;
    if (!is_own && moves(motion, v)) {
      throw InputError({"robot " + motion.model->name(), "joint " + motion.model->variable(v).name,
                        "a joint that moves and is neither of the arm nor of the hand",
                        "a motion of the arm for " + language, ""});
    }
  }
}

std::string targets_file(const Motion& motion) { return motion.name + "_hand_targets.csv"; }

ArmComment comment(const std::string& text) { return {printable_line(text)}; }

/// Lists the instructions of one motion.
class InstructionList {
 public:
  InstructionList(const Motion& motion, const ExportOptions& options)
      : motion_(motion), options_(options), moves_(joint_moves(motion)) {}

  std::vector<ArmInstruction> make() {
    if (motion_.stages.empty()) {
      if (hand_moves(motion_)) {
        list_.emplace_back(comment("hand: see " + targets_file(motion_)));
      }
      add_moves(0, moves_.size(), false);
    }
    for (std::size_t i = 0; i < motion_.stages.size(); ++i) {
      const bool is_last = i + 1 == motion_.stages.size();
      add_stage(motion_.stages[i], is_last ? moves_.size() : motion_.stages[i + 1].first);
    }
    return std::move(list_);
  }

 private:
  void add_stage(const MotionStage& stage, std::size_t end) {
    list_.emplace_back(comment(stage.step.empty()
                                   ? "stage: " + stage.name
                                   : fmt::format("stage: {} ({})", stage.name, stage.step)));
    if (stage.hand == HandAction::kOpen && !stage.object.empty()) {
      list_.emplace_back(comment("detach: " + stage.object));
    }
    const bool drives = stage.hand != HandAction::kNone && options_.gripper_output.has_value();
    if (drives) {
      list_.emplace_back(GripperOutput{*options_.gripper_output, stage.hand == HandAction::kClose});
    } else if (stage.hand != HandAction::kNone) {
      list_.emplace_back(comment(fmt::format("hand: {}, see {}",
                                             stage.hand == HandAction::kClose ? "closes" : "opens",
                                             targets_file(motion_))));
    }
    if (stage.output) {
      list_.emplace_back(ArmOutput{*stage.output});
    }
    const double waited = add_moves(stage.first, end, stage.waits);
    if (drives && waited < options_.gripper_time) {
      list_.emplace_back(ArmWait{options_.gripper_time - waited, false});
    }
    if (stage.hand == HandAction::kClose && !stage.object.empty()) {
      list_.emplace_back(comment("attach: " + stage.object));
    }
  }

  // Adds the moves from waypoint `first` to waypoint `end`. @param rests nothing moves.
  // @returns the time that the arm waits.
  double add_moves(std::size_t first, std::size_t end, bool rests) {
    double waited = 0.0;
    for (std::size_t i = first; i < end; ++i) {
      if (moves_[i].waits) {
        list_.emplace_back(ArmWait{moves_[i].duration, true, rests});
        waited += moves_[i].duration;
      } else {
        list_.emplace_back(ArmMove{i + 1, moves_[i]});
      }
    }
    return waited;
  }

  const Motion& motion_;
  const ExportOptions& options_;
  std::vector<JointMove> moves_;
  std::vector<ArmInstruction> list_;
};

// Returns the stage in which the motion goes to a waypoint; null without stages.
const MotionStage* stage_at(const Motion& motion, std::size_t waypoint) {
  const MotionStage* at = nullptr;
  for (const MotionStage& stage : motion.stages) {
    at = at == nullptr || stage.first < waypoint ? &stage : at;
  }
  return at;
}

std::string target_row(const Motion& motion, std::size_t waypoint, const std::string& stage,
                       const geometric::Configuration& q) {
  const Eigen::VectorXd hand = q(motion.hand);
  return fmt::format("{},{},{},{}\n", waypoint, csv_time(motion.waypoint_times[waypoint]), stage,
                     fmt::join(hand.begin(), hand.end(), ","));
}

}  // namespace

void require_arm(const Motion& motion, const ArmRequirements& required) {
  const geometric::RobotModel& model = *motion.model;
  if (motion.arm.size() != required.joints) {
    refuse_arm(motion, required, fmt::format("an arm of {} joints", motion.arm.size()));
  }
  int before = 0;
  for (const int v : motion.arm) {
    const geometric::Joint& joint = model.variable(v);
    if (joint.type == JointType::kPrismatic) {
      refuse_arm(motion, required, "the prismatic joint " + joint.name);
    }
    if (!is_below(model, model.variable_link(v), before)) {
      refuse_arm(motion, required, "the joint " + joint.name + " on another branch of the robot");
    }
    before = model.variable_link(v);
  }
  refuse_other_joints(motion, required.language);
}

bool is_robot_named(const Motion& motion, const std::string& pattern) {
  const std::regex regex(pattern, std::regex::ECMAScript | std::regex::icase);
  const geometric::RobotModel& model = *motion.model;
  std::vector<std::string> names{model.name(), model.description().file.filename().string()};
  for (const int v : motion.arm) {
    names.push_back(model.variable(v).child);
  }
  return std::ranges::any_of(
      names, [&](const std::string& name) { return std::regex_search(name, regex); });
}

std::vector<ArmInstruction> arm_instructions(const Motion& motion, const ExportOptions& options) {
  return InstructionList(motion, options).make();
}

std::optional<int> output_number(const std::string& name) {
  constexpr std::size_t kMostDigits = 4;
  const std::size_t end = name.find_last_not_of("])") + 1;
  std::size_t begin = end;
  while (begin > 0 && name[begin - 1] >= '0' && name[begin - 1] <= '9') {
    --begin;
  }
  if (begin == end || end - begin > kMostDigits) {
    return std::nullopt;
  }
  return std::stoi(name.substr(begin, end - begin));
}

std::string unset_output_comment(const geometric::OutputStep& output) {
  return printable_line(fmt::format("NOT SET: {} to {}", output.name, value_text(output)));
}

std::vector<std::string> program_heading(const Motion& motion) {
  return {printable_line(
              fmt::format("{}, a motion of {}, by Handway", motion.name, motion.model->name())),
          fmt::format("{} waypoints, {} s", motion.path.waypoints.size(),
                      fixed_decimals(motion.trajectory.duration(), 3))};
}

std::vector<ExportedFile> hand_target_files(const Motion& motion, const ExportOptions& options) {
  if (!hand_moves(motion) || options.gripper_output) {
    return {};
  }
  std::string text = "move,time,stage";
  for (const int v : motion.hand) {
    text += "," + motion.model->variable(v).name;
  }
  text += '\n';
  for (std::size_t w = 0; w < motion.path.waypoints.size(); ++w) {
    const MotionStage* stage = stage_at(motion, w);
    text += target_row(motion, w, stage ? stage->name : "", motion.path.waypoints[w]);
    const bool ends = stage && stage->squeezed.size() > 0 &&
                      (w + 1 == motion.path.waypoints.size() || stage_at(motion, w + 1) != stage);
    if (ends) {
      text += target_row(motion, w, "hold", stage->squeezed);
    }
  }
  return {{targets_file(motion), text}};
}

}  // namespace handway::planning
