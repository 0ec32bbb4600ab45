#include "handway/planning/paths/path_csv.h"

#include "handway/geometric/formats/yaml_element.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/number_text.h"
#include "handway/geometric/io/replace_file.h"
#include "handway/geometric/io/text_file.h"
#include "handway/planning/core/objective.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <string_view>
#include <vector>

namespace handway::planning {
namespace {

using geometric::Configuration;
using geometric::InputError;
using geometric::RobotModel;

constexpr std::size_t kLargestFile = std::size_t{256} << 20;
constexpr double kCouplingTolerance = 1e-4;  // rad or m

char separator_of(const std::string& header) {
  for (const char separator : {',', ';', '\t', ' '}) {
    if (header.find(separator) != std::string::npos) {
      return separator;
    }
  }
  return ',';
}

class Reader {
 public:
  Reader(const RobotModel& model, const std::filesystem::path& file) : model_(model), file_(file) {}

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
    const std::vector<std::string_view> names = geometric::cells(line, separator_);
    header_.assign(names.begin(), names.end());
    link_of_column_.assign(header_.size(), 0);
    for (std::size_t c = 0; c < header_.size(); ++c) {
      for (int i = 1; i < model_.link_count(); ++i) {
        if (model_.joint(i).name == header_[c] && model_.drive(i).variable >= 0) {
          link_of_column_[c] = i;
        }
      }
      if (link_of_column_[c] == 0 && header_[c] != "time" && !is_rate(header_[c])) {
        throw InputError({file_.string() + ":1", "column \"" + header_[c] + "\"",
                          "no joint of robot " + model_.name() + " that moves",
                          "\"time\" or a joint's name", ""});
      }
    }
    for (int v = 0; v < model_.variable_count(); ++v) {
      if (std::ranges::count(header_, model_.variable(v).name) != 1) {
        throw InputError({file_.string() + ":1", "",
                          fmt::format("{} columns for joint {}",
                                      std::ranges::count(header_, model_.variable(v).name),
                                      model_.variable(v).name),
                          "one", ""});
      }
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
    std::vector<double> values;
    for (std::size_t c = 0; c < row.size(); ++c) {
      values.push_back(number(row[c], header_[c]));
    }
    Configuration q(model_.variable_count());
    for (std::size_t c = 0; c < row.size(); ++c) {
      const int variable = model_.drive(link_of_column_[c]).variable;
      if (link_of_column_[c] > 0 && model_.variable_link(variable) == link_of_column_[c]) {
        q[variable] = values[c];
      }
    }
    for (std::size_t c = 0; c < row.size(); ++c) {
      const int link = link_of_column_[c];
      const double expected = link > 0 ? geometric::joint_value(model_, link, q) : values[c];
      if (std::abs(values[c] - expected) > kCouplingTolerance) {
        throw InputError({at_line(), "column " + header_[c], std::string(row[c]),
                          fmt::format("{:.6f}, as coupled to joint {}", expected,
                                      model_.variable(model_.drive(link).variable).name),
                          ""});
      }
    }
    return q;
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
  std::vector<std::string> header_;
  std::vector<int> link_of_column_;  ///< 0: time or a rate.
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

Path read_joint_trajectory(const RobotModel& model, const std::filesystem::path& file) {
  const YamlElement trajectory =
      trajectory_in(YamlElement::read(file, "a trajectory_msgs/JointTrajectory (YAML or JSON)"));
  const YamlElement names = trajectory.need("joint_names");
  std::vector<int> links;  // of the joints; 0: one that the robot has not
  for (const YamlElement& name : names.items()) {
    int link = 0;
    for (int i = 1; i < model.link_count(); ++i) {
      link = model.joint(i).name == name.text() && model.drive(i).variable >= 0 ? i : link;
    }
    if (link == 0) {
      name.refuse("\"" + name.text() + "\"", "a joint of robot " + model.name() + " that moves");
    }
    links.push_back(link);
  }
  for (int v = 0; v < model.variable_count(); ++v) {
    if (std::ranges::count(links, model.variable_link(v)) != 1) {
      names.refuse(fmt::format("joint {} {} times", model.variable(v).name,
                               std::ranges::count(links, model.variable_link(v))),
                   "once");
    }
  }
  Path path;
  for (const YamlElement& point : trajectory.need("points").items()) {
    const Eigen::VectorXd positions =
        point.need("positions").numbers(static_cast<int>(links.size()));
    Configuration& q = path.waypoints.emplace_back(model.variable_count());
    for (std::size_t i = 0; i < links.size(); ++i) {
      const int variable = model.drive(links[i]).variable;
      if (model.variable_link(variable) == links[i]) {
        q[variable] = positions[static_cast<Eigen::Index>(i)];
      }
    }
    for (std::size_t i = 0; i < links.size(); ++i) {
      const double expected = geometric::joint_value(model, links[i], q);
      if (std::abs(positions[static_cast<Eigen::Index>(i)] - expected) > kCouplingTolerance) {
        point.refuse(fmt::format("{} for joint {}", positions[static_cast<Eigen::Index>(i)],
                                 model.joint(links[i]).name),
                     fmt::format("{:.6f}, as coupled to joint {}", expected,
                                 model.variable(model.drive(links[i]).variable).name));
      }
    }
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

Path read_path_csv(const RobotModel& model, const std::filesystem::path& file) {
  return is_joint_trajectory(file) ? read_joint_trajectory(model, file)
                                   : Reader(model, file).read();
}

}  // namespace handway::planning
