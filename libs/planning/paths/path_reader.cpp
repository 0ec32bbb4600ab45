#include "handway/geometric/formats/joint_table.h"
#include "handway/geometric/formats/yaml_element.h"
#include "handway/geometric/io/existing_file.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/plural.h"
#include "handway/geometric/io/text_file.h"
#include "handway/geometric/math/units.h"
#include "handway/planning/paths/path_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace handway::planning {
namespace {

using geometric::Configuration;
using geometric::InputError;
using geometric::RobotModel;

constexpr const char* kWhat = "a path: a table with joint names in its header, or messages";
constexpr double kSlack = 1e-3;              // rad, of limits that degrees fit in
constexpr double kCouplingTolerance = 1e-4;  // rad or m
constexpr double kJump = 1.0;                // rad: far above rounding, far below a turn
constexpr std::size_t kMostNamed = 6;        // most joints at rest to name; of more, …
constexpr std::size_t kFirstNamed = 3;       // … the first ones

/// The link moved by the moving joint of this name; nothing without such a joint.
std::optional<int> moving_link(const RobotModel& model, std::string_view name) {
  for (int i = 1; i < model.link_count(); ++i) {
    if (model.joint(i).name == name && model.mimic_mapping(i).variable >= 0) {
      return i;
    }
  }
  return std::nullopt;
}

/// The joints with values in a file's columns; values of coupled joints are checked.
class JointColumns {
 public:
  JointColumns(const RobotModel& model, JointsAtRest* rest) : model_(model), rest_(rest) {}

  /// @returns whether the robot has such a moving joint.
  bool append(std::string_view name) {
    const int link = moving_link(model_, name).value_or(0);
    links_.push_back(link);
    return link > 0;
  }
  void append_link(int link, int times) {
    links_.insert(links_.end(), static_cast<std::size_t>(times), link);
  }

  /// Returns an independent joint with its number of columns if that isn't 1, nor 0 at rest or
  /// where a coupled joint determines it.
  [[nodiscard]] std::optional<std::pair<std::string, std::ptrdiff_t>> miscounted() const {
    for (int v = 0; v < model_.variable_count(); ++v) {
      const auto count = std::ranges::count(links_, model_.variable_link(v));
      if (count == 0 &&
          std::ranges::any_of(links_, [&](int link) { return determines(link, v); })) {
        continue;
      }
      if (count == 0 && rest_) {
        rest_->names.push_back(model_.variable(v).name);
      } else if (count != 1) {
        return std::pair(model_.variable(v).name, count);
      }
    }
    return std::nullopt;
  }

  /// @param refuse called with a column that contradicts a coupling, and the right value.
  template <typename Refuse>
  [[nodiscard]] Configuration configuration(const Eigen::VectorXd& values,
                                            const Refuse& refuse) const {
    Configuration q = rest_ ? rest_->q : model_.neutral();
    for (Eigen::Index c = 0; c < values.size(); ++c) {
      const int link = links_[static_cast<std::size_t>(c)];
      const RobotModel::MimicMapping& mapping = model_.mimic_mapping(link);
      if (link > 0 && model_.variable_link(mapping.variable) == link) {
        q[mapping.variable] = values[c];
      } else if (link > 0 && determines(link, mapping.variable) &&
                 std::ranges::count(links_, model_.variable_link(mapping.variable)) == 0) {
        q[mapping.variable] = (values[c] - mapping.offset) / mapping.multiplier;
      }
    }
    for (Eigen::Index c = 0; c < values.size(); ++c) {
      const int link = links_[static_cast<std::size_t>(c)];
      const double coupled = link > 0 ? geometric::joint_value(model_, link, q) : values[c];
      if (std::abs(values[c] - coupled) > kCouplingTolerance) {
        refuse(static_cast<std::size_t>(c),
               fmt::format("{:.6f}, as coupled to joint {}", coupled,
                           model_.variable(model_.mimic_mapping(link).variable).name));
      }
    }
    return q;
  }

 private:
  // Returns whether the value of a link's joint gives that of a variable.
  [[nodiscard]] bool determines(int link, int variable) const {
    return link > 0 && model_.mimic_mapping(link).variable == variable &&
           model_.mimic_mapping(link).multiplier != 0.0;
  }

