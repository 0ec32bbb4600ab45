#include "handway/planning/paths/path_file.h"

#include "handway/geometric/formats/yaml_element.h"
#include "handway/geometric/io/existing_file.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/number_text.h"
#include "handway/geometric/io/replace_file.h"
#include "handway/geometric/io/text_file.h"
#include "handway/geometric/math/units.h"
#include "handway/planning/core/objective.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

namespace handway::planning {
namespace {

using geometric::Configuration;
using geometric::InputError;
using geometric::RobotModel;

constexpr std::size_t kLargestFile = std::size_t{256} << 20;
constexpr double kCouplingTolerance = 1e-4;  // rad or m
constexpr double kJump = 1.0;                // rad: far above rounding, far below a turn
constexpr std::size_t kMostNamed = 6;        // of joints at rest; of more
constexpr std::size_t kFirstNamed = 3;       // these

char separator_of(const std::string& header) {
  for (const char separator : {',', ';', '\t', ' '}) {
    if (header.find(separator) != std::string::npos) {
      return separator;
    }
  }
  return ',';
}

/// The joints that a file's columns hold values of; what couplings make of them is checked.
class JointColumns {
 public:
  JointColumns(const RobotModel& model, JointsAtRest* rest) : model_(model), rest_(rest) {}

  /// @returns whether the robot has such a joint, and it moves; a column of something else if not.
  bool append(std::string_view name) {
    int link = 0;
    for (int i = 1; i < model_.link_count(); ++i) {
      link = model_.joint(i).name == name && model_.drive(i).variable >= 0 ? i : link;
    }
    links_.push_back(link);
    return link > 0;
  }

  /// A joint that moves on its own, and its number of columns where that isn't 1, nor 0 at rest.
  [[nodiscard]] std::optional<std::pair<std::string, std::ptrdiff_t>> miscounted() const {
    for (int v = 0; v < model_.variable_count(); ++v) {
      const auto count = std::ranges::count(links_, model_.variable_link(v));
      if (count == 0 && rest_) {
        rest_->names.push_back(model_.variable(v).name);
      } else if (count != 1) {
        return std::pair(model_.variable(v).name, count);
      }
    }
    return std::nullopt;
  }

  /// @param refuse called with a column that does not agree with a coupling, and what would.
  template <typename Refuse>
  [[nodiscard]] Configuration configuration(const Eigen::VectorXd& values,
                                            const Refuse& refuse) const {
    Configuration q = rest_ ? rest_->q : model_.neutral();
    for (Eigen::Index c = 0; c < values.size(); ++c) {
      const int link = links_[static_cast<std::size_t>(c)];
      const int variable = model_.drive(link).variable;
      if (link > 0 && model_.variable_link(variable) == link) {
        q[variable] = values[c];
      }
    }
    for (Eigen::Index c = 0; c < values.size(); ++c) {
      const int link = links_[static_cast<std::size_t>(c)];
      const double coupled = link > 0 ? geometric::joint_value(model_, link, q) : values[c];
      if (std::abs(values[c] - coupled) > kCouplingTolerance) {
        refuse(static_cast<std::size_t>(c),
               fmt::format("{:.6f}, as coupled to joint {}", coupled,
                           model_.variable(model_.drive(link).variable).name));
      }
    }
    return q;
  }

 private:
  const RobotModel& model_;
  JointsAtRest* rest_;
  std::vector<int> links_;  ///< 0: of something else.
};

class TableReader {
 public:
  TableReader(const RobotModel& model, const std::filesystem::path& file, JointsAtRest* rest)
      : model_(model), file_(file), columns_(model, rest) {}

  Path read() {
    std::istringstream in(
        geometric::read_text_file(file_, "a CSV path with a header", kLargestFile));
    std::string line;
    std::getline(in, line);
    read_header(line);
    Path path;
    for (line_ = 2; std::getline(in, line); ++line_) {
      if (line.find_first_not_of(" \t\r") != std::string::npos) {
        path.waypoints.push_back(read_row(line));
      }
    }
    if (path.waypoints.size() < 2) {
      throw InputError({file_.string(), "", fmt::format("{} waypoints", path.waypoints.size()),
                        "at least 2", ""});
    }
    return path;
  }

 private:
  void read_header(const std::string& line) {
    separator_ = separator_of(line);
    for (const std::string_view name : geometric::cells(line, separator_)) {
      header_.emplace_back(name);
      if (!columns_.append(name) && name != "time" && !is_rate(header_.back())) {
        throw InputError({file_.string() + ":1", "column \"" + header_.back() + "\"",
                          "no joint of robot " + model_.name() + " that moves",
                          "\"time\" or a joint's name", ""});
      }
    }
    if (const auto joint = columns_.miscounted()) {
      throw InputError({file_.string() + ":1", "",
                        fmt::format("{} columns for joint {}", joint->second, joint->first), "one",
                        ""});
    }
  }

  /// "JOINT.velocity" or "JOINT.acceleration", which timed paths have.
  [[nodiscard]] bool is_rate(const std::string& column) const {
    const std::size_t dot = column.rfind('.');
    const std::string rate = dot == std::string::npos ? "" : column.substr(dot);
    return (rate == ".velocity" || rate == ".acceleration") &&
           model_.find_variable(column.substr(0, dot)).has_value();
  }

