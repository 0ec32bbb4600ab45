#include "handway/geometric/formats/urdf.h"

#include "formats/urdf_elements.h"
#include "formats/urdf_joints.h"
#include "formats/urdf_links.h"
#include "formats/urdf_mesh_files.h"
#include "formats/xml_document.h"
#include "handway/geometric/formats/srdf.h"
#include "handway/geometric/io/existing_file.h"
#include "handway/geometric/robot/base_joint.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace handway::geometric {
namespace {

namespace fs = std::filesystem;

std::string name_of(const XmlDocument& document, std::vector<std::string>& warnings) {
  std::string name = document.root("robot").attribute("name").value();
  if (name.empty()) {
    name = document.file().stem().string();
    warnings.emplace_back("the robot has no name; it is called after its file");
  }
  return name;
}

void note_undefined_materials(const std::set<std::string>& names, RobotDescription& robot) {
  if (!names.empty()) {
    robot.warnings.push_back(fmt::format("materials without a colour that can be read: \"{}\"",
                                         fmt::join(names, "\", \"")));
  }
}

void note_links_without_collision(const XmlDocument& document, RobotDescription& robot) {
  std::vector<std::string> names;
  for (const pugi::xml_node& link : document.root("robot").children("link")) {
    if (link.child("visual") && !link.child("collision")) {
      names.emplace_back(link.attribute("name").value());
    }
  }
  add_warning("links with visual but no collision geometry, which collide with nothing", names,
              robot.warnings);
}

}  // namespace

RobotDescription read_urdf(const fs::path& file, const fs::path& place) {
  const XmlDocument document(file, "a robot file (URDF)");
  RobotDescription robot;
  robot.file = file;
  robot.warnings = check_urdf_names(document);
  robot.name = name_of(document, robot.warnings);
  UrdfElements elements(document);
  const std::set<std::string> alone = links_on_their_own(elements);
  UrdfMeshFiles meshes(document,
                       fs::absolute(place.empty() ? file.parent_path() : place).lexically_normal());
  UrdfLinks links(elements, meshes);
  for (const pugi::xml_node& link : document.root("robot").children("link")) {
    if (!alone.contains(link.attribute("name").value())) {
      robot.links.push_back(links.read(link));
    }
  }
  UrdfJoints joints(elements);
  joints.read_all(robot);
  links.refuse_missing_meshes();
  note_undefined_materials(links.materials().undefined(), robot);
  add_warning("links that no joint connects are left out", {alone.begin(), alone.end()},
              robot.warnings);
  add_warning("elements with a second <origin>, of which the first is taken",
              elements.second_origins(), robot.warnings);
  add_warning("collision shapes without size, which collide with nothing", links.sizeless(),
              robot.warnings);
  add_warning("joints whose limits are beyond ±1000000 turn without end", joints.endless(),
              robot.warnings);
  add_warning(fmt::format("slides whose limits are beyond ±1000000 go ±{:g} m", kDefaultBaseReach),
              joints.endless_slides(), robot.warnings);
  note_links_without_collision(document, robot);
  if (std::string faults = links.drawing_faults().summary(); !faults.empty()) {
    robot.warnings.push_back(std::move(faults));
  }
  std::ranges::move(meshes.warnings(), std::back_inserter(robot.warnings));
  const fs::path srdf = existing_file(fs::path(file).replace_extension(".srdf"));
  if (place.empty() && fs::exists(srdf)) {
    read_srdf(srdf, robot);
  }
  return robot;
}

}  // namespace handway::geometric
