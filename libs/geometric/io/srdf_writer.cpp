#include "handway/geometric/io/srdf_writer.h"

#include "handway/geometric/io/replace_file.h"
#include "io/xml_document.h"

#include <memory>
#include <sstream>

namespace handway::geometric {
namespace {

void append_disabled(pugi::xml_node robot, const AllowedCollisions& allowed) {
  for (const auto& [pair, reason] : allowed.entries()) {
    pugi::xml_node element = robot.append_child("disable_collisions");
    element.append_attribute("link1") = pair.first.c_str();
    element.append_attribute("link2") = pair.second.c_str();
    element.append_attribute("reason") = to_string(reason);
  }
}

void remove_disabled(pugi::xml_node robot) {
  while (const pugi::xml_node element = robot.child("disable_collisions")) {
    robot.remove_child(element);
  }
}

std::string text_of(const pugi::xml_document& document) {
  std::ostringstream stream;
  document.save(stream, "  ", pugi::format_default, pugi::encoding_utf8);
  return stream.str();
}

}  // namespace

void write_disabled_collisions(const std::filesystem::path& file, const std::string& robot,
                               const AllowedCollisions& allowed) {
  if (std::filesystem::exists(file)) {
    XmlDocument document(file, "a semantic robot file (SRDF)");
    pugi::xml_node root = document.root("robot");
    remove_disabled(root);
    append_disabled(root, allowed);
    replace_file(file, text_of(document.nodes()));
    return;
  }
  pugi::xml_document document;
  pugi::xml_node root = document.append_child("robot");
  root.append_attribute("name") = robot.c_str();
  append_disabled(root, allowed);
  replace_file(file, text_of(document));
}

}  // namespace handway::geometric
