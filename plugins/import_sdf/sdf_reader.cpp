#include "sdf_reader.h"

#include "handway/geometric/formats/mesh_reader.h"
#include "handway/geometric/io/existing_file.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/number_text.h"
#include "handway/geometric/io/package_path.h"
#include "handway/geometric/mesh/shape.h"
#include "handway/geometric/robot/base_joint.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ignition/math/Pose3.hh>
#include <iterator>
#include <limits>
#include <map>
#include <mutex>
#include <numbers>
#include <optional>
#include <sdf/Box.hh>
#include <sdf/Capsule.hh>
#include <sdf/Collision.hh>
#include <sdf/Console.hh>
#include <sdf/Cylinder.hh>
#include <sdf/Element.hh>
#include <sdf/Ellipsoid.hh>
#include <sdf/Error.hh>
#include <sdf/Geometry.hh>
#include <sdf/Joint.hh>
#include <sdf/JointAxis.hh>
#include <sdf/Link.hh>
#include <sdf/Material.hh>
#include <sdf/Mesh.hh>
#include <sdf/Model.hh>
#include <sdf/ParserConfig.hh>
#include <sdf/Root.hh>
#include <sdf/SemanticPose.hh>
#include <sdf/Sphere.hh>
#include <sdf/Visual.hh>
#include <sdf/World.hh>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <tuple>
#include <utility>
#include <vector>

namespace handway::import_sdf {
namespace {

namespace fs = std::filesystem;
using geometric::InputError;
using geometric::Joint;
using geometric::JointType;
using geometric::Pose;
using geometric::RobotDescription;
using geometric::Shape;

Eigen::Vector3d vector_of(const ignition::math::Vector3d& v) { return {v.X(), v.Y(), v.Z()}; }

// A model's folder by Gazebo's rules, or a package's.
std::optional<fs::path> model_folder(const std::string& name, const fs::path& folder) {
  if (const std::optional<fs::path> found = geometric::find_package(name, folder)) {
    return found;
  }
  for (const char* variable :
       {"GZ_SIM_RESOURCE_PATH", "IGN_GAZEBO_RESOURCE_PATH", "GAZEBO_MODEL_PATH"}) {
    const char* value = std::getenv(variable);
    std::istringstream paths(value != nullptr ? value : "");
    for (std::string path; std::getline(paths, path, ':');) {
      std::error_code ignored;
      if (!path.empty() && fs::is_directory(fs::path(path) / name, ignored)) {
        return fs::path(path) / name;
      }
    }
  }
  return std::nullopt;
}

fs::path mesh_file(const std::string& uri, const fs::path& folder, const std::string& where) {
  const std::size_t colon = uri.find("://");
  if (colon == std::string::npos) {
    return geometric::existing_file((folder / uri).lexically_normal());
  }
  const std::string scheme = uri.substr(0, colon);
  const fs::path rest = uri.substr(colon + 3);
  if (scheme == "file") {
    return geometric::existing_file((rest.is_absolute() ? rest : folder / rest).lexically_normal());
  }
  const std::string name = rest.empty() ? "" : rest.begin()->string();
  const std::optional<fs::path> model =
      scheme == "model" || scheme == "package" ? model_folder(name, folder) : std::nullopt;
  if (!model) {
    throw geometric::InputError({where, "mesh", "\"" + uri + "\", but no folder \"" + name + "\"",
                                 "a relative path, file://, model:// or package://",
                                 "Name the folder that holds it with --package-path"});
  }
  return geometric::existing_file((*model / rest.lexically_relative(name)).lexically_normal());
}

geometric::Mesh mesh_of(const sdf::Mesh& from, const fs::path& folder, const std::string& where) {
  geometric::Mesh mesh;
  mesh.file = mesh_file(from.Uri(), folder, where);
  mesh.scale = vector_of(from.Scale());
  mesh.triangles = geometric::read_mesh(mesh.file, mesh.scale, where);
  return mesh;
}

Pose pose_of(const ignition::math::Pose3d& pose) {
  Pose X = Pose::Identity();
  X.linear() = Eigen::Quaterniond(pose.Rot().W(), pose.Rot().X(), pose.Rot().Y(), pose.Rot().Z())
                   .normalized()
                   .toRotationMatrix();
  X.translation() = vector_of(pose.Pos());
  return X;
}

// A geometry as Handway's shapes, with their poses in its frame; empty for one of another kind.
std::vector<std::pair<Shape, Pose>> shapes_of(const sdf::Geometry& geometry, const fs::path& folder,
                                              const std::string& where) {
  if (const sdf::Box* box = geometry.BoxShape()) {
    return {{geometric::Box{vector_of(box->Size())}, Pose::Identity()}};
  }
  if (const sdf::Sphere* sphere = geometry.SphereShape()) {
    return {{geometric::Sphere{sphere->Radius()}, Pose::Identity()}};
  }
  if (const sdf::Cylinder* cylinder = geometry.CylinderShape()) {
    return {{geometric::Cylinder{cylinder->Radius(), cylinder->Length()}, Pose::Identity()}};
  }
  if (const sdf::Capsule* capsule = geometry.CapsuleShape()) {
    return geometric::capsule_shapes(capsule->Radius(), capsule->Length());
  }
  if (const sdf::Ellipsoid* ellipsoid = geometry.EllipsoidShape()) {
    return {{geometric::ellipsoid_mesh(vector_of(ellipsoid->Radii())), Pose::Identity()}};
  }
  if (const sdf::Mesh* mesh = geometry.MeshShape()) {
    return {{mesh_of(*mesh, folder, where), Pose::Identity()}};
  }
  return {};
}

constexpr double kLargestLimit = 1e6;
constexpr double kSamePlace = 1e-9;
constexpr const char* kWorld = "world";

std::string text_of(const sdf::Errors& errors) {
  std::string text;
  for (const sdf::Error& error : errors) {
    text += (text.empty() ? "" : "; ") + error.Message();
  }
  return text;
}

const sdf::Model* busiest_model(const sdf::Root& root) {
  const sdf::Model* found = root.Model();
  for (std::uint64_t w = 0; w < root.WorldCount(); ++w) {
    const sdf::World* world = root.WorldByIndex(w);
    for (std::uint64_t m = 0; m < world->ModelCount(); ++m) {
      const sdf::Model* model = world->ModelByIndex(m);
      if (found == nullptr || model->JointCount() > found->JointCount()) {
        found = model;
      }
    }
  }
  return found;
}

class Reader {
 public:
  explicit Reader(const fs::path& file) : folder_(fs::absolute(file).parent_path()) {
    robot_.file = file;
  }

