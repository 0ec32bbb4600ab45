#include "moveit_problem.h"

#include "constraints.h"
#include "handway/geometric/formats/robot_loader.h"
#include "handway/geometric/formats/yaml_element.h"
#include "handway/geometric/io/existing_file.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/resources.h"
#include "handway/geometric/robot/base_joint.h"
#include "handway/geometric/robot/robot_model.h"
#include "handway/planning/extensions/plugin.h"
#include "problem_files.h"
#include "ros_messages.h"
#include "scene_text.h"
#include "world_objects.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace handway::import_moveit {
namespace {

using geometric::Configuration;
using geometric::Joint;
using geometric::JointType;
using geometric::Pose;
using geometric::RobotDescription;
using geometric::RobotModel;
using geometric::YamlElement;

constexpr double kSmallestQuaternion = 1e-6;

// Frames of tf had a slash in front.
std::string without_slash(const std::string& frame) {
  return frame.starts_with('/') ? frame.substr(1) : frame;
}

// The motion of a joint by `value`.
Pose moved(const Joint& joint, double value) {
  Pose X = joint.X_PJ;
  if (joint.type == JointType::kRevolute) {
    X.rotate(Eigen::AngleAxisd(value, joint.axis.normalized()));
  } else if (joint.type == JointType::kPrismatic) {
    X.translate(value * joint.axis.normalized());
  }
  return X;
}

std::vector<int> variables_of(const RobotModel& model, const YamlElement& group) {
  const std::optional<std::vector<int>> variables = model.find_group(group.text());
  if (variables && !variables->empty()) {
    return *variables;
  }
  std::vector<std::string> names;
  std::ranges::transform(model.description().groups, std::back_inserter(names),
                         &geometric::JointGroup::name);
  group.refuse(fmt::format("the group \"{}\", {}", group.text(),
                           variables ? "of which no joint moves" : "which the robot has not"),
               "a group of the robot's SRDF", geometric::advise_name(group.text(), names));
}

/// Converts MoveIt's seven numbers of a floating joint to its variables here: rot_x to rot_w of
/// `values` are replaced by yaw, pitch and roll.
std::map<std::string, double> with_angles(const RobotModel& model,
                                          std::map<std::string, double> values) {
  for (const geometric::BaseJoint& base : model.description().base_joints) {
    Eigen::Vector4d q = Eigen::Vector4d::Zero();  // x, y, z, w
    Eigen::Index part = 0;
    bool is_given = false;
    for (const char* name : {"rot_x", "rot_y", "rot_z", "rot_w"}) {
      if (const auto value = values.extract(fmt::format("{}/{}", base.name, name))) {
        q[part] = value.mapped();
        is_given = true;
      }
      ++part;
    }
    if (!is_given || q.norm() < kSmallestQuaternion) {
      continue;
    }
    const Eigen::Quaterniond rotation(q[3], q[0], q[1], q[2]);
    const std::vector<std::string> joints = joints_of(base);
    const std::vector<double> at = values_at(base, Pose(rotation.normalized()));
    for (std::size_t i = slides_of(base).size(); i < joints.size(); ++i) {
      values[joints[i]] = at[i];
    }
  }
  return values;
}

/// The joints' values in `values`, in the order of the configuration; the others as in `rest`.
/// Fixed and coupled joints are ignored.
/// @param[in,out] unknown gets the joints that the robot lacks, each once.
Configuration with_values(const RobotModel& model, const std::map<std::string, double>& values,
                          const Configuration& rest, std::set<std::string>& unknown) {
  Configuration q = rest;
  for (const auto& [name, value] : with_angles(model, values)) {
    if (const std::optional<int> variable = model.find_variable(name)) {
      q[*variable] = value;
      continue;
    }
    const std::vector<Joint>& joints = model.description().joints;
    if (std::ranges::find(joints, name, &Joint::name) == joints.end()) {
      unknown.insert(name);
    }
  }
  return q;
}

/// The robot of which only the joints of a planning group move: the others are fixed at their
/// values in `start`. Of its groups "hand" is kept.
/// @throws InputError if the robot has no such group, or none of its joints moves.
std::shared_ptr<const RobotModel> group_robot(const RobotModel& model, const YamlElement& group,
                                              const Configuration& start) {
  const std::vector<int> kept = variables_of(model, group);
  RobotDescription description = model.description();
  for (int link = 1; link < model.link_count(); ++link) {
    const RobotModel::MimicMapping& drive = model.mimic_mapping(link);
    if (drive.variable < 0 || std::ranges::count(kept, drive.variable) != 0) {
      continue;
    }
    const double value = drive.multiplier * start[drive.variable] + drive.offset;
    const auto joint = std::ranges::find(description.joints, model.joint(link).name, &Joint::name);
    joint->X_PJ = moved(*joint, value);
    joint->type = JointType::kFixed;
    joint->mimic.reset();
  }
  std::erase_if(description.base_joints, [&](const geometric::BaseJoint& base) {
    return std::ranges::count(kept, model.find_variable(joints_of(base).front()).value_or(-1)) == 0;
  });
  std::erase_if(description.groups,
                [](const geometric::JointGroup& other) { return other.name != "hand"; });
  description.postures.clear();
  return std::make_shared<const RobotModel>(std::move(description));
}

namespace fs = std::filesystem;
using geometric::Configuration;
using geometric::Pose;
using geometric::RobotModel;
using geometric::YamlElement;

class ProblemReader {
 public:
  explicit ProblemReader(const ProblemFiles& files)
      : files_(files),
        folder_(files.scene.parent_path()),
        top_(is_scene_text(files.scene)
                 ? YamlElement::parse(planning_scene_of(files.scene), files.scene.string(),
                                      "a MoveIt scene (.scene)")
                 : YamlElement::read(files.scene, "a MoveIt planning scene")) {
    if (files.request) {
      request_ = YamlElement::read(*files.request, "a MoveIt motion plan request");
    }
  }