  const RobotModel& model_;
  JointsAtRest* rest_;
  std::vector<int> links_;  ///< 0: not a joint's.
};

// Returns whether a path begins at the start with an angle that is another one in degrees.
bool begins_at_start(const RobotModel& model, const Configuration& first,
                     const JointsAtRest& rest) {
  constexpr double kTelling = 0.1;  // rad
  bool is_telling = false;
  for (int v = 0; v < model.variable_count() && rest.q.size() == first.size(); ++v) {
    const geometric::Joint& joint = model.variable(v);
    if (joint.type == geometric::JointType::kPrismatic ||
        std::ranges::count(rest.names, joint.name) > 0) {
      continue;
    }
    if (std::abs(first[v] - rest.q[v]) > kSlack) {
      return false;
    }
    is_telling |= std::abs(first[v]) > kTelling;
  }
  return is_telling;
}

/// Refuses angles that are far beyond limits in rad, but all within them in degrees. Continuous
/// joints may have turned several times in a path that begins at the start.
void refuse_degrees(const RobotModel& model, const Path& path, const std::filesystem::path& file,
                    const JointsAtRest* rest) {
  std::optional<std::pair<int, double>> farthest;  // a variable and its value
  bool fits_in_degrees = true;
  const bool is_in_rad = rest && begins_at_start(model, path.waypoints.front(), *rest);
  for (const Configuration& q : path.waypoints) {
    for (int v = 0; v < model.variable_count(); ++v) {
      const geometric::Joint& joint = model.variable(v);
      if (joint.type == geometric::JointType::kPrismatic) {
        continue;
      }
      const double value = geometric::kDegree * q[v];
      fits_in_degrees &= value > model.lower()[v] - kSlack && value < model.upper()[v] + kSlack;
      const bool is_beyond = std::abs(q[v]) > 2.0 * std::numbers::pi &&
                             (q[v] < model.lower()[v] || q[v] > model.upper()[v]) &&
                             !(is_in_rad && model.is_continuous(v));
      if (is_beyond && (!farthest || std::abs(q[v]) > std::abs(farthest->second))) {
        farthest = {v, q[v]};
      }
    }
  }
  if (farthest && fits_in_degrees) {
    const auto& [v, value] = *farthest;
    const std::string& name = model.variable(v).name;
    const bool is_endless = model.is_continuous(v);
    throw InputError(
        {file.string(), "joint " + name,
         is_endless
             ? fmt::format("values up to {:.6g} of a joint that turns without end", value)
             : fmt::format("values up to {:.6g}, where the joint goes from {:.4g} to {:.4g} rad",
                           value, model.lower()[v], model.upper()[v]),
         "angles in rad",
         fmt::format("These look like degrees: convert them, or name the unit above the columns, "
                     "as \"{0} [deg]\"{1}",
                     name, is_endless ? fmt::format(" or \"{} [rad]\"", name) : "")});
  }
}

/// Paths as tables, and as messages of the joints' states.
class TableReader {
 public:
  TableReader(const RobotModel& model, const std::filesystem::path& file, JointsAtRest* rest)
      : model_(model), file_(file), rest_(rest), columns_(model, rest) {}

  Path read() {
    const geometric::JointLookup lookup = [this](std::string_view name) {
      return moving_link(model_, name);
    };
    table_ = geometric::read_joint_table(file_, lookup, model_.link_count(), kWhat);
    take_columns();
    Path path;
    Eigen::VectorXd latest =
        Eigen::VectorXd::Constant(model_.link_count(), std::numeric_limits<double>::quiet_NaN());
    for (std::size_t row = 0; row < table_.values.size(); ++row) {
      const Eigen::VectorXd& values = table_.values[row];
      latest = table_.holds ? values.array().isNaN().select(latest, values).eval() : values;
      if (const Eigen::VectorXd taken = latest(links_); taken.allFinite()) {
        path.waypoints.push_back(configuration(taken, row));
      }
    }
    if (path.waypoints.size() < 2) {
      throw InputError({file_.string(), "", geometric::plural(path.waypoints.size(), "waypoint"),
                        "at least 2", ""});
    }
    if (!table_.units_are_named) {
      refuse_degrees(model_, path, file_, rest_);
    }
    return path;
  }

