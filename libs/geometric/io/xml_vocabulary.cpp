#include "io/xml_vocabulary.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/nearest_name.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace handway::geometric {
namespace {

bool contains(const std::vector<std::string>& names, std::string_view name) {
  return std::ranges::find(names, name) != names.end();
}

class Walk {
 public:
  Walk(const XmlDocument& document, const XmlVocabulary& vocabulary,
       const std::vector<std::string>& needed)
      : document_(document), vocabulary_(vocabulary), needed_(needed) {}

  void look_into(const pugi::xml_node& element) {
    const auto kind = vocabulary_.find(std::string_view(element.name()));
    if (kind == vocabulary_.end()) {
      return;
    }
    look_at_attributes(element, kind->second.attributes);
    for (const pugi::xml_node& child : element.children()) {
      if (child.type() != pugi::node_element) {
        continue;
      }
      if (contains(kind->second.children, child.name())) {
        look_into(child);
      } else {
        look_at_stranger(element, child, kind->second.children);
      }
    }
  }

  [[nodiscard]] std::vector<std::string> unread() const {
    std::vector<std::string> list;
    for (const auto& [name, count] : unread_) {
      list.push_back(count == 1 ? name : fmt::format("{} ({})", name, count));
    }
    return list;
  }

 private:
  [[noreturn]] void refuse(const pugi::xml_node& at, const pugi::xml_node& element,
                           const std::string& found, const std::string& expected,
                           const std::string& advice) const {
    throw InputError(
        {document_.where(at), fmt::format("<{}>", element.name()), found, expected, advice});
  }

  void look_at_stranger(const pugi::xml_node& parent, const pugi::xml_node& child,
                        const std::vector<std::string>& known) {
    const std::string name = child.name();
    if (name.starts_with("xacro:")) {
      refuse(child, parent, fmt::format("<{}>", name), "a file without macros",
             "Convert it with the xacro tool first");
    }
    if (const std::optional<std::string> meant = slip_of(name, known)) {
      refuse(child, parent, fmt::format("the unknown element <{}>", name), join(known),
             fmt::format("Did you mean <{}>?", *meant));
    }
    if (contains(needed_, name)) {
      refuse(child, parent, fmt::format("<{}>, which has no place in it", name), join(known), "");
    }
    ++unread_[fmt::format("<{}>", name)];
  }

  void look_at_attributes(const pugi::xml_node& element, const std::vector<std::string>& known) {
    if (known.empty()) {
      return;
    }
    for (const pugi::xml_attribute& attribute : element.attributes()) {
      const std::string name = attribute.name();
      if (contains(known, name)) {
        continue;
      }
      if (const std::optional<std::string> meant = slip_of(name, known)) {
        refuse(element, element, fmt::format("the unknown attribute {}", name), join(known),
               fmt::format("Did you mean {}?", *meant));
      }
      ++unread_[fmt::format("{} of <{}>", name, element.name())];
    }
  }

  static std::string join(const std::vector<std::string>& names) {
    return names.empty() ? "nothing" : fmt::format("{}", fmt::join(names, ", "));
  }

  const XmlDocument& document_;
  const XmlVocabulary& vocabulary_;
  const std::vector<std::string>& needed_;
  std::map<std::string, int> unread_;
};

}  // namespace

std::vector<std::string> unread_elements(const XmlDocument& document, const pugi::xml_node& top,
                                         const XmlVocabulary& vocabulary,
                                         const std::vector<std::string>& needed) {
  Walk walk(document, vocabulary, needed);
  walk.look_into(top);
  return walk.unread();
}

}  // namespace handway::geometric
