#include "handway/planning/grasps/grasp_file.h"

#include "handway/geometric/math/units.h"
#include "handway/planning/grasps/given_grasps.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace handway::planning {
namespace {

using Eigen::Vector3d;

// A name as YAML and JSON take it, in quotes.
std::string yaml_name(std::string_view name) {
  return nlohmann::json(std::string(name))
      .dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string list_of(const Vector3d& v) {
  return fmt::format("[{:.6g}, {:.6g}, {:.6g}]", v.x(), v.y(), v.z());
}

std::string joints_of(const geometric::RobotModel& model, const Configuration& q) {
  std::string text;
  for (int v = 0; v < model.variable_count(); ++v) {
    text +=
        fmt::format("{}{}: {:.9g}", v == 0 ? "" : ", ", yaml_name(model.variable(v).name), q[v]);
  }
  return fmt::format("{{{}}}", text);
}

}  // namespace

std::string grasp_file_text(const PlanningProblem& problem, std::string_view name,
                            const PregraspOptions& options, const Pregrasps& grasps) {
  const geometric::RobotModel& model = problem.model();
  std::string text = fmt::format(
      "handway_grasps: 1\n"
      "object: {}\n"
      "palm: {}\n"
      "friction: {}\n"
      "patch_radius: {}\n"
      "payload: {}\n"
      "seed: {}\n"
      "grasps:{}\n",
      yaml_name(name), yaml_name(grasps.palm < 0 ? "" : model.link(grasps.palm).name),
      options.contact.friction, options.contact.patch_radius, options.payload, options.seed,
      grasps.found.empty() ? " []" : "");
  for (const Pregrasp& grasp : grasps.found) {
    const geometric::Pose X_OP = as_given(problem, name, grasp, grasps.palm).X_OP;
    const Vector3d rpy = geometric::rpy_from_rotation(X_OP.linear());
    text += fmt::format(
        "  - score: {:.4f}\n"
        "    epsilon: {:.6g}\n"
        "    volume: {:.6g}\n",
        grasp.score, grasp.quality.epsilon, grasp.quality.volume);
    if (grasp.holding_force) {
      text += fmt::format("    holding_force: {:.4g}\n", *grasp.holding_force);
    }
    if (!grasp.doubt.empty()) {
      text += fmt::format("    doubt: {}\n", yaml_name(grasp.doubt));
    }
    text += fmt::format(
        "    palm_in_object: {{xyz: {}, rpy: {}}}\n"
        "    pregrasp: {}\n"
        "    grasp: {}\n"
        "    squeeze: {}\n"
        "    contacts:{}\n",
        list_of(X_OP.translation()), list_of(rpy.unaryExpr(&geometric::degrees)),
        joints_of(model, grasp.q), joints_of(model, grasp.closed), joints_of(model, grasp.squeezed),
        grasp.contacts.empty() ? " []" : "");
    for (const HandContact& contact : grasp.contacts) {
      text +=
          fmt::format("      - {{finger: {}, link: {}, point: {}, normal: {}, distance: {:.3g}}}\n",
                      contact.finger, yaml_name(contact.link), list_of(contact.contact.p_O),
                      list_of(contact.contact.normal_O), contact.distance);
    }
  }
  return text;
}

}  // namespace handway::planning
