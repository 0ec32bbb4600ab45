#include "handway/geometric/formats/obj_writer.h"
#include "handway/geometric/formats/urdf.h"
#include "handway/geometric/io/replace_file.h"
#include "handway/geometric/robot/robot_model.h"
#include "scene_exporters.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <numbers>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace handway::export_scene {
namespace {

using geometric::Pose;
using geometric::RobotInstance;
using geometric::Scene;
using Message = nlohmann::ordered_json;

constexpr const char* kGroup = "all_joints";
constexpr double kAnywhere = 10.0;  // m, the side of a region that stands for no tolerance

Message quaternion(const Eigen::Matrix3d& rotation) {
  const Eigen::Quaterniond q(rotation);
  return {{"x", q.x()}, {"y", q.y()}, {"z", q.z()}, {"w", q.w()}};
}

Message pose(const Pose& X) {
  return {{"position",
           {{"x", X.translation().x()}, {"y", X.translation().y()}, {"z", X.translation().z()}}},
          {"orientation", quaternion(X.linear())}};
}

// shape_msgs/SolidPrimitive.
Message primitive(int type, std::vector<double> sizes) {
  return {{"type", type}, {"dimensions", std::move(sizes)}};
}

Message triangles(const geometric::TriangleMesh& mesh) {
  Message vertices = Message::array();
  for (const Eigen::Vector3d& v : mesh.vertices) {
    vertices.push_back({{"x", v.x()}, {"y", v.y()}, {"z", v.z()}});
  }
  Message faces = Message::array();
  for (const auto& triangle : mesh.triangles) {
    faces.push_back({{"vertex_indices", triangle}});
  }
  return {{"triangles", faces}, {"vertices", vertices}};
}

/// A moveit_msgs/CollisionObject in the making.
class CollisionObject {
 public:
  CollisionObject(const std::string& id, const std::string& frame) {
    message_["header"] = {{"frame_id", frame}};
    message_["id"] = id;
    for (const char* list : {"primitives", "primitive_poses", "meshes", "mesh_poses"}) {
      message_[list] = Message::array();
    }
  }

  void add(const geometric::Shape& shape, const Pose& X) {
    if (std::holds_alternative<geometric::Mesh>(shape) ||
        std::holds_alternative<geometric::Cloud>(shape)) {
      message_["meshes"].push_back(triangles(*geometric::tessellate(shape)));
      message_["mesh_poses"].push_back(pose(X));
      return;
    }
    message_["primitives"].push_back(std::visit(ToPrimitive(), shape));
    message_["primitive_poses"].push_back(pose(X));
  }

  [[nodiscard]] Message message() && {
    message_["operation"] = 0;  // add
    return std::move(message_);
  }

 private:
  struct ToPrimitive {
    Message operator()(const geometric::Box& box) const {
      return primitive(1, {box.size.x(), box.size.y(), box.size.z()});
    }
    Message operator()(const geometric::Sphere& sphere) const {
      return primitive(2, {sphere.radius});
    }
    Message operator()(const geometric::Cylinder& cylinder) const {
      return primitive(3, {cylinder.length, cylinder.radius});
    }
    Message operator()(const geometric::Cone& cone) const {
      return primitive(4, {cone.length, cone.radius});
    }
    Message operator()(const geometric::Mesh& /*mesh*/) const { return {}; }
    Message operator()(const geometric::Cloud& /*cloud*/) const { return {}; }
  };

  Message message_;
};

/// The robot with a group of all independent joints.
geometric::RobotModel with_whole_group(const geometric::RobotModel& model) {
  geometric::RobotDescription robot = model.description();
  std::erase_if(robot.groups, [](const auto& group) { return group.name == kGroup; });
  geometric::JointGroup whole{kGroup, {}};
  for (int v = 0; v < model.variable_count(); ++v) {
    whole.joints.push_back(model.variable(v).name);
  }
  robot.groups.push_back(std::move(whole));
  return geometric::RobotModel(std::move(robot));
}

Message joint_state(const geometric::RobotModel& model, const geometric::Configuration& q) {
  Message names = Message::array();
  Message positions = Message::array();
  for (const geometric::JointValue& joint : joint_values(model, q)) {
    names.push_back(joint.joint);
    positions.push_back(joint.value);
  }
  return {{"name", names}, {"position", positions}};
}

/// Makes the messages of one scene.
class Messages {
 public:
  explicit Messages(const Scene& scene)
      : scene_(scene), robot_(scene.robots.front()), X_BW_(robot_.X_WB.inverse()) {}

