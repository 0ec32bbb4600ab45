#include "task_steps.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/robot/inverse_kinematics.h"
#include "handway/planning/edits/scene_edits.h"

#include <fmt/format.h>

#include <numeric>
#include <string>
#include <variant>

namespace handway::planning {
namespace {

// Returns the number of steps that one takes in the task, with its alternatives.
std::size_t length_of(const TaskStep& step) {
  const auto* first_of = std::get_if<FirstOfStep>(&step);
  return 1 + (first_of ? std::accumulate(first_of->lengths.begin(), first_of->lengths.end(),
                                         std::size_t{0})
                       : 0);
}

// Returns the steps from `begin` to before `end`, without those of alternatives.
Steps steps_between(const Task& task, std::size_t begin, std::size_t end) {
  Steps steps;
  for (std::size_t step = begin; step < end; step += length_of(task[step])) {
    steps.push_back(step);
  }
  return steps;
}

[[noreturn]] void refuse(const std::string& step, const std::string& found,
                         const std::string& expected, const std::string& advice = "") {
  throw geometric::InputError({"task", step, found, expected, advice});
}

/// Follows the steps of a task, and what the hand carries.
class StepCheck {
 public:
  StepCheck(const geometric::Scene& scene, const Task& task) : scene_(scene), task_(task) {}

  // Returns what the hand carries after these steps; empty: nothing.
  std::string carried_after(const Steps& steps, std::string carried) {
    for (const std::size_t step : steps) {
      step_ = to_string(task_[step]);
      carried_ = std::move(carried);
      carried = std::holds_alternative<FirstOfStep>(task_[step]) ? carried_after_one_of(step)
                                                                 : std::visit(*this, task_[step]);
    }
    return carried;
  }

  std::string operator()(const PickStep& pick) const {
    need_object(scene_, pick.object);
    if (!carried_.empty()) {
      refuse(step_, "a hand that carries " + carried_, "an empty hand",
             "Place what it carries first");
    }
    return pick.object;
  }
  std::string operator()(const PlaceStep& place) const {
    for (const std::string& support : place.supports) {
      need_support(support);
    }
    if (carried_.empty()) {
      refuse(step_, "an empty hand", "an object that a step before has picked",
             "Pick an object first");
    }
    return "";
  }
  std::string operator()(const MoveStep& /*move*/) const { return carried_; }
  std::string operator()(const PoseStep& move) const {
    const geometric::RobotInstance& robot = scene_.robots.front();
    const auto link = robot.model->find_link(move.goal.link);
    if (!link || geometric::chain_variables(*robot.model, *link).empty()) {
      refuse(step_, "the link \"" + move.goal.link + "\"",
             "a link of " + robot.name + " that joints move");
    }
    const geometric::NamedFrame* tool = geometric::find_frame(scene_, move.goal.tool);
    if (!move.goal.tool.empty() && !(tool && tool->parent == move.goal.link)) {
      refuse(step_, "the tool \"" + move.goal.tool + "\"", "a frame on the link " + move.goal.link);
    }
    need_standing(move.goal.reference);
    return carried_;
  }
  std::string operator()(const LineStep& line) const {
    if (line.reference != geometric::kPalmAxes) {
      need_standing(line.reference);
    }
    return carried_;
  }
  std::string operator()(const WaitStep& /*wait*/) const { return carried_; }
  std::string operator()(const OutputStep& /*output*/) const { return carried_; }
  std::string operator()(const FirstOfStep& /*step*/) const { return carried_; }

 private:
  std::string carried_after_one_of(std::size_t step) {
    const std::string before = carried_;
    const std::string words = step_;
    std::vector<std::string> after;
    for (const Steps& steps : alternatives_of(task_, step)) {
      after.push_back(carried_after(steps, before));
    }
    for (const std::string& other : after) {
      if (other != after.front()) {
        const auto in_hand = [](const std::string& object) {
          return object.empty() ? "an empty hand" : object + " in the hand";
        };
        refuse(words, in_hand(after.front()) + " after one, " + in_hand(other) + " after another",
               "alternatives that end with the same in the hand");
      }
    }
    return after.empty() ? before : after.front();
  }

  // Refuses supports that are not there, or move with a link or with the carried object.
  void need_support(const std::string& support) const {
    const geometric::NamedFrame* frame = geometric::find_frame(scene_, support);
    if (!frame) {
      need_object(scene_, support);
    }
    if (!carried_.empty() && (frame ? frame->parent : support) == carried_) {
      refuse(
          "place",
          (frame ? "a frame on the object itself, \"" : "the object itself, \"") + support + "\"",
          "another object");
    }
    need_standing(support);
  }

  // Refuses names of nothing, and of what is attached to a link.
  void need_standing(const std::string& name) const {
    if (name.empty() || geometric::standing_pose(scene_, name)) {
      return;
    }
    const bool is_there =
        geometric::find_object(scene_, name) || geometric::find_frame(scene_, name);
    refuse(step_, "\"" + name + "\"" + (is_there ? ", which is attached to a link" : ""),
           "an object or a frame that stands in the world",
           is_there ? "" : geometric::advise_name(name, geometric::standing_names(scene_)));
  }

  const geometric::Scene& scene_;
  const Task& task_;
  std::string step_;     ///< Words for the step that is looked at.
  std::string carried_;  ///< The object in the hand before that step.
};

}  // namespace

Steps steps_of(const Task& task) { return steps_between(task, 0, task.size()); }

std::vector<Steps> alternatives_of(const Task& task, std::size_t step) {
  std::vector<Steps> alternatives;
  if (const auto* first_of = std::get_if<FirstOfStep>(&task[step])) {
    std::size_t begin = step + 1;
    for (const std::size_t length : first_of->lengths) {
      alternatives.push_back(steps_between(task, begin, begin + length));
      begin += length;
    }
  }
  return alternatives;
}

void check_steps(const geometric::Scene& scene, const Task& task) {
  if (scene.robots.empty()) {
    throw geometric::InputError({source_of(scene), "robots", "none", "a robot", ""});
  }
  if (task.empty()) {
    throw geometric::InputError({"task", "", "no steps", "at least one that is not disabled", ""});
  }
  static_cast<void>(StepCheck(scene, task).carried_after(steps_of(task), ""));
}

}  // namespace handway::planning
