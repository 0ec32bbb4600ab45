#include "hand_model.h"

#include "convex_parts.h"
#include "geom_boxes.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/math/pose.h"

#include <fmt/format.h>

#include <array>
#include <cstring>
#include <iterator>
#include <mutex>
#include <new>
#include <stdexcept>
#include <type_traits>
#include <variant>

namespace handway::simulate_mujoco {
namespace {

using Eigen::Vector3d;
using geometric::Pose;
using geometric::RobotModel;

constexpr const char* kNameInMemory = "hand.xml";

// MuJoCo handles errors by ending the program, and writes warnings to a file.
void throw_error(const char* message) { throw std::runtime_error(message); }
void ignore_warning(const char* /*message*/) {}

std::string place(const Pose& X) {
  const Eigen::Quaterniond q(X.linear());
  const Vector3d& p = X.translation();
  return fmt::format("pos='{:.12g} {:.12g} {:.12g}' quat='{:.12g} {:.12g} {:.12g} {:.12g}'", p.x(),
                     p.y(), p.z(), q.w(), q.x(), q.y(), q.z());
}

/// Writes shapes as MuJoCo's geoms.
class GeomWriter {
 public:
  /// @param name of the default class. @param density kg/m³
  std::string geoms(const geometric::Shape& shape, const Pose& X, const char* name, double density,
                    const ConvexPartsLimits& limits) {
    const auto primitive = [&](const char* type, const std::string& size) {
      return fmt::format("<geom class='{}' type='{}' size='{}' density='{}' {}/>\n", name, type,
                         size, density, place(X));
    };
    if (const auto* box = std::get_if<geometric::Box>(&shape)) {
      const Vector3d half = 0.5 * box->size;
      return primitive("box", fmt::format("{:.9g} {:.9g} {:.9g}", half.x(), half.y(), half.z()));
    }
    if (const auto* ball = std::get_if<geometric::Sphere>(&shape)) {
      return primitive("sphere", fmt::format("{:.9g}", ball->radius));
    }
    if (const auto* cylinder = std::get_if<geometric::Cylinder>(&shape)) {
      return primitive("cylinder",
                       fmt::format("{:.9g} {:.9g}", cylinder->radius, 0.5 * cylinder->length));
    }
    std::string text;
    for (const ConvexPart& part : cached_convex_parts(*geometric::tessellate(shape), limits)) {
      text += fmt::format("<geom class='{}' type='mesh' mesh='{}' mass='{:.9g}' {}/>\n", name,
                          mesh(part.corners), density * part.volume, place(X));
    }
    return text;
  }

  [[nodiscard]] const std::string& assets() const { return assets_; }

 private:
  std::string mesh(const std::vector<Vector3d>& corners) {
    std::string vertices;
    for (const Vector3d& p : corners) {
      fmt::format_to(std::back_inserter(vertices), "{:.9g} {:.9g} {:.9g} ", p.x(), p.y(), p.z());
    }
    const std::string name = fmt::format("part_{}", parts_++);
    assets_ += fmt::format("<mesh name='{}' vertex='{}'/>\n", name, vertices);
    return name;
  }

  std::string assets_;
  int parts_ = 0;
};

/// Writes the links that a palm carries.
class HandWriter {
 public:
  HandWriter(const RobotModel& robot, int palm, GeomWriter& geoms)
      : robot_(robot), palm_(palm), geoms_(geoms), carried_(is_carried()) {}

  std::string body(int link) {
    std::string text =
        fmt::format("<body name='{}' {}>\n", body_name(link),
                    place(link == palm_ ? Pose::Identity() : robot_.joint(link).X_PJ));
    if (link != palm_ && robot_.mimic_mapping(link).variable >= 0) {
      text += joint(link);
    }
    text += kLeastInertia;
    for (const geometric::LinkGeometry& part : robot_.link(link).collision) {
      const std::string shape = geoms_.geoms(part.shape, part.X_LG, "hand", 0.0, kLinkParts);
      has_shape_ = has_shape_ || !shape.empty();
      text += shape;
    }
    for (int child = link + 1; child < robot_.link_count(); ++child) {
      if (robot_.parent(child) == link) {
        text += body(child);
      }
    }
    return text + "</body>\n";
  }

