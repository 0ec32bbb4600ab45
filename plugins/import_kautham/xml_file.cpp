#include "xml_file.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/number_text.h"
#include "handway/geometric/io/text_file.h"
#include "handway/geometric/math/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

namespace handway::import_kautham {
namespace {

constexpr std::size_t kLargestFile = std::size_t{16} << 20;
constexpr int kDeepest = 100;

// Finds a node below the deepest level allowed; else an empty node.
pugi::xml_node find_too_deep(pugi::xml_node root) {
  struct Walker : pugi::xml_tree_walker {
    bool for_each(pugi::xml_node& node) override {
      if (depth() > kDeepest) {
        found = node;
      }
      return !found;
    }
    pugi::xml_node found;
  } walker;
  root.traverse(walker);
  return walker.found;
}

// Joint "Thumb"/DHPars: from below the root down to the node.
std::string element_path(pugi::xml_node node) {
  std::vector<std::string> parts;
  for (; node && node.parent() && node.parent().type() != pugi::node_document;
       node = node.parent()) {
    const std::string_view name = geometric::trimmed(node.attribute("name").value());
    parts.push_back(name.empty() ? node.name()
                                 : std::string(node.name()) + " \"" + std::string(name) + "\"");
  }
  std::string path;
  for (auto part = parts.rbegin(); part != parts.rend(); ++part) {
    path += (path.empty() ? "" : "/") + *part;
  }
  return path.empty() ? node.name() : path;
}

}  // namespace

std::string in_quotes(std::string_view text) { return fmt::format("\"{}\"", text); }

XmlFile::XmlFile(const std::filesystem::path& file, const char* root)
    : path_(file), content_(geometric::read_text_file(file, "a Kautham file (XML)", kLargestFile)) {
  const pugi::xml_parse_result parsed = document_.load_buffer(
      content_.data(), content_.size(), pugi::parse_default, pugi::encoding_utf8);
  if (!parsed) {
    throw geometric::InputError({line_at(parsed.offset), "", parsed.description(),
                                 "well-formed XML", "Look at this line and the one before it"});
  }
  if (const pugi::xml_node deep = find_too_deep(document_)) {
    throw geometric::InputError({place(deep), "",
                                 fmt::format("elements nested more than {}", kDeepest),
                                 "a Kautham file (XML)", ""});
  }
  root_ = document_.document_element();
  if (std::string_view(root_.name()) != root) {
    throw geometric::InputError({path_.string(), "root element",
                                 "<" + std::string(root_.name()) + ">",
                                 "<" + std::string(root) + ">", ""});
  }
}

pugi::xml_node XmlFile::child(pugi::xml_node node, const char* name) const {
  const pugi::xml_node found = node.child(name);
  if (!found) {
    refuse(node, "", "no <" + std::string(name) + "> in it", "exactly one");
  }
  return found;
}

std::string XmlFile::text(pugi::xml_node node, const char* attribute) const {
  const pugi::xml_attribute found = node.attribute(attribute);
  if (!found) {
    refuse(node, attribute, "no such attribute", "one");
  }
  const std::string_view value = geometric::trimmed(found.value());
  if (value.empty()) {
    refuse(node, attribute, "an empty attribute", "a text");
  }
  return std::string(value);
}

double XmlFile::number(pugi::xml_node node, const char* attribute) const {
  const std::string value = text(node, attribute);
  const std::optional<double> number = geometric::parse_number(value);
  if (!number) {
    refuse(node, attribute, in_quotes(value), "a finite number");
  }
  return *number;
}

double XmlFile::number_or(pugi::xml_node node, const char* attribute, double otherwise) const {
  return node.attribute(attribute) ? number(node, attribute) : otherwise;
}

bool XmlFile::flag(pugi::xml_node node, const char* attribute) const {
  const std::string value = text(node, attribute);
  if (value != "true" && value != "false" && value != "1" && value != "0") {
    refuse(node, attribute, in_quotes(value), "true or false");
  }
  return value == "true" || value == "1";
}

void XmlFile::refuse_slips(pugi::xml_node node, std::initializer_list<std::string> known) const {
  const std::vector<std::string> names(known);
  for (const pugi::xml_node child : node.children()) {
    const bool is_known = std::ranges::count(names, std::string_view(child.name())) > 0;
    if (const auto meant = is_known ? std::nullopt : geometric::slip_of(child.name(), names)) {
      refuse(child, "", fmt::format("the unknown element <{}>", child.name()),
             fmt::format("{}", fmt::join(names, ", ")), fmt::format("Did you mean <{}>?", *meant));
    }
  }
}

void XmlFile::refuse(pugi::xml_node node, std::string_view attribute, const std::string& found,
                     const std::string& expected, const std::string& advice) const {
  std::string element = element_path(node);
  if (!attribute.empty()) {
    element += ", attribute " + std::string(attribute);
  }
  throw geometric::InputError({place(node), element, found, expected, advice});
}

std::string XmlFile::place(pugi::xml_node node) const { return line_at(node.offset_debug()); }

void XmlFile::note(pugi::xml_node node, const std::string& what) const {
  notes_.push_back(place(node) + ": " + what);
}

std::string XmlFile::line_at(std::ptrdiff_t offset) const {
  const auto end = content_.begin() + std::clamp<std::ptrdiff_t>(
                                          offset, 0, static_cast<std::ptrdiff_t>(content_.size()));
  return path_.string() + ":" + std::to_string(1 + std::count(content_.begin(), end, '\n'));
}

geometric::Pose read_location(const XmlFile& xml, pugi::xml_node node, const Units& units) {
  geometric::Pose X = geometric::Pose::Identity();
  X.translation() = units.length * Eigen::Vector3d(xml.number(node, "X"), xml.number(node, "Y"),
                                                   xml.number(node, "Z"));
  if (!node.attribute("TH")) {
    return X;
  }
  const double angle = units.angle * xml.number(node, "TH");
  const Eigen::Vector3d axis(xml.number(node, "WX"), xml.number(node, "WY"),
                             xml.number(node, "WZ"));
  if (axis.norm() > 0.0) {
    X.linear() = Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
  } else if (angle != 0.0) {
    xml.note(node, fmt::format("<{}>: an angle about the axis (0, 0, 0) is no turn", node.name()));
  }
  return X;
}

}  // namespace handway::import_kautham