  Configuration read_row(const std::string& line) {
    const std::vector<std::string_view> row = geometric::cells(line, separator_);
    if (row.size() != header_.size()) {
      throw InputError({at_line(), "", fmt::format("{} values", row.size()),
                        fmt::format("{} as in the header", header_.size()), ""});
    }
    Eigen::VectorXd values(static_cast<Eigen::Index>(row.size()));
    for (std::size_t c = 0; c < row.size(); ++c) {
      values[static_cast<Eigen::Index>(c)] = number(row[c], header_[c]);
    }
    return columns_.configuration(values, [&](std::size_t column, const std::string& expected) {
      throw InputError(
          {at_line(), "column " + header_[column], std::string(row[column]), expected, ""});
    });
  }

  [[nodiscard]] double number(std::string_view cell, const std::string& column) const {
    const std::optional<double> value = geometric::parse_number(cell);
    if (!value) {
      throw InputError(
          {at_line(), "column " + column, fmt::format("\"{}\"", cell), "a finite number", ""});
    }
    return *value;
  }

  [[nodiscard]] std::string at_line() const { return fmt::format("{}:{}", file_.string(), line_); }

  const RobotModel& model_;
  const std::filesystem::path& file_;
  JointColumns columns_;
  std::vector<std::string> header_;
  char separator_ = ',';
  int line_ = 1;
};

using geometric::YamlElement;

// A JointTrajectory in a file of messages: the top, or what a message around it has of that name.
YamlElement trajectory_in(const YamlElement& top) {
  if (top.is_list() && !top.items().empty()) {
    return trajectory_in(top.items().front());
  }
  for (const char* key : {"joint_trajectory", "trajectory", "goal"}) {
    if (const std::optional<YamlElement> inner = top.find(key)) {
      return trajectory_in(*inner);
    }
  }
  return top;
}

bool is_joint_trajectory(const std::filesystem::path& file) {
  const std::string head = geometric::head_of(file);
  return head.find("joint_names") != std::string::npos;
}

Path read_joint_trajectory(const RobotModel& model, const std::filesystem::path& file,
                           JointsAtRest* rest) {
  const YamlElement trajectory =
      trajectory_in(YamlElement::read(file, "a trajectory_msgs/JointTrajectory (YAML or JSON)"));
  const YamlElement names = trajectory.need("joint_names");
  JointColumns columns(model, rest);
  const std::vector<YamlElement> joints = names.items();
  for (const YamlElement& name : joints) {
    if (!columns.append(name.text())) {
      name.refuse("\"" + name.text() + "\"", "a joint of robot " + model.name() + " that moves");
    }
  }
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
    trajectory.need("points").refuse(fmt::format("{} waypoints", path.waypoints.size()),
                                     "at least 2");
  }
  return path;
}

}  // namespace

std::string csv_time(double time) {
  constexpr double kPerSecond = 1e9;
  return fmt::format("{}", std::round(time * kPerSecond) / kPerSecond);
}

namespace {

// Takes continuous joints the short way round. @returns JointsAtRest::jumps.
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

}  // namespace

std::string to_csv(const Path& path, const RobotModel& model) {
  std::string text = "time";
  for (int i = 1; i < model.link_count(); ++i) {
    if (model.drive(i).variable >= 0) {
      text += "," + model.joint(i).name;
    }
  }
  double time = 0.0;
  for (std::size_t w = 0; w < path.waypoints.size(); ++w) {
    if (w > 0) {
      time += least_duration(model, path.waypoints[w - 1], path.waypoints[w]);
    }
    text += '\n';
    text += csv_time(time);
    for (const geometric::JointValue& joint : geometric::joint_values(model, path.waypoints[w])) {
      text += fmt::format(",{}", joint.value);
    }
  }
  return text + "\n";
}

void write_path_csv(const Path& path, const RobotModel& model, const std::filesystem::path& file) {
  geometric::replace_file(file, to_csv(path, model));
}

std::string JointsAtRest::remark(const std::filesystem::path& file) const {
  const std::string turns =
      jumps.empty()
          ? ""
          : fmt::format("{}{}; joints without ends go the short way round",
                        names.empty() ? file.string() + ": " : "; ", fmt::join(jumps, ", "));
  if (names.empty()) {
    return turns;
  }
  const std::span named(names.begin(), names.size() > kMostNamed ? kFirstNamed : names.size());
  const std::size_t others = names.size() - named.size();
  return fmt::format("{} does not have all joints: {}{} stay{} at the start{}", file.string(),
                     fmt::join(named, ", "), others > 0 ? fmt::format(" and {} more", others) : "",
                     names.size() == 1 ? "s" : "", turns);
}

bool is_path_file(const std::filesystem::path& file) {
  return geometric::has_extension(file, ".csv") || is_joint_trajectory(file);
}

Path read_path(const RobotModel& model, const std::filesystem::path& file, JointsAtRest* rest) {
  Path path = is_joint_trajectory(file) ? read_joint_trajectory(model, file, rest)
                                        : TableReader(model, file, rest).read();
  std::vector<std::string> jumps = unwrap(model, path);
  if (rest) {
    rest->jumps = std::move(jumps);
  }
  return path;
}

}  // namespace handway::planning
