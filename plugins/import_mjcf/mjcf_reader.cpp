#include "mjcf_reader.h"

#include "closed_loops.h"
#include "handway/geometric/formats/mesh_reader.h"
#include "handway/geometric/formats/urdf.h"
#include "handway/geometric/io/existing_file.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/text_file.h"
#include "handway/geometric/mesh/shape.h"
#include "handway/geometric/robot/base_joint.h"
#include "handway/geometric/robot/robot_description.h"
#include "handway/planning/extensions/plugin.h"
#include "mjcf_compiler.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace handway::import_mjcf {
namespace {

namespace fs = std::filesystem;
using geometric::AllowedReason;
using geometric::Joint;
using geometric::JointType;
using geometric::Pose;
using geometric::RobotDescription;

// The name of an object, or KIND_NUMBER if it has none.
std::string name_of(const mjModel& model, mjtObj kind, int index) {
  if (const char* name = mj_id2name(&model, kind, index); name != nullptr && *name != '\0') {
    return name;
  }
  return fmt::format("{}_{}", mju_type2Str(kind), index);
}

constexpr int kVisibleGroups = 3;
constexpr double kNone = 1e-12;
constexpr double kForever = std::numeric_limits<double>::infinity();

Eigen::Vector3d vector_at(const mjtNum* values, int index) {
  return {values[3 * index], values[3 * index + 1], values[3 * index + 2]};
}

Pose pose_at(const mjtNum* positions, const mjtNum* quaternions, int index) {
  const mjtNum* q = quaternions + 4 * index;
  Pose X = Pose::Identity();
  X.linear() = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix();
  X.translation() = vector_at(positions, index);
  return X;
}

class Reader {
 public:
  explicit Reader(const fs::path& file)
      : compiled_(compile_mjcf(file, robot_.warnings)), model_(std::move(compiled_.model)) {
    robot_.file = file;
    const std::string name = model_->names;  // that of the model comes first
    robot_.name = name.empty() || name == "MuJoCo Model" ? file.stem().string() : name;
  }

  RobotDescription read() {
    for (int body = 0; body < model_->nbody; ++body) {
      add_body(body);
    }
    for (int geom = 0; geom < model_->ngeom; ++geom) {
      add_geometry(geom);
    }
    settle_meshes();
    allow_collisions();
    for (int equality = 0; equality < model_->neq; ++equality) {
      if (model_->eq_active[equality] != 0) {
        add_equality(equality);
      }
    }
    const std::vector<std::string> open = open_loops();
    for (int key = 0; key < model_->nkey; ++key) {
      add_posture(key);
    }
    note(left_out_, "what is not read");
    note(compiled_.text.unread, "attributes that MuJoCo 2.2 does not know");
    note(open, "loops that are not kept closed, as joints in a loop move freely");
    note(undrawn_, "meshes that can't be read and are not drawn");
    note(unbounded_, "slides without a range, which go ±2 m");
    return std::move(robot_);
  }

 private:
  // Appends a joint and the link that it carries.
  void append(Joint joint, const std::string& child) {
    joint.child = child;
    robot_.links.push_back({child, {}, {}});
    robot_.joints.push_back(std::move(joint));
  }

  void add_body(int body) {
    const std::string name = link_of(body);
    if (body == 0) {
      robot_.links.push_back({name, {}, {}});
      return;
    }
    std::string parent = link_of(model_->body_parentid[body]);
    Pose X = pose_at(model_->body_pos, model_->body_quat, body);  // of what comes next, in `parent`
    const int first = model_->body_jntadr[body];
    const int count = model_->body_jntnum[body];
    for (int index = first; index < first + count; ++index) {
      if (model_->jnt_type[index] == mjJNT_FREE) {
        add_base_joint(robot_, {joint_name(index), geometric::BaseMotion::kFloating},
                       {parent, name, X});
        robot_.links.push_back({name, {}, {}});
        return;
      }
      // If a body has several joints, one that comes first in the file moves the later ones.
      const Eigen::Vector3d anchor = vector_at(model_->jnt_pos, index);
      X = X * Eigen::Translation3d(anchor);
      const bool is_last = index + 1 == first + count && anchor.norm() < kNone;
      parent = add_joint(index, parent, X, is_last ? name : name + "/" + joint_name(index));
      if (is_last) {
        return;
      }
      X = Pose(Eigen::Translation3d(-anchor));
    }
    Joint fixed;
    fixed.name = name + "/fixed";
    fixed.parent = parent;
    fixed.X_PJ = X;
    append(std::move(fixed), name);
  }

