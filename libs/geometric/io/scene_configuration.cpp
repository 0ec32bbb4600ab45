#include "io/scene_configuration.h"

#include "handway/geometric/io/nearest_name.h"
#include "io/number_text.h"

#include <algorithm>
#include <cmath>

namespace handway::geometric {
namespace {

constexpr double kAgreement = 1e-6;  // rad or m

// The link that the named joint carries.
int carried_link(const YamlElement& element, const RobotModel& model, const std::string& name) {
  std::vector<std::string> moving;
  for (int link = 1; link < model.link_count(); ++link) {
    const bool moves = model.drive(link).variable >= 0;
    if (moves) {
      moving.push_back(model.joint(link).name);
    }
    if (model.joint(link).name == name) {
      if (!moves) {
        element.refuse("a value for the fixed joint \"" + name + "\"", "joints that move");
      }
      return link;
    }
  }
  element.refuse("the unknown joint \"" + name + "\"", "a joint of " + model.name(),
                 advise_name(name, moving));
}

}  // namespace

Configuration configuration_of(const YamlElement& element, const RobotModel& model,
                               const Configuration& defaults) {
  Configuration q = defaults;
  std::vector<std::string> given_by(static_cast<std::size_t>(model.variable_count()));
  const auto entries = element.entries();
  // Leaders first, so that the coupled joints are checked against what was said of them.
  for (const bool coupled : {false, true}) {
    for (const auto& [name, value] : entries) {
      const int link = carried_link(value, model, name);
      if (model.joint(link).mimic.has_value() != coupled) {
        continue;
      }
      const RobotModel::Drive& drive = model.drive(link);
      std::string& giver = given_by[static_cast<std::size_t>(drive.variable)];
      const double wanted = value.number();
      if (giver.empty() && drive.multiplier != 0.0) {
        q[drive.variable] = (wanted - drive.offset) / drive.multiplier;
        giver = name;
        continue;
      }
      const double follows = drive.multiplier * q[drive.variable] + drive.offset;
      if (std::abs(wanted - follows) > kAgreement) {
        value.refuse(number_text(wanted),
                     number_text(follows) + ", which follows from " +
                         (giver.empty() ? "its coupling" : "\"" + giver + "\""),
                     "Leave the coupled joint out");
      }
    }
  }
  return q;
}

NamedPosture posture_of(const YamlElement& element, const RobotModel& model,
                        const std::string& name) {
  const Configuration q = configuration_of(element, model, model.neutral());
  NamedPosture posture{name, {}, {}};
  for (const auto& [joint, value] : element.entries()) {
    const int variable = model.drive(carried_link(value, model, joint)).variable;
    posture.values[model.variable(variable).name] = q[variable];
  }
  return posture;
}

}  // namespace handway::geometric