  RobotDescription read() {
    static std::mutex one_at_a_time;  // the library's console is one for the whole program
    const std::lock_guard lock(one_at_a_time);
    sdf::Console::Instance()->SetQuiet(true);
    sdf::ParserConfig config;
    config.SetFindCallback([this](const std::string& uri) { return included(uri); });
    sdf::Root root;
    sdf::Errors errors = root.Load(robot_.file.string(), config);
    // Sun and ground of a world are not needed for planning.
    const auto lost = std::stable_partition(errors.begin(), errors.end(), [](const auto& error) {
      return error.Code() != sdf::ErrorCode::URI_LOOKUP;
    });
    std::vector<std::string> missing;
    std::ranges::transform(lost, errors.end(), std::back_inserter(missing), &sdf::Error::Message);
    note(missing, "includes that are left out");
    errors.erase(lost, errors.end());
    const sdf::Model* model = errors.empty() ? busiest_model(root) : nullptr;
    if (model == nullptr && errors.empty() && !missing.empty()) {
      refuse("", fmt::format("no model besides includes: {}", fmt::join(missing, "; ")),
             "a robot as SDF", "Name the folder that holds their folders with --package-path");
    }
    if (model == nullptr) {
      refuse("", errors.empty() ? "no model" : "what libsdformat does not take: " + text_of(errors),
             "a robot as SDF");
    }
    robot_.name = model->Name();
    add_links(*model, "", Pose::Identity());
    add_joints(*model, "");
    note(left_out_, "geometries that are not read");
    note(unbounded_, "slides without limits, which go ±2 m");
    return std::move(robot_);
  }

 private:
  [[noreturn]] void refuse(const std::string& element, const std::string& found,
                           const std::string& expected, const std::string& advice = "") const {
    throw InputError({robot_.file.string(), element, found, expected, advice});
  }

  // The file or folder of an included model; empty if it is not found.
  [[nodiscard]] std::string included(const std::string& uri) const {
    const std::size_t colon = uri.find("://");
    const fs::path rest = colon == std::string::npos ? uri : uri.substr(colon + 3);
    const std::string name = rest.empty() ? "" : rest.begin()->string();
    const std::optional<fs::path> folder = model_folder(name, folder_);
    return folder ? (*folder / rest.lexically_relative(name)).lexically_normal().string() : "";
  }

  void check(const sdf::Errors& errors, const std::string& element) const {
    if (!errors.empty()) {
      refuse(element, text_of(errors), "a frame that can be found");
    }
  }

