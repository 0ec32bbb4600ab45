#include "handway/geometric/io/urdf_reader.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/srdf_reader.h"
#include "io/urdf_geometry.h"
#include "io/urdf_joints.h"
#include "io/urdfdom_document.h"
#include "io/xml_document.h"

#include <cctype>

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

void check_elements(const XmlDocument& document) {
  static_cast<void>(document.need(document.root("robot"), "name"));
  std::size_t count = 0;
  for (const pugi::xml_node& link : document.root("robot").children("link")) {
    if (++count > kMostLinks) {
      throw InputError({document.where(link), "robot",
                        "more links than " + std::to_string(kMostLinks), "a robot of fewer links",
                        ""});
    }
    static_cast<void>(document.need(link, "name"));
  }
  check_joint_elements(document);
}

}  // namespace

RobotDescription read_urdf(const fs::path& file) {
  const XmlDocument document(file, kWhat);
  check_elements(document);
  const UrdfdomResult parsed = parse_by_urdfdom(document.text());
  if (!parsed.model) {
    const std::string reason = joined(parsed.messages);
    throw InputError({place_of(document, parsed.messages), "robot",
                      reason.empty() ? "something that makes no robot" : reason, kWhat, ""});
  }
  RobotDescription robot;
  robot.name = parsed.model->getName();
  robot.file = file;
  robot.warnings = parsed.messages;
  const fs::path folder = fs::absolute(file).parent_path();
  for (const pugi::xml_node& node : document.root("robot").children("link")) {
    if (const urdf::LinkConstSharedPtr link =
            parsed.model->getLink(node.attribute("name").value())) {
      robot.links.push_back(link_of(*link, folder, document.where(node)));
    }
  }
  add_joints(document, *parsed.model, robot);
  const fs::path srdf = fs::path(file).replace_extension(".srdf");
  if (fs::exists(srdf)) {
    read_srdf(srdf, robot);
  }
  return robot;
}

}  // namespace handway::geometric
