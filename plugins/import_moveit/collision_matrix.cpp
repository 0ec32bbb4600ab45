#include "collision_matrix.h"

#include "handway/geometric/io/plural.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

namespace handway::import_moveit {

using geometric::YamlElement;

bool flag(const YamlElement& element) {
  const std::string text = element.text();
  for (const auto& [word, value] : {std::pair("True", true), std::pair("False", false),
                                    std::pair("1", true), std::pair("0", false)}) {
    if (text == word) {
      return value;
    }
  }
  return element.flag();
}

namespace {

using geometric::AllowedCollisions;

/// The matrix by names: of pairs, and of single bodies for unnamed pairs.
struct Matrix {
  std::map<AllowedCollisions::Pair, bool> pairs;
  std::map<std::string, bool> defaults;

  [[nodiscard]] bool allows(const std::string& a, const std::string& b) const {
    return decision(a, b).value_or(false);
  }

  // Returns the decision on a pair; nothing if the matrix has none.
  [[nodiscard]] std::optional<bool> decision(const std::string& a, const std::string& b) const {
    if (const auto pair = pairs.find(std::minmax(a, b)); pair != pairs.end()) {
      return pair->second;
    }
    std::optional<bool> allowed;
    for (const std::string& name : {a, b}) {
      if (const auto usual = defaults.find(name); usual != defaults.end()) {
        if (!usual->second) {
          return false;
        }
        allowed = true;
      }
    }
    return allowed;
  }
};

Matrix matrix_of(const YamlElement& element) {
  element.refuse_slips(
      {"entry_names", "entry_values", "default_entry_names", "default_entry_values"});
  Matrix matrix;
  const std::vector<YamlElement> names = element.items_of("entry_names");
  const std::vector<YamlElement> rows = element.items_of("entry_values");
  if (rows.size() != names.size()) {
    element.refuse(fmt::format("{} for {}", geometric::plural(rows.size(), "row"),
                               geometric::plural(names.size(), "name")),
                   "a row for each name");
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::vector<YamlElement> row =
        (rows[i].is_map() ? rows[i].need("enabled") : rows[i]).items();
    if (row.size() != names.size()) {
      rows[i].refuse(geometric::plural(row.size(), "value"),
                     fmt::format("{}, one for each name", names.size()));
    }
    for (std::size_t j = 0; j <= i; ++j) {
      matrix.pairs[std::minmax(names[i].text(), names[j].text())] = flag(row[j]);
    }
  }
  const std::vector<YamlElement> usual = element.items_of("default_entry_names");
  const std::vector<YamlElement> values = element.items_of("default_entry_values");
  if (usual.size() != values.size()) {
    element.refuse(fmt::format("{} default values for {} names", values.size(), usual.size()),
                   "as many as names");
  }
  for (std::size_t i = 0; i < usual.size(); ++i) {
    matrix.defaults[usual[i].text()] = flag(values[i]);
  }
  return matrix;
}

}  // namespace

namespace {

/// Pairs of links on which a matrix differs from the SRDF.
void take_pairs_of_links(const Matrix& matrix, geometric::Scene& scene) {
  const geometric::RobotDescription& robot = scene.robots.front().model->description();
  const auto is_named = [&](const std::string& link) {
    return matrix.pairs.contains({link, link});
  };
  std::set<std::string> unnamed;
  for (std::size_t i = 0; i < robot.links.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const AllowedCollisions::Pair pair = std::minmax(robot.links[i].name, robot.links[j].name);
      const bool by_srdf = robot.allowed_collisions.reason(pair.first, pair.second).has_value();
      const std::optional<bool> decision = matrix.decision(pair.first, pair.second);
      if (decision && *decision != by_srdf) {
        scene.allowed_collisions[pair] = *decision;
      }
      for (const std::string& link : {pair.first, pair.second}) {
        if (!decision && by_srdf && !is_named(link)) {
          unnamed.insert(link);
        }
      }
    }
  }
  if (!unnamed.empty()) {
    constexpr std::ptrdiff_t kNamed = 5;
    const std::ptrdiff_t more = std::ssize(unnamed) - kNamed;
    scene.warnings.push_back(fmt::format(
        "the allowed-collision matrix does not name {} link{} of {}, whose pairs stay as in the "
        "SRDF: {}{}",
        unnamed.size(), unnamed.size() == 1 ? "" : "s", robot.name,
        fmt::join(unnamed.begin(), more > 0 ? std::next(unnamed.begin(), kNamed) : unnamed.end(),
                  ", "),
        more > 0 ? fmt::format(" and {} more", more) : ""));
  }
}

}  // namespace

void read_collision_matrix(const YamlElement& element, const ObjectNames& objects,
                           geometric::Scene& scene) {
  const Matrix matrix = matrix_of(element);
  const geometric::RobotDescription& robot = scene.robots.front().model->description();
  if (!matrix.pairs.empty()) {
    take_pairs_of_links(matrix, scene);
  }
  for (const auto& [id, names] : objects) {
    std::vector<std::pair<std::string, std::string>> others;  // id and name in the scene
    for (const geometric::Link& link : robot.links) {
      others.emplace_back(link.name, link.name);
    }
    for (const auto& [other, shapes] : objects) {
      for (const std::string& shape : shapes) {
        others.emplace_back(other, shape);
      }
    }
    for (const auto& [other, name] : others) {
      for (const std::string& shape : names) {
        if (other != id && matrix.allows(id, other)) {
          scene.allowed_collisions[std::minmax(shape, name)] = true;
        }
      }
    }
  }
}

void read_paddings(const YamlElement& planning_scene, geometric::Scene& scene) {
  geometric::RobotInstance& robot = scene.robots.front();
  std::set<std::string> unknown;
  for (const auto& [list, key] :
       {std::pair("link_padding", "padding"), std::pair("link_scale", "scale")}) {
    const bool is_scale = std::string_view(key) == "scale";
    for (const YamlElement& one : planning_scene.items_of(list)) {
      one.refuse_slips({"link_name", key});
      const std::string link = one.need("link_name").text();
      const YamlElement element = one.need(key);
      const double value = element.number();
      if (is_scale ? value <= 0.0 : value < 0.0) {
        element.refuse(element.found(), is_scale ? "a scale above 0" : "0 m or more");
      }
      if (!robot.model->find_link(link)) {
        unknown.insert(link);
        continue;
      }
      (is_scale ? robot.padding[link].scale : robot.padding[link].distance) = value;
    }
  }
  std::erase_if(robot.padding,
                [](const auto& entry) { return entry.second == geometric::Padding(); });
  if (!unknown.empty()) {
    scene.warnings.push_back(fmt::format("padding of links that {} has not is passed over: {}",
                                         robot.model->name(), fmt::join(unknown, ", ")));
  }
}

}  // namespace handway::import_moveit