  // @param scope names of the models around, with :: behind each. @param X_RM of the model in the
  // robot.
  void add_links(const sdf::Model& model, const std::string& scope, const Pose& X_RM) {
    for (std::uint64_t i = 0; i < model.LinkCount(); ++i) {
      const sdf::Link& from = *model.LinkByIndex(i);
      geometric::Link link;
      link.name = scope + from.Name();
      ignition::math::Pose3d X;
      check(from.SemanticPose().Resolve(X, "__model__"), "link " + link.name);
      X_RL_[link.name] = X_RM * pose_of(X);
      for (std::uint64_t c = 0; c < from.CollisionCount(); ++c) {
        add_geometry(*from.CollisionByIndex(c), link.name, link.collision, {});
      }
      for (std::uint64_t v = 0; v < from.VisualCount(); ++v) {
        const sdf::Visual& visual = *from.VisualByIndex(v);
        geometric::Color color;
        if (visual.Material() != nullptr) {
          const ignition::math::Color& diffuse = visual.Material()->Diffuse();
          color = {diffuse.R(), diffuse.G(), diffuse.B(), diffuse.A()};
        }
        add_seen(visual, link, color);
      }
      robot_.links.push_back(std::move(link));
    }
    for (std::uint64_t m = 0; m < model.ModelCount(); ++m) {
      const sdf::Model& inner = *model.ModelByIndex(m);
      ignition::math::Pose3d X;
      check(inner.SemanticPose().Resolve(X, "__model__"), "model " + inner.Name());
      add_links(inner, scope + inner.Name() + "::", X_RM * pose_of(X));
    }
  }

  template <typename Part>
  void add_geometry(const Part& part, const std::string& link,
                    std::vector<geometric::LinkGeometry>& list, const geometric::Color& color) {
    const std::string element = link + "/" + part.Name();
    ignition::math::Pose3d X_LG;
    check(part.SemanticPose().Resolve(X_LG), element);
    const auto shapes = shapes_of(*part.Geom(), folder_, robot_.file.string() + ", " + element);
    if (shapes.empty()) {
      left_out_.push_back(element);
    }
    for (const auto& [shape, X_GS] : shapes) {
      list.push_back({shape, pose_of(X_LG) * X_GS, color});
    }
  }

  // Visual geometry may be missing.
  void add_seen(const sdf::Visual& visual, geometric::Link& link, const geometric::Color& color) {
    try {
      add_geometry(visual, link.name, link.visual, color);
    } catch (const InputError& error) {
      robot_.warnings.emplace_back(error.what());
      link.visual = link.collision;
    }
  }

  void add_joints(const sdf::Model& model, const std::string& scope) {
    for (std::uint64_t i = 0; i < model.JointCount(); ++i) {
      add_joint(*model.JointByIndex(i), scope);
    }
    for (std::uint64_t m = 0; m < model.ModelCount(); ++m) {
      const sdf::Model& inner = *model.ModelByIndex(m);
      add_joints(inner, scope + inner.Name() + "::");
    }
  }

  void add_joint(const sdf::Joint& from, const std::string& scope) {
    const std::string name = scope + from.Name();
    std::string parent;
    std::string child;
    check(from.ResolveParentLink(parent), "joint " + name);
    check(from.ResolveChildLink(child), "joint " + name);
    child = scope + child;
    const bool on_world = parent == kWorld;
    if (on_world && from.Type() == sdf::JointType::FIXED) {
      return;  // the root stands still anyway
    }
    parent = on_world ? world_link() : scope + parent;
    ignition::math::Pose3d X_CJ;
    check(from.SemanticPose().Resolve(X_CJ, from.ChildLinkName()), "joint " + name);
    const Pose X_PJ = X_RL_.at(parent).inverse() * X_RL_.at(child) * pose_of(X_CJ);
    const bool is_at_child = pose_of(X_CJ).matrix().isIdentity(kSamePlace);
    std::vector<Joint> chain = joints_of(from, name);
    for (std::size_t i = 0; i < chain.size(); ++i) {
      Joint& joint = chain[i];
      if (joint.mimic) {
        joint.mimic->joint = scope + joint.mimic->joint;
      }
      joint.parent = i == 0 ? parent : chain[i - 1].child;
      joint.X_PJ = i == 0 ? X_PJ : Pose::Identity();
      joint.child = i + 1 < chain.size() ? joint.name : is_at_child ? child : name + "/frame";
      if (joint.child != child) {
        robot_.links.push_back({joint.child, {}, {}});
      }
    }
    if (!is_at_child) {
      Joint fixed = fixed_joint(name + "/fixed");
      fixed.parent = chain.back().child;
      fixed.child = child;
      fixed.X_PJ = pose_of(X_CJ).inverse();
      chain.push_back(std::move(fixed));
    }
    std::ranges::move(chain, std::back_inserter(robot_.joints));
  }

  std::string world_link() {
    if (!X_RL_.contains(kWorld)) {
      robot_.links.push_back({kWorld, {}, {}});
      X_RL_[kWorld] = Pose::Identity();
    }
    return kWorld;
  }