  [[nodiscard]] planning::SceneState read() {
    top_.refuse_slips({"name", "robot_state", "robot_model_name", "fixed_frame_transforms",
                       "allowed_collision_matrix", "link_padding", "link_scale", "object_colors",
                       "world", "is_diff"});
    const std::optional<YamlElement> name = top_.find("name");
    scene_->file = files_.request.value_or(files_.scene);
    scene_->name = name && !name->text().empty() ? name->text() : scene_->file.stem().string();
    add_robot();
    const Frames frames = frames_of(scene_->robots.front());
    World world{frames, folder_, reach_of(scene_->robots.front()), *scene_};
    if (const auto message = top_.find("world")) {
      add_world(*message, world);
    }
    if (const auto state = top_.find("robot_state")) {
      state->refuse_slips(
          {"joint_state", "multi_dof_joint_state", "attached_collision_objects", "is_diff"});
      attach(*state, world);
    }
    if (const auto state = request_ ? request_->find("start_state") : std::nullopt) {
      take_start_state(*state, world);
    }
    if (const auto matrix = top_.find("allowed_collision_matrix"); matrix && matrix->is_map()) {
      read_collision_matrix(*matrix, world.names, *scene_);
    }
    read_paddings(top_, *scene_);
    const Frames all_frames = import_moveit::frames_of(world);
    const HeldFrames held = held_frames_of(world);
    add_pose_goals(all_frames, held);
    add_path_constraints(all_frames, held);
    note_unknown_joints();
    std::ranges::move(remarks_.warnings(), std::back_inserter(scene_->warnings));
    return {scene_, nullptr};
  }

 private:
  static void attach(const YamlElement& state, World& world) {
    for (const YamlElement& object : state.items_of("attached_collision_objects")) {
      add_attached(object, world);
    }
  }

  // A start that is not a difference to the scene's state replaces its attached objects, too.
  void take_start_state(const YamlElement& state, World& world) {
    state.refuse_slips(
        {"joint_state", "multi_dof_joint_state", "attached_collision_objects", "is_diff"});
    const auto joints = state.find("joint_state");
    const auto is_diff = state.find("is_diff");
    const bool is_whole = is_diff && !flag(*is_diff) && joints &&
                          !joints->items_of("name").empty() &&
                          state.find("attached_collision_objects");
    if (is_whole && remove_attached(world)) {
      scene_->warnings.push_back(
          fmt::format("{}: the start state is no difference (is_diff): what the scene's robot "
                      "carries is left out, as in MoveIt",
                      state.where()));
    }
    attach(state, world);
  }

  void add_robot() {
    const fs::path file = robot_file(top_.need("robot_model_name"), folder_);
    std::shared_ptr<const RobotModel> model = geometric::load_robot(file);
    const Configuration whole_start = start_of(*model);
    Configuration start = whole_start;
    if (const auto group = request_ ? request_->find("group_name") : std::nullopt) {
      const std::shared_ptr<const RobotModel> moving = group_robot(*model, *group, whole_start);
      start = Configuration(moving->variable_count());
      for (int v = 0; v < moving->variable_count(); ++v) {
        start[v] = whole_start[*model->find_variable(moving->variable(v).name)];
      }
      model = moving;
    }
    for (const std::string& warning : model->description().warnings) {
      scene_->warnings.push_back(fmt::format("robot {}: {}", model->name(), warning));
    }
    scene_->robots.push_back({model->name(), file, model, X_WB_, start});
    if (request_) {
      scene_->start = start;
      read_goals();
      scene_->goal = goal_of(*model);
      scene_->robots.front().model = within_workspace(model);
    }
  }