  [[nodiscard]] const std::string& actuators() const { return actuators_; }
  [[nodiscard]] const std::string& equalities() const { return equalities_; }
  [[nodiscard]] bool has_shape() const { return has_shape_; }
  [[nodiscard]] const std::vector<int>& moving_links() const { return moving_links_; }
  [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  static constexpr ConvexPartsLimits kLinkParts{2e-4, 12};
  // Fingers are driven, so their inertia matters little; that of shells and rods would be a guess.
  static constexpr const char* kLeastInertia =
      "<inertial pos='0 0 0' mass='0.05' diaginertia='2e-5 2e-5 2e-5'/>\n";

  [[nodiscard]] std::vector<bool> is_carried() const {
    std::vector<bool> carried(static_cast<std::size_t>(robot_.link_count()), false);
    for (int link = palm_ + 1; link < robot_.link_count(); ++link) {
      const int parent = robot_.parent(link);
      carried[static_cast<std::size_t>(link)] =
          parent == palm_ || carried[static_cast<std::size_t>(parent)];
    }
    return carried;
  }

  std::string joint(int link) {
    const geometric::Joint& joint = robot_.joint(link);
    const RobotModel::MimicMapping& mapping = robot_.mimic_mapping(link);
    const int leader = robot_.variable_link(mapping.variable);
    if (leader != link && !carried_[static_cast<std::size_t>(leader)]) {
      warnings_.push_back(
          fmt::format("Joint {} follows one before the palm, and stands still.", joint.name));
      return {};
    }
    moving_links_.push_back(link);
    const bool slides = joint.type == geometric::JointType::kPrismatic;
    if (leader == link) {
      actuators_ += fmt::format("<position name='drive_{0}' joint='joint_{0}' kp='1'/>\n", link);
    } else {
      equalities_ += fmt::format(
          "<joint joint1='joint_{}' joint2='joint_{}' polycoef='{:.12g} {:.12g} 0 0 0'/>\n", link,
          leader, mapping.offset, mapping.multiplier);
    }
    return fmt::format(
        "<joint name='joint_{}' type='{}' axis='{:.12g} {:.12g} {:.12g}' damping='{}' "
        "armature='{}'{}/>\n",
        link, slides ? "slide" : "hinge", joint.axis.x(), joint.axis.y(), joint.axis.z(),
        slides ? 5.0 : 0.1, slides ? 0.05 : 0.0005,
        joint.is_continuous()
            ? std::string()
            : fmt::format(" range='{:.12g} {:.12g}'", joint.limits.lower, joint.limits.upper));
  }

  const RobotModel& robot_;
  int palm_;
  GeomWriter& geoms_;
  std::vector<bool> carried_;
  std::string actuators_;
  std::string equalities_;
  bool has_shape_ = false;
  std::vector<int> moving_links_;
  std::vector<std::string> warnings_;
};

int find(const mjModel& model, mjtObj kind, const std::string& name) {
  return mj_name2id(&model, kind, name.c_str());
}

// Friction and control get their values from the conditions of each test.
std::string mjcf_of(const std::string& assets, const std::string& bodies, const HandWriter& hand) {
  return fmt::format(
      "<mujoco>"
      "<compiler angle='radian' autolimits='true' boundmass='1e-6' boundinertia='1e-10'/>"
      "{}"
      "<default>"
      "<default class='hand'><geom condim='4' contype='1' conaffinity='2'/></default>"
      "<default class='object'><geom condim='4' contype='2' conaffinity='1'/></default>"
      "</default>"
      "<asset>{}</asset><worldbody>{}</worldbody>"
      "<equality>{}</equality><actuator>{}</actuator></mujoco>",
      kSolver, assets, bodies, hand.equalities(), hand.actuators());
}

void find_joints(const RobotModel& robot, const std::vector<int>& links, HandModel& made) {
  for (const int link : links) {
    const int joint = find(*made.model, mjOBJ_JOINT, fmt::format("joint_{}", link));
    const int drive = find(*made.model, mjOBJ_ACTUATOR, fmt::format("drive_{}", link));
    made.joints.push_back({link, made.model->jnt_qposadr[joint], drive});
    if (drive >= 0) {
      const bool slides = robot.joint(link).type == geometric::JointType::kPrismatic;
      (slides ? made.slides : made.rotations).push_back(drive);
    }
  }
}

}  // namespace

void ModelDeleter::operator()(mjModel* model) const { mj_deleteModel(model); }
void DataDeleter::operator()(mjData* data) const { mj_deleteData(data); }

ModelPointer compile(const std::string& mjcf) {
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  mju_user_error = throw_error;
  mju_user_warning = ignore_warning;
  install_box_filter();
  const auto files = std::make_unique<mjVFS>();
  mj_defaultVFS(files.get());
  const std::unique_ptr<mjVFS, void (*)(mjVFS*)> guard(files.get(), mj_deleteVFS);
  if (mj_makeEmptyFileVFS(files.get(), kNameInMemory, static_cast<int>(mjcf.size())) != 0) {
    throw std::runtime_error("no memory for the model");
  }
  std::memcpy(files->filedata[mj_findFileVFS(files.get(), kNameInMemory)], mjcf.data(),
              mjcf.size());
  std::array<char, 1024> message{};
  ModelPointer model(
      mj_loadXML(kNameInMemory, files.get(), message.data(), static_cast<int>(message.size())));
  if (!model) {
    throw std::runtime_error(message.data());
  }
  set_geom_boxes(*model);
  return model;
}

std::string body_name(int link) { return fmt::format("link_{}", link); }

DataPointer make_data(const mjModel& model) {
  DataPointer data(mj_makeData(&model));
  if (!data) {
    throw std::bad_alloc();
  }
  return data;
}

HandModel hand_model(const RobotModel& robot, int palm, const geometric::SceneObject& object) {
  GeomWriter geoms;
  HandWriter hand(robot, palm, geoms);
  const std::string links = hand.body(palm);
  constexpr ConvexPartsLimits kObjectParts{2e-4, 48};
  constexpr double kAnyDensity = 1000.0;  // kg/m³; each test scales the mass
  const std::string shapes =
      geoms.geoms(object.shape, Pose::Identity(), "object", kAnyDensity, kObjectParts);
  if (shapes.empty()) {
    throw geometric::InputError({"object " + object.name, "", "a flat surface",
                                 "an object with a volume, to simulate it", ""});
  }
  if (!hand.has_shape()) {
    throw geometric::InputError({"robot " + robot.name(), "link " + robot.link(palm).name,
                                 "a hand without collision geometry",
                                 "links with a volume, to simulate it", ""});
  }
  HandModel made;
  const std::string bodies =
      links + "<body name='object'><freejoint name='object'/>" + shapes + "</body>";
  try {
    made.model = compile(mjcf_of(geoms.assets(), bodies, hand));
  } catch (const std::runtime_error& error) {
    throw geometric::InputError(
        {"object " + object.name, "", error.what(), "a hand and an object that MuJoCo takes", ""});
  }
  find_joints(robot, hand.moving_links(), made);
  made.object_body = find(*made.model, mjOBJ_BODY, "object");
  made.object_position = made.model->jnt_qposadr[find(*made.model, mjOBJ_JOINT, "object")];
  made.warnings = hand.warnings();
  return made;
}

}  // namespace handway::simulate_mujoco
