#pragma once

#include "formats/xml_document.h"

#include <pugixml.hpp>

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace handway::geometric {

/// Allowed contents of an element of a format.
struct XmlElementKind {
  std::vector<std::string> children = {};
  std::vector<std::string> attributes = {};  ///< Empty: any.
};

/// The elements of a format by name. An element has the same children in every place; those that
/// are not listed are not searched.
using XmlVocabulary = std::map<std::string, XmlElementKind, std::less<>>;

/// Finds elements and attributes that a reader would ignore silently, below the top element.
///
/// A name within two letters of an allowed one is a misspelling: refused, unless the intended
/// attribute is there, too. Unexpanded xacro elements and misplaced elements of `needed` are
/// refused too: their contents would be lost. Other names belong to vendors and later versions:
/// they are collected, to be reported in one warning.
/// @returns "<gazebo> (3)", …: names of ignored elements and their numbers; sorted.
/// @throws InputError naming the line.
[[nodiscard]] std::vector<std::string> unread_elements(const XmlDocument& document,
                                                       const pugi::xml_node& top,
                                                       const XmlVocabulary& vocabulary,
                                                       const std::vector<std::string>& needed);

}  // namespace handway::geometric
