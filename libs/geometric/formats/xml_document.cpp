#include "formats/xml_document.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/text_file.h"

#include <algorithm>
#include <iterator>
#include <sstream>

namespace handway::geometric {
namespace {

constexpr int kDeepest = 100;
constexpr std::ptrdiff_t kMostTags = 1'000'000;
constexpr std::ptrdiff_t kMostAttributes = 200;  // attributes of one element

// Finds a node that is nested too deep or has too many attributes; else an empty node.
pugi::xml_node find_excessive(const pugi::xml_node& root) {
  struct Walker : pugi::xml_tree_walker {
    bool for_each(pugi::xml_node& node) override {
      const auto attributes = node.attributes();
      if (depth() > kDeepest ||
          std::distance(attributes.begin(), attributes.end()) > kMostAttributes) {
        found = node;
      }
      return !found;
    }
    pugi::xml_node found;
  } walker;
  pugi::xml_node start = root;
  start.traverse(walker);
  return walker.found;
}

}  // namespace

XmlDocument::XmlDocument(const std::filesystem::path& file, const std::string& what)
    : file_(file), what_(what), text_(read_text_file(file, what)) {
  if (std::ranges::count(text_, '<') > kMostTags) {
    throw InputError({file_.string(), "", "more than " + std::to_string(kMostTags) + " tags", what_,
                      "Is this the right file?"});
  }
  const pugi::xml_parse_result result = nodes_.load_buffer(
      text_.data(), text_.size(),
      pugi::parse_default | pugi::parse_comments | pugi::parse_declaration, pugi::encoding_utf8);
  if (!result) {
    throw InputError({where(result.offset), "", std::string("broken XML: ") + result.description(),
                      what_, "Check the tags around this line"});
  }
  if (const pugi::xml_node found = find_excessive(nodes_)) {
    throw InputError({where(found), "",
                      "an element nested deeper than " + std::to_string(kDeepest) +
                          " or with more than " + std::to_string(kMostAttributes) + " attributes",
                      what_, "Is this the right file?"});
  }
}

pugi::xml_node XmlDocument::root(const std::string& name) const {
  const pugi::xml_node top = nodes_.document_element();
  if (name != top.name()) {
    throw InputError({where(top), "top element", "<" + std::string(top.name()) + ">",
                      "<" + name + ">", "Is this " + what_ + "?"});
  }
  return top;
}

std::string XmlDocument::where(const pugi::xml_node& node) const {
  return node ? where(node.offset_debug()) : file_.string();
}

std::string XmlDocument::where(std::ptrdiff_t offset) const {
  const auto end = std::clamp<std::ptrdiff_t>(offset, 0, std::ssize(text_));
  const auto line = 1 + std::count(text_.begin(), text_.begin() + end, '\n');
  return file_.string() + ":" + std::to_string(line);
}

std::string XmlDocument::need(const pugi::xml_node& node, const char* attribute) const {
  const std::string value = node.attribute(attribute).value();
  if (value.empty()) {
    throw InputError({where(node), "<" + std::string(node.name()) + ">",
                      std::string("no ") + attribute, std::string(attribute) + "=\"…\"", ""});
  }
  return value;
}

std::string xml_text(const pugi::xml_document& document) {
  std::ostringstream stream;
  document.save(stream, "  ", pugi::format_default, pugi::encoding_utf8);
  return stream.str();
}

}  // namespace handway::geometric
