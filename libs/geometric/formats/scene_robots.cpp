#include "formats/scene_sections.h"
#include "handway/geometric/formats/robot_loader.h"
#include "handway/geometric/formats/xacro_file.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/number_text.h"
#include "handway/geometric/io/resources.h"
#include "handway/geometric/robot/robot_description.h"
#include "handway/geometric/setup/mounting.h"
#include "handway/geometric/setup/seat.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>
#include <string>
#include <utility>

namespace handway::geometric {
namespace {

namespace fs = std::filesystem;

constexpr double kAgreement = 1e-6;  // rad or m

/// An entry of the list `robots`.
struct Entry {
  YamlElement element;
  RobotPart part;  ///< Its carrier is an index of entries.
  Pose X_WB = Pose::Identity();
  std::vector<std::size_t> mounted = {};  ///< Entries that it carries, in order.
};

// Reads `{J: {of: {K: 1, L: 0.5}, offset: 0}}`.
std::shared_ptr<const RobotModel> with_couplings(const YamlElement& robot,
                                                 std::shared_ptr<const RobotModel> model) {
  const std::optional<YamlElement> list = robot.find("couplings");
  if (!list) {
    return model;
  }
  RobotDescription description = model->description();
  for (const auto& [joint, element] : list->entries()) {
    element.allow_keys({"of", "offset"});
    JointCoupling coupling{joint, {}, element.number_or("offset", 0.0), true};
    for (const auto& [leader, multiplier] : element.need("of").entries()) {
      coupling.terms.emplace_back(leader, multiplier.number());
    }
    couple_joint(description, coupling, element.where(), element.name());
  }
  return std::make_shared<const RobotModel>(std::move(description));
}

// Reads `{prefix: left_}`. Every scalar is passed as it is written.
XacroArguments xacro_arguments_of(const YamlElement& robot) {
  XacroArguments arguments;
  if (const std::optional<YamlElement> list = robot.find("xacro")) {
    for (const auto& [name, value] : list->entries()) {
      const auto argument = xacro_argument_of(name + ":=" + value.text(), value.where());
      arguments.insert(argument);
    }
  }
  return arguments;
}

Entry entry_of(const YamlElement& element, const fs::path& folder, Scene& scene) {
  element.allow_keys({"name", "model", "xacro", "base", "mount", "moving_base", "bounds", "padding",
                      "couplings", "configuration"});
  const YamlElement model = element.need("model");
  Entry entry{element, {}};
  entry.part.file = model.text();
  entry.part.model = with_bases(
      element,
      with_couplings(element, load_robot(find_noted(ResourceKind::kRobot, model, folder, scene),
                                         xacro_arguments_of(element))));
  entry.part.name = element.text_or("name", entry.part.model->name());
  if (const std::optional<YamlElement> base = element.find("base")) {
    entry.X_WB = pose_of(*base);
  }
  return entry;
}

void check_name(const std::vector<Entry>& entries, const Entry& entry) {
  const YamlElement element = entry.element.find("name").value_or(entry.element);
  if (entry.part.name.empty()) {
    element.refuse("an empty name", "a name");
  }
  const auto has_name = [&](const Entry& other) { return other.part.name == entry.part.name; };
  if (std::ranges::any_of(entries, has_name)) {
    refuse_second_name(element, entry.part.name);
  }
}

std::vector<std::string> names_of(const std::vector<Entry>& entries) {
  std::vector<std::string> names;
  std::ranges::transform(entries, std::back_inserter(names),
                         [](const Entry& entry) { return entry.part.name; });
  return names;
}

std::string link_of(const YamlElement& element, const RobotPart& carrier) {
  std::string name = element.text();
  if (!carrier.model->find_link(name)) {
    std::vector<std::string> links;
    for (const Link& link : carrier.model->description().links) {
      links.push_back(link.name);
    }
    element.refuse(element.found(), "a link of " + carrier.name, advise_name(name, links));
  }
  return name;
}

// Placed on the end of the carrier, if no link is named.
void sit_down(const YamlElement& mount, const RobotPart& carrier, RobotPart& part) {
  const std::optional<Seat> seat = find_seat(*carrier.model, *part.model);
  if (!seat) {
    mount.refuse("no \"link\"", "a link of " + carrier.name + ", which is not an arm with one end",
                 "Name the link that carries " + part.name);
  }
  part.link = seat->link;
  part.X_LB = seat->X_LB;
}

void read_mount(std::vector<Entry>& entries, std::size_t index) {
  Entry& entry = entries[index];
  const std::optional<YamlElement> mount = entry.element.find("mount");
  if (!mount) {
    return;
  }
  mount->allow_keys({"robot", "link", "pose"});
  for (const char* key : {"base", "moving_base", "bounds"}) {
    if (const std::optional<YamlElement> other = entry.element.find(key)) {
      other->refuse("a mounted robot", "a robot that stands in the world",
                    "Place it by the pose of its mount");
    }
  }
  const YamlElement robot = mount->need("robot");
  const std::vector<std::string> names = names_of(entries);
  const auto carrier = std::ranges::find(names, robot.text());
  if (carrier == names.end()) {
    robot.refuse(robot.found(), "a robot of the scene", advise_name(robot.text(), names));
  }
  entry.part.carrier = static_cast<int>(carrier - names.begin());
  entries[static_cast<std::size_t>(entry.part.carrier)].mounted.push_back(index);
  const RobotPart& on = entries[static_cast<std::size_t>(entry.part.carrier)].part;
  const std::optional<YamlElement> link = mount->find("link");
  const std::optional<YamlElement> pose = mount->find("pose");
  if (!link) {
    sit_down(*mount, on, entry.part);
  } else {
    entry.part.link = link_of(*link, on);
  }
  if (pose) {
    entry.part.X_LB = pose_of(*pose);
  }
}

// The entry that is fixed to the world and carries this one, directly or not.
std::size_t root_of(const std::vector<Entry>& entries, std::size_t index) {
  std::size_t root = index;
  std::string chain = entries[index].part.name;
  for (std::size_t steps = 0; entries[root].part.carrier >= 0; ++steps) {
    if (steps == entries.size()) {
      entries[index].element.need("mount").refuse("a ring of mounts: " + chain,
                                                  "robots of which one stands in the world",
                                                  "Take the mount of one of them away");
    }
    root = static_cast<std::size_t>(entries[root].part.carrier);
    chain += " on " + entries[root].part.name;
  }
  return root;
}

// The entry and all that it carries, carriers first.
void add_parts(const std::vector<Entry>& entries, std::size_t index, int carrier,
               std::vector<RobotPart>& parts) {
  parts.push_back(entries[index].part);
  parts.back().carrier = carrier;
  const int own = static_cast<int>(parts.size()) - 1;
  for (const std::size_t mounted : entries[index].mounted) {
    add_parts(entries, mounted, own, parts);
  }
}

RobotInstance robot_of(const std::vector<Entry>& entries, std::size_t root) {
  const Entry& entry = entries[root];
  RobotInstance robot;
  robot.name = entry.part.name;
  robot.file = entry.part.file;
  robot.X_WB = entry.X_WB;
  if (entry.mounted.empty()) {
    robot.model = entry.part.model;
    robot.configuration = robot.model->neutral();
  } else {
    add_parts(entries, root, -1, robot.parts);
    compose_parts(robot);
  }
  return robot;
}

Padding padding_of(const YamlElement& element) {
  Padding padding;
  if (element.is_map()) {
    element.allow_keys({"scale", "distance"});
    padding.scale = element.number_or("scale", 1.0);
    padding.distance = element.number_or("distance", 0.0);
  } else {
    padding.distance = element.number();
  }
  if (padding.scale <= 0.0 || padding.distance < 0.0) {
    element.refuse(fmt::format("a scale of {:g} and {:g} m", padding.scale, padding.distance),
                   "a scale above 0 and a distance of 0 m or more");
  }
  return padding;
}

// Reads paddings of the fixed robot and what it carries, by each part's own names of links.
void read_paddings(const std::vector<Entry>& entries, std::size_t index, RobotInstance& robot) {
  const Entry& entry = entries[index];
  if (const std::optional<YamlElement> list = entry.element.find("padding")) {
    const auto part = std::ranges::find(robot.parts, entry.part.name, &RobotPart::name);
    for (const auto& [name, value] : list->entries()) {
      const std::string link =
          part != robot.parts.end() && part->links.contains(name) ? part->links.at(name) : name;
      if (!robot.model->find_link(link)) {
        value.refuse("padding of \"" + name + "\"", "links of " + robot.name);
      }
      robot.padding[link] = padding_of(value);
    }
  }
  for (const std::size_t mounted : entry.mounted) {
    read_paddings(entries, mounted, robot);
  }
}

// Reads first the values of the fixed robot, which may name all joints, then those of carried
// robots.
void read_configurations(const std::vector<Entry>& entries, std::size_t index,
                         RobotInstance& robot) {
  if (const auto configuration = entries[index].element.find("configuration")) {
    const auto part = std::ranges::find(robot.parts, entries[index].part.name, &RobotPart::name);
    robot.configuration = configuration_of(*configuration, *robot.model, robot.configuration,
                                           part == robot.parts.end() ? nullptr : &*part);
  }
  for (const std::size_t mounted : entries[index].mounted) {
    read_configurations(entries, mounted, robot);
  }
}

}  // namespace

int carried_link(const YamlElement& element, const RobotModel& model, const std::string& name) {
  std::vector<std::string> moving;
  for (int link = 1; link < model.link_count(); ++link) {
    const bool moves = model.mimic_mapping(link).variable >= 0;
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

Configuration configuration_of(const YamlElement& element, const RobotModel& model,
                               const Configuration& defaults, const RobotPart* part) {
  Configuration q = defaults;
  std::vector<std::string> given_by(static_cast<std::size_t>(model.variable_count()));
  const auto entries = element.entries();
  // Leaders come first, so that coupled joints are checked against their leaders' values.
  for (const bool coupled : {false, true}) {
    for (const auto& [name, value] : entries) {
      const bool is_own = part != nullptr && part->joints.contains(name);
      const int link = carried_link(value, model, is_own ? part->joints.at(name) : name);
      if (model.joint(link).mimic.has_value() != coupled) {
        continue;
      }
      const RobotModel::MimicMapping& drive = model.mimic_mapping(link);
      std::string& giver = given_by[static_cast<std::size_t>(drive.variable)];
      const double wanted = value.number();
      const bool follows_several =
          std::ranges::count(model.description().couplings, model.joint(link).name,
                             &JointCoupling::joint) > 0;
      if (giver.empty() && drive.multiplier != 0.0 && !follows_several) {
        q[drive.variable] = (wanted - drive.offset) / drive.multiplier;
        giver = name;
        continue;
      }
      const double follows = joint_value(model, link, q);
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

void refuse_second_name(const YamlElement& element, const std::string& name) {
  element.refuse("the name \"" + name + "\" a second time", "names that are unique in the scene",
                 "Give it a \"name\" of its own");
}

std::vector<YamlElement> read_robots(const YamlElement& list, const fs::path& folder,
                                     Scene& scene) {
  std::vector<Entry> entries;
  for (const YamlElement& element : list.items()) {
    Entry entry = entry_of(element, folder, scene);
    check_name(entries, entry);
    for (const std::string& warning : entry.part.model->description().warnings) {
      scene.warnings.push_back("robot " + entry.part.name + ": " + warning);
    }
    entries.push_back(std::move(entry));
  }
  if (entries.empty()) {
    list.refuse("an empty list", "at least one robot");
  }
  for (std::size_t i = 0; i < entries.size(); ++i) {
    read_mount(entries, i);
  }
  std::vector<YamlElement> standing;
  std::vector<std::size_t> roots;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const std::size_t root = root_of(entries, i);
    if (std::ranges::count(roots, root) > 0) {
      continue;
    }
    roots.push_back(root);
    standing.push_back(entries[root].element);
    RobotInstance robot = robot_of(entries, root);
    read_configurations(entries, root, robot);
    read_paddings(entries, root, robot);
    if (!robot.parts.empty()) {
      for (const std::string& warning : robot.model->description().warnings) {
        scene.warnings.push_back("robot " + robot.name + ": " + warning);
      }
    }
    scene.robots.push_back(std::move(robot));
  }
  return standing;
}

}  // namespace handway::geometric