  [[nodiscard]] Message planning_scene(const std::string& robot_file) const {
    Message attached = Message::array();
    Message objects = Message::array();
    for (std::size_t r = 1; r < scene_.robots.size(); ++r) {
      add_links(scene_.robots[r], objects);
    }
    for (const geometric::SceneObject& object : scene_.objects) {
      if (object.attachment && object.attachment->robot == robot_.name) {
        CollisionObject message(object.name, object.attachment->link);
        message.add(object.shape, object.X_PO);
        attached.push_back({{"link_name", object.attachment->link},
                            {"object", std::move(message).message()},
                            {"touch_links", object.attachment->touching}});
        continue;
      }
      CollisionObject message(object.name, root());
      message.add(object.shape, X_BW_ * in_world(object));
      objects.push_back(std::move(message).message());
    }
    Message scene;
    scene["name"] = scene_.name;
    scene["robot_model_name"] = robot_file;
    scene["robot_state"] = {
        {"joint_state", joint_state(*robot_.model, scene_.start.value_or(robot_.configuration))},
        {"attached_collision_objects", attached},
        {"is_diff", false}};
    if (!scene_.allowed_collisions.empty()) {
      scene["allowed_collision_matrix"] = collision_matrix();
    }
    add_paddings(scene);
    scene["world"] = {{"collision_objects", objects}};
    scene["is_diff"] = false;
    return scene;
  }

  [[nodiscard]] Message request() const {
    Message goals = Message::array();
    for (const geometric::PoseGoal& goal : scene_.goal_poses) {
      goals.push_back(pose_goal(goal));
    }
    if (goals.empty()) {
      Message joints = Message::array();
      for (int v = 0; v < robot_.model->variable_count(); ++v) {
        joints.push_back({{"joint_name", robot_.model->variable(v).name},
                          {"position", (*scene_.goal)[v]},
                          {"tolerance_above", 1e-4},
                          {"tolerance_below", 1e-4},
                          {"weight", 1.0}});
      }
      goals.push_back({{"joint_constraints", joints}});
    }
    return {{"group_name", kGroup},
            {"num_planning_attempts", 1},
            {"allowed_planning_time", 5.0},
            {"start_state", {{"joint_state", joint_state(*robot_.model, *scene_.start)}}},
            {"goal_constraints", goals}};
  }

 private:
  [[nodiscard]] const std::string& root() const { return robot_.model->link(0).name; }

  [[nodiscard]] Pose in_world(const geometric::SceneObject& object) const {
    if (!object.attachment) {
      return object.X_PO;
    }
    const RobotInstance& robot = *find_robot(scene_, object.attachment->robot);
    return robot.X_WB *
           links_of(robot)[static_cast<std::size_t>(
               robot.model->find_link(object.attachment->link).value())] *
           object.X_PO;
  }

  static std::vector<Pose> links_of(const RobotInstance& robot) {
    std::vector<Pose> X_BL(static_cast<std::size_t>(robot.model->link_count()));
    robot.model->forward_kinematics(robot.configuration, X_BL);
    return X_BL;
  }

  void add_links(const RobotInstance& robot, Message& objects) const {
    const std::vector<Pose> X_BL = links_of(robot);
    for (int i = 0; i < robot.model->link_count(); ++i) {
      const geometric::Link& link = robot.model->link(i);
      if (link.collision.empty()) {
        continue;
      }
      CollisionObject message(robot.name + "/" + link.name, root());
      for (const geometric::LinkGeometry& part : link.collision) {
        message.add(part.shape, X_BW_ * robot.X_WB * X_BL[static_cast<std::size_t>(i)] * part.X_LG);
      }
      objects.push_back(std::move(message).message());
    }
  }