  // @returns the link that it carries.
  std::string add_joint(int index, const std::string& parent, const Pose& X_PJ,
                        const std::string& child) {
    const std::string name = joint_name(index);
    if (model_->jnt_type[index] == mjJNT_BALL) {
      add_ball(name, parent, X_PJ, child);
      return child;
    }
    Joint joint;
    joint.name = name;
    joint.parent = parent;
    joint.X_PJ = X_PJ;
    joint.axis = vector_at(model_->jnt_axis, index).normalized();
    joint.limits.lower = model_->jnt_range[2 * index];
    joint.limits.upper = model_->jnt_range[2 * index + 1];
    const double rest = model_->qpos0[model_->jnt_qposadr[index]];
    const bool is_limited = model_->jnt_limited[index] != 0;
    if (model_->jnt_type[index] == mjJNT_HINGE) {
      joint.type = JointType::kRevolute;
      joint.X_PJ = joint.X_PJ * Eigen::AngleAxisd(-rest, joint.axis);
      if (!is_limited) {
        joint.limits.lower = -kForever;
        joint.limits.upper = kForever;
      }
    } else {
      joint.type = JointType::kPrismatic;
      joint.X_PJ = joint.X_PJ * Eigen::Translation3d(-rest * joint.axis);
      if (!is_limited) {
        joint.limits.lower = -geometric::kDefaultBaseReach;
        joint.limits.upper = geometric::kDefaultBaseReach;
        unbounded_.push_back(name);
      }
    }
    append(std::move(joint), child);
    return child;
  }

  void add_ball(const std::string& name, std::string parent, Pose X_PJ, const std::string& child) {
    const std::pair<const char*, Eigen::Vector3d> turns[] = {{"yaw", Eigen::Vector3d::UnitZ()},
                                                             {"pitch", Eigen::Vector3d::UnitY()},
                                                             {"roll", Eigen::Vector3d::UnitX()}};
    for (const auto& [turn, axis] : turns) {
      const bool is_pitch = axis == Eigen::Vector3d::UnitY();
      Joint joint;
      joint.name = name + "/" + turn;
      joint.type = JointType::kRevolute;
      joint.parent = parent;
      joint.X_PJ = std::exchange(X_PJ, Pose::Identity());
      joint.axis = axis;
      joint.limits.upper = is_pitch ? std::numbers::pi / 2.0 : kForever;
      joint.limits.lower = -joint.limits.upper;
      parent = axis == Eigen::Vector3d::UnitX() ? child : joint.name;
      append(std::move(joint), parent);
    }
  }

  void add_geometry(int geom) {
    const mjtNum* size = model_->geom_size + 3 * geom;
    const bool collides = model_->geom_contype[geom] != 0 || model_->geom_conaffinity[geom] != 0;
    std::vector<std::pair<geometric::Shape, Pose>> shapes;
    switch (model_->geom_type[geom]) {
      case mjGEOM_SPHERE:
        shapes.emplace_back(geometric::Sphere{size[0]}, Pose::Identity());
        break;
      case mjGEOM_CAPSULE:
        shapes = geometric::capsule_shapes(size[0], 2.0 * size[1]);
        break;
      case mjGEOM_ELLIPSOID:
        shapes.emplace_back(geometric::ellipsoid_mesh({size[0], size[1], size[2]}),
                            Pose::Identity());
        break;
      case mjGEOM_CYLINDER:
        shapes.emplace_back(geometric::Cylinder{size[0], 2.0 * size[1]}, Pose::Identity());
        break;
      case mjGEOM_BOX:
        shapes.emplace_back(geometric::Box{2.0 * Eigen::Vector3d(size[0], size[1], size[2])},
                            Pose::Identity());
        break;
      case mjGEOM_MESH:
        if (const auto mesh = mesh_of(model_->geom_dataid[geom], collides)) {
          shapes.emplace_back(*mesh, Pose::Identity());
        }
        break;
      default:
        left_out_.push_back(model_->geom_type[geom] == mjGEOM_PLANE ? "a plane" : "a height field");
        return;
    }
    const int body = model_->geom_bodyid[geom];
    geometric::Link& link = *std::ranges::find(robot_.links, link_of(body), &geometric::Link::name);
    const float* rgba = model_->geom_matid[geom] >= 0
                            ? model_->mat_rgba + 4 * model_->geom_matid[geom]
                            : model_->geom_rgba + 4 * geom;
    const Pose X_LG = pose_at(model_->geom_pos, model_->geom_quat, geom);
    for (auto& [shape, X_GS] : shapes) {
      const geometric::LinkGeometry geometry{
          std::move(shape), X_LG * X_GS, {rgba[0], rgba[1], rgba[2], rgba[3]}};
      if (model_->geom_group[geom] < kVisibleGroups) {
        link.visual.push_back(geometry);
      }
      if (collides) {
        link.collision.push_back(geometry);
      }
    }
  }