  // One joint for each axis, without parents and children.
  std::vector<Joint> joints_of(const sdf::Joint& from, const std::string& name) {
    switch (from.Type()) {
      case sdf::JointType::FIXED:
        return {fixed_joint(name)};
      case sdf::JointType::REVOLUTE:
      case sdf::JointType::CONTINUOUS:
      case sdf::JointType::PRISMATIC:
        return {axis_of(from, 0, name)};
      case sdf::JointType::UNIVERSAL:
      case sdf::JointType::REVOLUTE2:
        return {axis_of(from, 0, name + "/1"), axis_of(from, 1, name)};
      case sdf::JointType::BALL:
        return ball(name);
      default:
        refuse("joint " + name, "a gearbox, a screw or an unknown type",
               "fixed, revolute, continuous, prismatic, universal, revolute2 or ball");
    }
  }

  static Joint fixed_joint(const std::string& name) {
    Joint joint;
    joint.name = name;
    return joint;
  }

  Joint axis_of(const sdf::Joint& from, unsigned index, const std::string& name) {
    const sdf::JointAxis* axis = from.Axis(index);
    if (axis == nullptr) {
      refuse("joint " + name, "no axis", "one");
    }
    Joint joint;
    joint.name = name;
    ignition::math::Vector3d xyz;
    check(axis->ResolveXyz(xyz, from.Name()), "joint " + name);
    joint.axis = Eigen::Vector3d(xyz.X(), xyz.Y(), xyz.Z()).normalized();
    joint.mimic = mimic_of(*axis, name);
    joint.limits.lower = axis->Lower();
    joint.limits.upper = axis->Upper();
    if (axis->MaxVelocity() > 0.0) {
      joint.limits.velocity = axis->MaxVelocity();
    }
    const bool is_slide = from.Type() == sdf::JointType::PRISMATIC;
    joint.type = is_slide ? JointType::kPrismatic : JointType::kRevolute;
    const bool is_endless = from.Type() == sdf::JointType::CONTINUOUS ||
                            !(joint.limits.lower > -kLargestLimit) ||
                            !(joint.limits.upper < kLargestLimit);
    if (is_endless) {
      const double most =
          is_slide ? geometric::kDefaultBaseReach : std::numeric_limits<double>::infinity();
      joint.limits.lower = -most;
      joint.limits.upper = most;
      if (is_slide) {
        unbounded_.push_back(name);
      }
    }
    return joint;
  }

  // Reads the mimic joint of SDF 1.11: follower = multiplier * (leader - reference) + offset. To
  // this libsdformat it is an element that it does not know.
  std::optional<geometric::Mimic> mimic_of(const sdf::JointAxis& axis, const std::string& name) {
    const sdf::ElementPtr element = axis.Element();
    if (!element || !element->HasElement("mimic")) {
      return std::nullopt;
    }
    const sdf::ElementPtr mimic = element->GetElement("mimic");
    const auto number = [&](const std::string& key, double otherwise) {
      if (!mimic->HasElement(key)) {
        return otherwise;
      }
      const std::string text = mimic->Get<std::string>(key);
      const std::optional<double> found = geometric::parse_number(text);
      if (!found) {
        refuse("joint " + name + ", mimic", key + " \"" + text + "\"", "a number");
      }
      return *found;
    };
    const double multiplier = number("multiplier", 1.0);
    return geometric::Mimic{mimic->Get<std::string>("joint"), multiplier,
                            number("offset", 0.0) - multiplier * number("reference", 0.0)};
  }

  static std::vector<Joint> ball(const std::string& name) {
    constexpr double kForever = std::numeric_limits<double>::infinity();
    std::vector<Joint> turns;
    for (const auto& [turn, axis, most] :
         {std::tuple("/yaw", Eigen::Vector3d(0, 0, 1), kForever),
          std::tuple("/pitch", Eigen::Vector3d(0, 1, 0), std::numbers::pi / 2.0),
          std::tuple("/roll", Eigen::Vector3d(1, 0, 0), kForever)}) {
      Joint& joint = turns.emplace_back();
      joint.name = name + turn;
      joint.type = JointType::kRevolute;
      joint.axis = axis;
      joint.limits.lower = -most;
      joint.limits.upper = most;
    }
    return turns;
  }

  void note(const std::vector<std::string>& names, const char* what) {
    if (!names.empty()) {
      robot_.warnings.push_back(fmt::format("{}: {}", what, fmt::join(names, ", ")));
    }
  }

  RobotDescription robot_;
  fs::path folder_;
  std::map<std::string, Pose> X_RL_;  ///< Links in the robot's model.
  std::vector<std::string> left_out_;
  std::vector<std::string> unbounded_;
};

}  // namespace

RobotDescription read_sdf(const fs::path& file) { return Reader(file).read(); }

}  // namespace handway::import_sdf

extern "C" __attribute__((visibility("default"))) void handway_read_sdf(
    const std::filesystem::path& file, handway::geometric::RobotDescription& robot) {
  robot = handway::import_sdf::read_sdf(file);
}