  // Returns the matrix of all links, as it replaces that of the SRDF, and of objects named in
  // pairs.
  [[nodiscard]] Message collision_matrix() const {
    std::vector<std::string> names;
    for (const geometric::Link& link : robot_.model->description().links) {
      names.push_back(link.name);
    }
    for (const auto& [pair, touch] : scene_.allowed_collisions) {
      for (const std::string& name : {pair.first, pair.second}) {
        if (std::ranges::find(names, name) == names.end()) {
          names.push_back(name);
        }
      }
    }
    Message rows = Message::array();
    for (const std::string& a : names) {
      Message row = Message::array();
      for (const std::string& b : names) {
        const auto said = scene_.allowed_collisions.find(std::minmax(a, b));
        row.push_back(
            said != scene_.allowed_collisions.end()
                ? said->second
                : robot_.model->description().allowed_collisions.reason(a, b).has_value());
      }
      rows.push_back({{"enabled", row}});
    }
    return {{"entry_names", names}, {"entry_values", rows}};
  }

  void add_paddings(Message& scene) const {
    for (const auto& [link, padding] : robot_.padding) {
      scene["link_padding"].push_back({{"link_name", link}, {"padding", padding.distance}});
      scene["link_scale"].push_back({{"link_name", link}, {"scale", padding.scale}});
    }
  }

  [[nodiscard]] Message pose_goal(const geometric::PoseGoal& goal) const {
    const Pose X_BG = X_BW_ * goal.X_WG;
    const Eigen::Vector3d sides = (2.0 * goal.position_tolerance).cwiseMin(kAnywhere);
    const Message region = {{"primitives", {primitive(1, {sides.x(), sides.y(), sides.z()})}},
                            {"primitive_poses", {pose(X_BG)}}};
    const Message header = {{"frame_id", root()}};
    Message message;
    message["position_constraints"] = Message::array({{{"header", header},
                                                       {"link_name", goal.link},
                                                       {"target_point_offset",
                                                        {{"x", goal.X_LT.translation().x()},
                                                         {"y", goal.X_LT.translation().y()},
                                                         {"z", goal.X_LT.translation().z()}}},
                                                       {"constraint_region", region},
                                                       {"weight", 1.0}}});
    if ((goal.rotation_tolerance.array() < std::numbers::pi).any()) {
      message["orientation_constraints"] = Message::array(
          {{{"header", header},
            {"link_name", goal.link},
            {"orientation", quaternion(X_BG.linear() * goal.X_LT.linear().transpose())},
            {"absolute_x_axis_tolerance", goal.rotation_tolerance.x()},
            {"absolute_y_axis_tolerance", goal.rotation_tolerance.y()},
            {"absolute_z_axis_tolerance", goal.rotation_tolerance.z()},
            {"weight", 1.0}}});
    }
    return message;
  }

  const Scene& scene_;
  const RobotInstance& robot_;
  Pose X_BW_;
};

}  // namespace

std::vector<std::filesystem::path> MoveitSceneExporter::do_write(
    const Scene& scene, const std::filesystem::path& folder, const std::string& /*stem*/) const {
  const geometric::RobotModel& model = *scene.robots.front().model;
  const std::string robot = geometric::file_name_of(model.name());
  std::vector<std::filesystem::path> written = {folder / (robot + ".urdf"),
                                                folder / (robot + ".srdf")};
  write_urdf(with_whole_group(model), written.front());
  const auto write = [&](const char* name, const Message& message) {
    // Writes JSON, which is YAML, with one key per line.
    std::string text;
    for (const auto& [key, value] : message.items()) {
      text += key + ": " + value.dump() + "\n";
    }
    written.push_back(folder / name);
    geometric::replace_file(written.back(), text);
  };
  const Messages messages(scene);
  write("scene.yaml", messages.planning_scene(robot));
  if (scene.start && (scene.goal || !scene.goal_poses.empty())) {
    write("request.yaml", messages.request());
  }
  return written;
}

}  // namespace handway::export_scene
