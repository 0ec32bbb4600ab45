#include "formats/xml_vocabulary.h"

#include "handway/geometric/io/input_error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <string_view>

namespace handway::geometric {
namespace {

bool contains(const std::vector<std::string>& names, std::string_view name) {
  return std::ranges::find(names, name) != names.end();
}

// Returns whether xacro removes the element. A call of a macro that it did not know stays in its
// output.
bool is_of_xacro(std::string_view name) {
  static const std::vector<std::string> kOwn = {
      "xacro:macro", "xacro:include", "xacro:property",     "xacro:arg",
      "xacro:if",    "xacro:unless",  "xacro:insert_block", "xacro:call"};
  return contains(kOwn, name);
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
    if (is_of_xacro(name)) {
      refuse(child, parent, fmt::format("<{}>", name), "a file without macros",
             "Give it a name that ends in .xacro: such files are converted as they are read");
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
      const std::optional<std::string> meant = slip_of(name, known);
      if (meant && !element.attribute(meant->c_str())) {
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