 private:
  void take_columns() {
    for (int link = 1; link < model_.link_count(); ++link) {
      const int count = table_.columns[static_cast<std::size_t>(link)];
      if (count == 0) {
        continue;
      }
      // The first column of a coupled joint is enough.
      const bool is_own = model_.variable_link(model_.mimic_mapping(link).variable) == link;
      columns_.append_link(link, is_own ? count : 1);
      links_.push_back(link);
    }
    if (links_.empty() && !table_.others.empty()) {
      refuse_other(*table_.others.begin(), "");
    }
    refuse_slips();
    if (const auto joint = columns_.miscounted()) {
      throw InputError(
          {top(), "",
           fmt::format("{} for joint {}", geometric::plural(joint->second, "column"), joint->first),
           "one", ""});
    }
    if (table_.bad_cell) {
      throw InputError({fmt::format("{}:{}", file_.string(), table_.bad_cell->line),
                        "column " + table_.bad_cell->column,
                        fmt::format("\"{}\"", table_.bad_cell->text), "a finite number", ""});
    }
    if (table_.is_cut_off) {
      throw InputError({file_.string(), "the last row", "fewer values than in the header",
                        "a whole path", "Was it cut off? Remove the row, or write the path again"});
    }
    if (rest_ != nullptr) {
      rest_->passed_over.assign(table_.others.begin(), table_.others.end());
    }
  }

  // A column of no joint that may be a misspelt joint.
  void refuse_slips() const {
    std::vector<std::string> missing;
    for (int v = 0; v < model_.variable_count(); ++v) {
      const auto link = static_cast<std::size_t>(model_.variable_link(v));
      if (table_.columns[link] == 0) {
        missing.push_back(model_.variable(v).name);
      }
    }
    for (const std::string& other : table_.others) {
      if (const auto meant = geometric::slip_of(other, missing)) {
        refuse_other(other, fmt::format("Did you mean \"{}\"?", *meant));
      }
    }
  }

  [[noreturn]] void refuse_other(const std::string& other, const std::string& advice) const {
    throw InputError({top(), "column \"" + other + "\"",
                      "no joint of robot " + model_.name() + " that moves",
                      "\"time\" or a joint's name", advice});
  }

  [[nodiscard]] Configuration configuration(const Eigen::VectorXd& values, std::size_t row) const {
    // A joint that occurs twice has been refused: columns are the links in their order.
    return columns_.configuration(values, [&](std::size_t column, const std::string& expected) {
      throw InputError(
          {table_.lines.empty() ? fmt::format("{}, message {}", file_.string(), row + 1)
                                : fmt::format("{}:{}", file_.string(), table_.lines[row]),
           "column " + model_.joint(links_[column]).name,
           fmt::format("{}", values[static_cast<Eigen::Index>(column)]), expected, ""});
    });
  }

  [[nodiscard]] std::string top() const { return file_.string() + ":1"; }