  // Sets the robot's pose, too.
  [[nodiscard]] Configuration start_of(const RobotModel& model) {
    Configuration q = model.neutral();
    for (const auto& state : {top_.find("robot_state"), request_ ? request_->find("start_state")
                                                                 : std::optional<YamlElement>()}) {
      const auto joints = state ? state->find("joint_state") : std::nullopt;
      if (joints) {
        q = with_values(model, read_joint_state(*joints), q, unknown_joints_);
      }
      if (const auto bases = state ? state->find("multi_dof_joint_state") : std::nullopt) {
        for (const auto& [name, X] : read_multi_dof_joint_state(*bases)) {
          q = with_base_at(model, name, X, q);
        }
      }
    }
    return q;
  }

  // Returns `q` with a planar or floating joint at `X`; a fixed virtual joint sets the pose of the
  // robot instead.
  [[nodiscard]] Configuration with_base_at(const RobotModel& model, const std::string& name,
                                           const Pose& X, const Configuration& q) {
    const geometric::RobotDescription& robot = model.description();
    const auto base = std::ranges::find(robot.base_joints, name, &geometric::BaseJoint::name);
    if (base == robot.base_joints.end()) {
      if (std::ranges::count(robot.virtual_joints, name, &geometric::BaseJoint::name) > 0) {
        X_WB_ = X;
      } else {
        unknown_joints_.insert(name);
      }
      return q;
    }
    std::map<std::string, double> values;
    const std::vector<std::string> joints = joints_of(*base);
    const std::vector<double> at = values_at(*base, X);
    std::ranges::transform(
        joints, at, std::inserter(values, values.end()),
        [](const std::string& joint, double value) { return std::pair(joint, value); });
    return with_values(model, values, q, unknown_joints_);
  }

  // If the first goal has a pose, all goals with a pose are used; else the first alone.
  void read_goals() {
    request_->refuse_slips({"start_state", "goal_constraints", "path_constraints", "group_name"});
    const YamlElement list = request_->need("goal_constraints");
    goals_ = list.items();
    if (goals_.empty()) {
      list.refuse("an empty list", "a goal");
    }
    const std::size_t count = goals_.size();
    if (has_pose(goals_.front())) {
      std::erase_if(goals_, [](const YamlElement& goal) { return !has_pose(goal); });
    } else {
      goals_.erase(goals_.begin() + 1, goals_.end());
    }
    if (goals_.size() < count) {
      scene_->warnings.push_back(
          goals_.size() == 1
              ? fmt::format("{}: only the first of {} goals is used", list.where(), count)
              : fmt::format("{}: only the {} of {} goals with a pose are used", list.where(),
                            goals_.size(), count));
    }
  }

  void add_pose_goals(const Frames& frames, const HeldFrames& held) {
    for (const YamlElement& goal : goals_) {
      if (has_pose(goal)) {
        const std::vector<geometric::PoseGoal> poses =
            read_pose_goals(goal, *scene_->robots.front().model, frames, held);
        scene_->goal_poses.insert(scene_->goal_poses.end(), poses.begin(), poses.end());
      }
    }
  }

  // With a pose: values of the joints that the first goal names; the others are as at the start.
  [[nodiscard]] Configuration goal_of(const RobotModel& model) {
    const YamlElement& goal = goals_.front();
    goal.refuse_slips({"name", "joint_constraints", "position_constraints",
                       "orientation_constraints", "visibility_constraints"});
    std::map<std::string, double> values;
    for (const YamlElement& one : goal.items_of("joint_constraints")) {
      values[one.need("joint_name").text()] = one.need("position").number();
    }
    values = with_angles(model, std::move(values));
    for (int v = 0; v < model.variable_count() && !has_pose(goal); ++v) {
      const std::string& joint = model.variable(v).name;
      if (!values.contains(joint)) {
        goal.refuse(values.empty() ? "no joint_constraints"
                                   : fmt::format("no joint constraint for \"{}\"", joint),
                    "the goal as positions of all joints of the group, or as the pose of a link");
      }
    }
    return with_values(model, values, scene_->robots.front().configuration, unknown_joints_);
  }

