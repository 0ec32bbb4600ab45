#include "handway/geometric/robot/limit_violation.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/plural.h"
#include "handway/geometric/math/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace handway::geometric {

namespace {

double value_of(const RobotModel& model, int link, const Configuration& q) {
  const auto& [variable, multiplier, offset] = model.mimic_mapping(link);
  return multiplier * q[variable] + offset;
}

bool violates(const RobotModel& model, int link, const Configuration& q,
              std::span<const int> fixed) {
  const int variable = model.mimic_mapping(link).variable;
  if (variable < 0 || std::ranges::count(fixed, variable) > 0) {
    return false;
  }
  const double value = value_of(model, link, q);
  const auto& [lower, upper] =
      std::pair(model.joint(link).limits.lower, model.joint(link).limits.upper);
  return value < lower - limit_tolerance(lower) || value > upper + limit_tolerance(upper);
}

// Formats "22.9°" or "0.4 mm", with two digits of amounts below a tenth.
std::string amount(const LimitViolation& violation, double beyond) {
  const bool slides = violation.type == JointType::kPrismatic;
  const double shown = slides ? millimetres(beyond) : degrees(beyond);
  return fmt::format("{}{}",
                     shown < 0.1 ? fmt::format("{:.2g}", shown) : fmt::format("{:.1f}", shown),
                     slides ? " mm" : "°");
}

}  // namespace

std::string configuration_fault(const RobotModel& model, const Configuration& q) {
  if (q.size() != model.variable_count()) {
    return fmt::format("has {} values where the robot has {} variables", q.size(),
                       model.variable_count());
  }
  for (int v = 0; v < model.variable_count(); ++v) {
    if (!std::isfinite(q[v])) {
      return "has no number for joint " + model.variable(v).name;
    }
  }
  return "";
}

std::vector<LimitViolation> limit_violations(const RobotModel& model, const Configuration& q,
                                             std::span<const int> fixed) {
  std::vector<int> links;
  std::set<int> explained;  // variables that a coupled joint is named for
  for (int link = 1; link < model.link_count(); ++link) {
    if (violates(model, link, q, fixed)) {
      links.push_back(link);
      if (const int variable = model.mimic_mapping(link).variable;
          model.variable_link(variable) != link) {
        explained.insert(variable);
      }
    }
  }
  std::vector<LimitViolation> violations;
  for (const int link : links) {
    const int variable = model.mimic_mapping(link).variable;
    const bool follows = model.variable_link(variable) != link;
    if (follows || !explained.contains(variable)) {
      const Joint& joint = model.joint(link);
      violations.push_back({joint.name, value_of(model, link, q), joint.limits.lower,
                            joint.limits.upper, follows ? model.variable(variable).name : "",
                            joint.type});
    }
  }
  return violations;
}

void require_configuration(const RobotModel& model, const Configuration& q,
                           const std::string& source, std::span<const int> fixed) {
  if (q.size() != model.variable_count()) {
    throw InputError({source, "", plural(q.size(), "value"),
                      fmt::format("{}, one a joint", model.variable_count()), ""});
  }
  for (int v = 0; v < model.variable_count(); ++v) {
    if (!std::isfinite(q[v])) {
      throw InputError({source, "joint " + model.variable(v).name, fmt::format("{}", q[v]),
                        "a finite number", ""});
    }
  }
  const std::vector<LimitViolation> violations = limit_violations(model, q, fixed);
  if (!violations.empty()) {
    const LimitViolation& first = violations.front();
    throw InputError({source, "joint " + first.joint, fmt::format("{:.6g}", first.value),
                      fmt::format("{:.6g} to {:.6g}", first.lower, first.upper), ""});
  }
}

// Formats with as many digits as needed to distinguish the value from the limit.
std::string to_string(const LimitViolation& violation) {
  const double limit = violation.value < violation.lower ? violation.lower : violation.upper;
  const auto text = [](double number, int digits) {
    return fmt::format("{:.{}f}", number, digits);
  };
  int digits = 4;
  while (digits < 9 && text(violation.value, digits) == text(limit, digits)) {
    ++digits;
  }
  return fmt::format("joint {} at {} {}, allowed {} to {} ({} beyond){}", violation.joint,
                     text(violation.value, digits),
                     violation.type == JointType::kPrismatic ? "m" : "rad",
                     text(violation.lower, digits), text(violation.upper, digits),
                     amount(violation, std::abs(violation.value - limit)),
                     violation.leader.empty() ? "" : "; it follows " + violation.leader);
}

}  // namespace handway::geometric
