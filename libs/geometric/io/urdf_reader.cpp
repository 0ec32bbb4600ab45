#include "handway/geometric/io/urdf_reader.h"

#include "handway/geometric/io/existing_file.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/srdf_reader.h"
#include "io/urdf_elements.h"
#include "io/urdf_geometry.h"
#include "io/urdf_joints.h"
#include "io/urdfdom_document.h"
#include "io/xml_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <iterator>

namespace handway::geometric {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostLinks = 2000;  // a longer chain could exhaust the stack
constexpr const char* kWhat = "a robot file (URDF)";

// urdfdom says what is wrong but not where: the line of the first link, joint or
// material whose name it quotes.
std::string place_of(const XmlDocument& document, const std::vector<std::string>& messages) {
  for (const std::string& message : messages) {
    for (const pugi::xml_node& node : document.root("robot").children()) {
      const std::string name = node.attribute("name").value();
      for (const char quote : {'\'', '"', '[', ' '}) {
        const std::size_t at = name.empty() ? std::string::npos : message.find(quote + name);
        if (at != std::string::npos && at + 1 + name.size() < message.size() &&
            !std::isalnum(static_cast<unsigned char>(message[at + 1 + name.size()])) &&
            message[at + 1 + name.size()] != '_') {
          return document.where(node);
        }
      }
    }
  }
  return document.where(document.root("robot"));
}

std::string joined(const std::vector<std::string>& messages) {
  std::string text;
  for (const std::string& message : messages) {
    text += (text.empty() ? "" : "; ") + message;
  }
  return text;
}

void check_size(const XmlDocument& document) {
  static_cast<void>(document.need(document.root("robot"), "name"));
  std::size_t count = 0;
  for (const pugi::xml_node& link : document.root("robot").children("link")) {
    if (++count > kMostLinks) {
      throw InputError({document.where(link), "robot",
                        "more links than " + std::to_string(kMostLinks), "a robot of fewer links",
                        ""});
    }
  }
}

std::ptrdiff_t count_of(const pugi::xml_node& link, const char* element) {
  return std::ranges::distance(link.children(element));
}

// The link that a node describes. Whatever urdfdom drops, no collision element is lost.
Link read_link(const XmlDocument& document, const pugi::xml_node& node,
               const urdf::ModelInterface& model, const fs::path& folder, LinkFiles& files) {
  const std::string name = node.attribute("name").value();
  const urdf::LinkConstSharedPtr link = model.getLink(name);
  if (!link || std::ssize(link->collision_array) != count_of(node, "collision")) {
    throw InputError({document.where(node), "link " + name,
                      "a link that urdfdom reads only in part", "what ROS reads too", ""});
  }
  Link result = link_of(*link, folder, document.where(node), files);
  if (result.visual.empty() && count_of(node, "visual") > 0) {
    result.visual = result.collision;
  }
  return result;
}

void note_links_without_collision(const XmlDocument& document, RobotDescription& robot) {
  std::vector<std::string> names;
  for (const pugi::xml_node& link : document.root("robot").children("link")) {
    if (link.child("visual") && !link.child("collision")) {
      names.emplace_back(link.attribute("name").value());
    }
  }
  if (!names.empty()) {
    robot.warnings.push_back(
        fmt::format("links with visual but no collision geometry, which collide with nothing: {}",
                    fmt::join(names, ", ")));
  }
}

}  // namespace

RobotDescription read_urdf(const fs::path& file) {
  const XmlDocument document(file, kWhat);
  check_size(document);
  UrdfElements elements = check_urdf_elements(document);
  const UrdfdomResult parsed = parse_by_urdfdom(elements.text);
  if (!parsed.model) {
    const std::string reason = joined(parsed.messages);
    throw InputError({place_of(document, parsed.messages), "robot",
                      reason.empty() ? "something that makes no robot" : reason, kWhat, ""});
  }
  RobotDescription robot;
  robot.name = parsed.model->getName();
  robot.file = file;
  robot.warnings = parsed.messages;
  robot.warnings.insert(robot.warnings.end(), elements.warnings.begin(), elements.warnings.end());
  const fs::path folder = fs::absolute(file).parent_path();
  LinkFiles files{std::move(elements.drawing), {}};
  for (const pugi::xml_node& node : document.root("robot").children("link")) {
    robot.links.push_back(read_link(document, node, *parsed.model, folder, files));
  }
  add_joints(document, *parsed.model, robot);
  note_links_without_collision(document, robot);
  if (const std::string faults = files.drawing.summary(); !faults.empty()) {
    robot.warnings.push_back(faults);
  }
  if (!files.renamed.empty()) {
    robot.warnings.push_back(fmt::format("files whose names have other letters on the disk: {}",
                                         fmt::join(files.renamed, ", ")));
  }
  const fs::path srdf = existing_file(fs::path(file).replace_extension(".srdf"));
  if (fs::exists(srdf)) {
    read_srdf(srdf, robot);
  }
  return robot;
}

}  // namespace handway::geometric