  const RobotModel& model_;
  const std::filesystem::path& file_;
  JointsAtRest* rest_;
  JointColumns columns_;
  std::vector<int> links_;  ///< With a column.
  geometric::JointTable table_;
};

using geometric::YamlElement;

// A JointTrajectory in a file of messages: the top, or the field of that name in an outer message.
YamlElement trajectory_in(const YamlElement& top) {
  if (top.is_list() && !top.items().empty()) {
    const std::vector<YamlElement> all = top.items();
    if (all.size() > 1) {
      top.refuse(fmt::format("{} trajectories", all.size()), "one",
                 "Write each to a file of its own.");
    }
    return trajectory_in(all.front());
  }
  for (const char* key : {"joint_trajectory", "trajectory", "goal"}) {
    if (const std::optional<YamlElement> inner = top.find(key)) {
      return trajectory_in(*inner);
    }
  }
  return top;
}

// Lists names that no moving joint has as passed over, or refuses them: misspelt joints, and names
// of which none is known.
void take_unknown_names(const RobotModel& model, const std::vector<YamlElement>& names,
                        const std::vector<YamlElement>& unknown, JointsAtRest* rest) {
  std::vector<std::string> missing;
  for (int v = 0; v < model.variable_count(); ++v) {
    const std::string& joint = model.variable(v).name;
    if (std::ranges::none_of(names,
                             [&](const YamlElement& name) { return name.text() == joint; })) {
      missing.push_back(joint);
    }
  }
  if (rest) {
    rest->passed_over.clear();
  }
  for (const YamlElement& name : unknown) {
    const std::optional<std::string> meant = geometric::slip_of(name.text(), missing);
    if (meant || unknown.size() == names.size()) {
      name.refuse(fmt::format("\"{}\"", name.text()),
                  "a joint of robot " + model.name() + " that moves",
                  meant ? fmt::format("Did you mean \"{}\"?", *meant) : "");
    }
    if (rest) {
      rest->passed_over.push_back(name.text());
    }
  }
}

bool is_joint_trajectory(std::string_view head) {
  const std::size_t names = head.find("joint_names");
  return names != std::string_view::npos &&
         (geometric::has_joint_messages(head) || head.find("points") != std::string_view::npos);
}

Path read_joint_trajectory(const RobotModel& model, const std::filesystem::path& file,
                           JointsAtRest* rest) {
  const YamlElement trajectory =
      trajectory_in(YamlElement::read(file, "a trajectory_msgs/JointTrajectory (YAML or JSON)"));
  const YamlElement names = trajectory.need("joint_names");
  JointColumns columns(model, rest);
  const std::vector<YamlElement> joints = names.items();
  std::vector<YamlElement> unknown;
  for (const YamlElement& name : joints) {
    if (!columns.append(name.text())) {
      unknown.push_back(name);
    }
  }
  take_unknown_names(model, joints, unknown, rest);
  if (const auto joint = columns.miscounted()) {
    names.refuse(fmt::format("joint {} {} times", joint->first, joint->second), "once");
  }
  Path path;
  for (const YamlElement& point : trajectory.need("points").items()) {
    const Eigen::VectorXd positions =
        point.need("positions").numbers(static_cast<int>(joints.size()));
    path.waypoints.push_back(
        columns.configuration(positions, [&](std::size_t joint, const std::string& expected) {
          point.refuse(fmt::format("{} for joint {}", positions[static_cast<Eigen::Index>(joint)],
                                   joints[joint].text()),
                       expected);
        }));
  }
  if (path.waypoints.size() < 2) {
    trajectory.need("points").refuse(geometric::plural(path.waypoints.size(), "waypoint"),
                                     "at least 2");
  }
  refuse_degrees(model, path, file, rest);
  return path;
}

// Replaces large rotations of continuous joints by the short ones. @returns JointsAtRest::jumps.
std::vector<std::string> unwrap(const RobotModel& model, Path& path) {
  const std::vector<Configuration> as_read = std::move(path.waypoints);
  path.waypoints = model.unwrapped(as_read, as_read.front());
  std::vector<std::string> jumps;
  for (int v = 0; v < model.variable_count(); ++v) {
    for (std::size_t w = 1; w < as_read.size(); ++w) {
      const double jump = as_read[w][v] - as_read[w - 1][v];
      if (std::abs(jump - (path.waypoints[w][v] - path.waypoints[w - 1][v])) > kJump) {
        jumps.push_back(fmt::format("joint {} jumps by {:.0f}° after waypoint {}",
                                    model.variable(v).name, geometric::degrees(jump), w));
        break;
      }
    }
  }
  return jumps;
}

/// "a, b, c and 4 more".
std::string some_of(const std::vector<std::string>& names) {
  const std::span named(names.begin(), names.size() > kMostNamed ? kFirstNamed : names.size());
  const std::size_t others = names.size() - named.size();
  return fmt::format("{}{}", fmt::join(named, ", "),
                     others > 0 ? fmt::format(" and {} more", others) : "");
}

}  // namespace

std::string JointsAtRest::remark(const std::filesystem::path& file) const {
  std::vector<std::string> parts;
  if (!names.empty()) {
    parts.push_back(fmt::format("{} does not have all joints: {} stay{} at the start",
                                file.string(), some_of(names), names.size() == 1 ? "s" : ""));
  }
  if (!jumps.empty()) {
    parts.push_back(
        fmt::format("{}; continuous joints take the shorter rotation", fmt::join(jumps, ", ")));
  }
  if (!passed_over.empty()) {
    parts.push_back("ignored names that no moving joint of the robot has: " + some_of(passed_over));
  }
  const std::string source = names.empty() && !parts.empty() ? file.string() + ": " : "";
  return fmt::format("{}{}", source, fmt::join(parts, "; "));
}

bool is_path_file(const std::filesystem::path& file) {
  const std::string head = geometric::head_of(file);
  return geometric::has_extension(file, ".csv") || head.find("joint_names") != std::string::npos ||
         geometric::has_joint_messages(head);
}

Path read_path(const RobotModel& model, const std::filesystem::path& file, JointsAtRest* rest) {
  Path path = is_joint_trajectory(geometric::head_of(file))
                  ? read_joint_trajectory(model, file, rest)
                  : TableReader(model, file, rest).read();
  std::vector<std::string> jumps = unwrap(model, path);
  if (rest) {
    rest->jumps = std::move(jumps);
  }
  return path;
}

}  // namespace handway::planning