  // Reads a mesh; nothing, and a warning, if it can't be read.
  [[nodiscard]] std::optional<geometric::Shape> mesh_of(int mesh, bool collides) {
    const std::string name = name_of(*model_, mjOBJ_MESH, mesh);
    const auto about = compiled_.text.meshes.find(name);
    const bool replaced = about != compiled_.text.meshes.end() &&
                          (about->second.missing || compiled_.faulty_meshes.contains(name));
    return replaced ? replaced_mesh(mesh, about->second, collides) : compiled_mesh(mesh);
  }

  // Reads a mesh that MuJoCo rejects, as a surface without volume or one of many triangles.
  [[nodiscard]] std::optional<geometric::Shape> replaced_mesh(int mesh, const MjcfMesh& about,
                                                              bool collides) {
    const std::string name = name_of(*model_, mjOBJ_MESH, mesh);
    ++replaced_[name];
    try {
      if (about.missing) {
        throw geometric::MissingMeshError({about.place, "mesh " + name,
                                           "no such file: " + about.file.string(), "a mesh",
                                           "Check the path"});
      }
      const auto read = geometric::read_mesh(about.file, Eigen::Vector3d::Ones(), about.place);
      auto triangles = std::make_shared<geometric::TriangleMesh>(*read);
      const Eigen::Matrix3d scale = scale_of(mesh);
      for (Eigen::Vector3d& vertex : triangles->vertices) {
        vertex = scale * vertex;
      }
      return geometric::Mesh{{}, Eigen::Vector3d::Ones(), std::move(triangles)};
    } catch (const geometric::InputError& fault) {
      if (collides) {
        missing_.add(fault.problem(), name);
      } else {
        undrawn_.push_back(about.file.filename().string());
      }
      return std::nullopt;
    }
  }

  // Returns MuJoCo's transformation of the box that replaces a mesh, to apply it to the mesh.
  [[nodiscard]] Eigen::Matrix3d scale_of(int mesh) const {
    const float* vertex = model_->mesh_vert + 3 * model_->mesh_vertadr[mesh];
    Eigen::Matrix3d scale;
    for (int axis = 0; axis < 3; ++axis) {
      // Corners 0 and 1, 0 and 2, 0 and 4 are the ends of an edge along x, y and z.
      const float* corner = vertex + 3 * (1 << axis);
      scale.col(axis) =
          Eigen::Vector3d(corner[0] - vertex[0], corner[1] - vertex[1], corner[2] - vertex[2]) /
          (2.0 * kStandIn.at(static_cast<std::size_t>(axis)));
    }
    return scale;
  }

  // @throws InputError if a colliding geometry has no shape.
  void settle_meshes() const {
    for (const auto& [name, mesh] : compiled_.text.meshes) {
      const auto counted = replaced_.find(name);
      const bool replaced = mesh.missing || compiled_.faulty_meshes.contains(name);
      if (replaced && mesh.geometries > (counted == replaced_.end() ? 0 : counted->second)) {
        const auto reason = compiled_.faulty_meshes.find(name);
        throw geometric::MissingMeshError({mesh.place, "mesh " + name,
                                           reason == compiled_.faulty_meshes.end()
                                               ? "no such file: " + mesh.file.string()
                                               : reason->second,
                                           "a mesh, as a shape is fitted to it", "Check the path"});
      }
    }
    missing_.refuse();
  }

  [[nodiscard]] geometric::Shape compiled_mesh(int mesh) {
    if (mesh >= static_cast<int>(meshes_.size())) {
      meshes_.resize(static_cast<std::size_t>(mesh) + 1);
    }
    auto& known = meshes_[static_cast<std::size_t>(mesh)];
    if (!known) {
      auto triangles = std::make_shared<geometric::TriangleMesh>();
      const float* vertex = model_->mesh_vert + 3 * model_->mesh_vertadr[mesh];
      for (int i = 0; i < model_->mesh_vertnum[mesh]; ++i, vertex += 3) {
        triangles->vertices.emplace_back(vertex[0], vertex[1], vertex[2]);
      }
      const int* face = model_->mesh_face + 3 * model_->mesh_faceadr[mesh];
      for (int i = 0; i < model_->mesh_facenum[mesh]; ++i, face += 3) {
        triangles->triangles.push_back({static_cast<std::uint32_t>(face[0]),
                                        static_cast<std::uint32_t>(face[1]),
                                        static_cast<std::uint32_t>(face[2])});
      }
      known = std::move(triangles);
    }
    return geometric::Mesh{{}, Eigen::Vector3d::Ones(), known};
  }