  // Planar and floating joints get the range of the request's workspace, extended to start and
  // goal.
  [[nodiscard]] std::shared_ptr<const RobotModel> within_workspace(
      const std::shared_ptr<const RobotModel>& model) const {
    geometric::RobotDescription robot = model->description();
    if (robot.base_joints.empty()) {
      return model;
    }
    const auto workspace = request_->find("workspace_parameters");
    const auto corner = [&](const char* key) -> std::optional<Eigen::Vector3d> {
      const auto element = workspace ? workspace->find(key) : std::nullopt;
      return element ? std::optional(read_point(*element)) : std::nullopt;
    };
    const auto lower = corner("min_corner");
    const auto upper = corner("max_corner");
    const bool is_given = lower && upper && (lower->array() < upper->array()).all();
    for (const geometric::BaseJoint& base : robot.base_joints) {
      Eigen::Index axis = 0;
      for (const std::string& slide : slides_of(base)) {
        const int v = *model->find_variable(slide);
        auto& limits = std::ranges::find(robot.joints, slide, &geometric::Joint::name)->limits;
        limits.lower = is_given ? (*lower)[axis] : limits.lower;
        limits.upper = is_given ? (*upper)[axis] : limits.upper;
        for (const double value : {(*scene_->start)[v], (*scene_->goal)[v]}) {
          limits.lower = std::min(limits.lower, value);
          limits.upper = std::max(limits.upper, value);
        }
        ++axis;
      }
    }
    return std::make_shared<const RobotModel>(std::move(robot));
  }

  [[nodiscard]] Frames frames_of(const geometric::RobotInstance& robot) const {
    const RobotModel& model = *robot.model;
    std::vector<Pose> X_BL(static_cast<std::size_t>(model.link_count()));
    model.forward_kinematics(robot.configuration, X_BL);
    Frames frames = {{"world", Pose::Identity()}};
    for (int link = 0; link < model.link_count(); ++link) {
      frames[model.link(link).name] = robot.X_WB * X_BL[static_cast<std::size_t>(link)];
    }
    add_fixed_frames(frames);
    return frames;
  }

  // Adds the frames of the scene. Each is in the world, in a link or in another of these frames,
  // which may be later in the list. A frame that nothing defines is the world under another name,
  // such as "odom".
  void add_fixed_frames(Frames& frames) const {
    std::map<std::string, std::pair<std::string, Pose>> given;  // parent and pose in it
    for (const YamlElement& one : top_.items_of("fixed_frame_transforms")) {
      given.emplace(
          without_slash(one.need("child_frame_id").text()),
          std::pair(frame_name(one).value_or("world"), read_transform(one.need("transform"))));
    }
    for (const auto& [name, frame] : given) {
      auto [parent, X_WF] = frame;
      for (std::size_t steps = 0; steps < given.size() && !frames.contains(parent); ++steps) {
        const auto above = given.find(parent);
        if (above == given.end()) {
          break;
        }
        X_WF = above->second.second * X_WF;
        parent = above->second.first;
      }
      const auto known = frames.find(parent);
      frames.emplace(name, known == frames.end() ? X_WF : known->second * X_WF);
    }
  }

  void add_path_constraints(const Frames& frames, const HeldFrames& held) {
    const auto path = request_ ? request_->find("path_constraints") : std::nullopt;
    if (path && path->is_map()) {
      scene_->constraints =
          read_path_constraints(*path, *scene_->robots.front().model, frames, held);
    }
  }

  // Reports unknown joints: mostly those of another variant of the robot, such as its gripper.
  void note_unknown_joints() {
    if (!unknown_joints_.empty()) {
      scene_->warnings.push_back(
          fmt::format("joints in the problem's states that {} has not are passed over: {}",
                      scene_->robots.front().model->name(), fmt::join(unknown_joints_, ", ")));
    }
  }

  const ProblemFiles& files_;
  Remarks remarks_;
  std::set<std::string> unknown_joints_;
  Pose X_WB_ = Pose::Identity();
  fs::path folder_;
  YamlElement top_;
  std::optional<YamlElement> request_;
  std::vector<YamlElement> goals_;  ///< Goals of the request that are used.
  std::shared_ptr<geometric::Scene> scene_ = std::make_shared<geometric::Scene>();
};

}  // namespace

planning::SceneState read_moveit_problem(const ProblemFiles& files) {
  return ProblemReader(files).read();
}

std::string MoveitImporter::name() const { return "a MoveIt scene or request (.yaml, .scene)"; }

bool MoveitImporter::can_read(const std::filesystem::path& file) const {
  return is_scene_text(file) ||
         ((geometric::has_extension(file, ".yaml") || geometric::has_extension(file, ".yml")) &&
          is_moveit_file(file));
}

planning::SceneState MoveitImporter::read(const std::filesystem::path& file) const {
  const std::filesystem::path whole = std::filesystem::absolute(file);
  return read_moveit_problem(is_scene_text(file) ? ProblemFiles{whole, std::nullopt}
                                                 : problem_files(whole));
}

}  // namespace handway::import_moveit

HANDWAY_PLUGIN({.name = "import_moveit",
                .version = HANDWAY_VERSION,
                .make_importer = []() -> std::unique_ptr<handway::planning::Importer> {
                  return std::make_unique<handway::import_moveit::MoveitImporter>();
                }});