  // Returns whether geometries of the two bodies can be in contact, by their masks.
  [[nodiscard]] bool masks_meet(int a, int b) const {
    const auto geoms = [&](int body) {
      return std::pair(model_->body_geomadr[body],
                       model_->body_geomadr[body] + model_->body_geomnum[body]);
    };
    const auto [first_a, end_a] = geoms(a);
    const auto [first_b, end_b] = geoms(b);
    for (int i = first_a; i < end_a; ++i) {
      for (int j = first_b; j < end_b; ++j) {
        if ((model_->geom_contype[i] & model_->geom_conaffinity[j]) != 0 ||
            (model_->geom_contype[j] & model_->geom_conaffinity[i]) != 0) {
          return true;
        }
      }
    }
    return false;
  }

  void allow_collisions() {
    std::set<std::pair<int, int>> excluded;
    for (int i = 0; i < model_->nexclude; ++i) {
      const int signature = model_->exclude_signature[i];
      excluded.insert(std::minmax((signature >> 16) - 1, (signature & 0xFFFF) - 1));
    }
    for (int a = 0; a < model_->nbody; ++a) {
      for (int b = a + 1; b < model_->nbody; ++b) {
        // Bodies that are welded together count as one, and the world has no children of this kind.
        const int weld_a = model_->body_weldid[a];
        const int weld_b = model_->body_weldid[b];
        const auto is_parent = [&](int above, int below) {
          return above != 0 && model_->body_weldid[model_->body_parentid[below]] == above;
        };
        const bool adjacent = weld_a == weld_b || is_parent(weld_a, weld_b) ||
                              is_parent(weld_b, weld_a) || model_->body_parentid[b] == a;
        if (adjacent) {
          robot_.allowed_collisions.allow(link_of(a), link_of(b), AllowedReason::kAdjacent);
        } else if (excluded.contains({a, b}) ||
                   (has_collisions(a) && has_collisions(b) && !masks_meet(a, b))) {
          robot_.allowed_collisions.allow(link_of(a), link_of(b), AllowedReason::kUser);
        }
      }
    }
  }

  [[nodiscard]] bool has_collisions(int body) const {
    return !std::ranges::find(robot_.links, link_of(body), &geometric::Link::name)
                ->collision.empty();
  }

  void add_equality(int equality) {
    const int first = model_->eq_obj1id[equality];
    const int second = model_->eq_obj2id[equality];
    const mjtNum* data = model_->eq_data + mjNEQDATA * equality;
    const bool is_linear = data[2] == 0.0 && data[3] == 0.0 && data[4] == 0.0;
    const std::string name = name_of(*model_, mjOBJ_EQUALITY, equality);
    if (model_->eq_type[equality] == mjEQ_JOINT && is_linear) {
      const auto rest = [&](int joint) { return model_->qpos0[model_->jnt_qposadr[joint]]; };
      if (second < 0) {
        hold(first, rest(first) + data[0]);
      } else {
        couple({joint_name(first),
                {{joint_name(second), data[1]}},
                rest(first) + data[0] - data[1] * rest(second)},
               name);
      }
    } else if (model_->eq_type[equality] == mjEQ_TENDON && second < 0 && is_fixed_tendon(first)) {
      couple_along(first, model_->tendon_length0[first] + data[0], name);
    } else {
      left_out_.push_back("the equality " + name);
    }
  }

  [[nodiscard]] bool is_fixed_tendon(int tendon) const {
    return model_->wrap_type[model_->tendon_adr[tendon]] == mjWRAP_JOINT;
  }

  // Equality: the sum of coefficients times joints is `length`; the last joint follows the others.
  void couple_along(int tendon, double length, const std::string& name) {
    const int begin = model_->tendon_adr[tendon];
    const int last = begin + model_->tendon_num[tendon] - 1;
    const double by = model_->wrap_prm[last];
    if (by == 0.0) {
      left_out_.push_back("the equality " + name);
      return;
    }
    geometric::JointCoupling coupling{joint_name(model_->wrap_objid[last]), {}, length / by};
    for (int i = begin; i < last; ++i) {
      coupling.terms.emplace_back(joint_name(model_->wrap_objid[i]), -model_->wrap_prm[i] / by);
    }
    couple(coupling, name);
  }

  void couple(const geometric::JointCoupling& coupling, const std::string& name) {
    if (coupling.terms.empty()) {
      left_out_.push_back("the equality " + name);
      return;
    }
    if (coupling.terms.size() > 1) {
      couple_joint(robot_, coupling, robot_.file.string(), "equality " + name);
      return;
    }
    const auto joint = std::ranges::find(robot_.joints, coupling.joint, &Joint::name);
    if (joint->type == JointType::kFixed || joint->mimic) {
      left_out_.push_back("the equality " + name);
      return;
    }
    const auto& [leader, multiplier] = coupling.terms.front();
    joint->mimic = geometric::Mimic{leader, multiplier, coupling.offset};
  }

  // Closes the loops. @returns those that can't be closed, by the links that they connect.
  std::vector<std::string> open_loops() {
    std::map<std::string, double> home;
    for (int index = 0; index < model_->njnt; ++index) {
      home[joint_name(index)] = model_->qpos0[model_->jnt_qposadr[index]];
    }
    std::vector<std::string> open;
    for (const MjcfLoop& loop : compiled_.text.loops) {
      const std::string other = loop.second.empty() ? link_of(0) : loop.second;
      const auto has = [&](const std::string& link) {
        return std::ranges::count(robot_.links, link, &geometric::Link::name) > 0;
      };
      Eigen::Vector3d anchor;
      std::istringstream numbers(loop.anchor);
      if (!(numbers >> anchor.x() >> anchor.y() >> anchor.z()) || !has(loop.first) || !has(other) ||
          !close_loop(robot_, {loop.first, other, anchor}, home)) {
        open.push_back(loop.first + " with " + other);
      }
    }
    return open;
  }

  // A joint that an equality keeps at a value.
  void hold(int index, double value) {
    const auto joint = std::ranges::find(robot_.joints, joint_name(index), &Joint::name);
    if (joint->type == JointType::kRevolute) {
      joint->X_PJ = joint->X_PJ * Eigen::AngleAxisd(value, joint->axis);
    } else {
      joint->X_PJ = joint->X_PJ * Eigen::Translation3d(value * joint->axis);
    }
    joint->type = JointType::kFixed;
  }

  void add_posture(int key) {
    geometric::NamedPosture posture{name_of(*model_, mjOBJ_KEY, key), "", {}};
    for (int index = 0; index < model_->njnt; ++index) {
      const auto joint = std::ranges::find(robot_.joints, joint_name(index), &Joint::name);
      if (joint != robot_.joints.end() && joint->type != JointType::kFixed && !joint->mimic) {
        posture.values[joint->name] =
            model_->key_qpos[key * model_->nq + model_->jnt_qposadr[index]];
      }
    }
    robot_.postures.push_back(std::move(posture));
  }

  [[nodiscard]] std::string joint_name(int index) const {
    return name_of(*model_, mjOBJ_JOINT, index);
  }

  [[nodiscard]] std::string link_of(int body) const { return name_of(*model_, mjOBJ_BODY, body); }

  void note(std::vector<std::string> names, const char* what) {
    if (names.empty()) {
      return;
    }
    std::ranges::sort(names);
    names.erase(std::unique(names.begin(), names.end()), names.end());
    robot_.warnings.push_back(fmt::format("{}: {}", what, fmt::join(names, ", ")));
  }

  RobotDescription robot_;
  Compiled compiled_;
  ModelPointer model_;
  std::vector<std::shared_ptr<const geometric::TriangleMesh>> meshes_;
  std::vector<std::string> left_out_;
  std::vector<std::string> unbounded_;
  std::vector<std::string> undrawn_;     ///< Files of meshes.
  std::map<std::string, int> replaced_;  ///< Geometries of replaced meshes, by the meshes' names.
  geometric::MissingMeshes missing_;     ///< Collision meshes that can't be read.
};

}  // namespace

bool is_mjcf_file(const fs::path& file) {
  if (!geometric::has_extension(file, ".xml") && !geometric::has_extension(file, ".mjcf")) {
    return false;
  }
  return geometric::head_of(file).find("<mujoco") != std::string::npos;
}

RobotDescription read_mjcf(const fs::path& file) { return Reader(file).read(); }

}  // namespace handway::import_mjcf

HANDWAY_PLUGIN({.name = "import_mjcf",
                .version = HANDWAY_VERSION,
                .make_robot_readers = []() -> std::vector<handway::geometric::RobotReader> {
                  return {{"a MuJoCo robot (.xml, .mjcf)", handway::import_mjcf::is_mjcf_file,
                           handway::import_mjcf::read_mjcf}};
                }});
