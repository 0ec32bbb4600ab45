#pragma once

#include "io/xml_document.h"

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace handway::geometric {

/// What may stand in an element of a format.
struct XmlElementKind {
  std::vector<std::string> children = {};
  std::vector<std::string> attributes = {};  ///< Empty: any.
};

/// The elements of a format by name. An element has the same children wherever it stands;
/// those that are not listed are not looked into.
using XmlVocabulary = std::map<std::string, XmlElementKind, std::less<>>;

/// Finds what a reader would pass over without a word, below the top element.
///
/// A name within two letters of one that may stand there is a slip: refused. So is an element
/// of `needed` where it may not stand: what it says would be lost. Other names are those of
/// vendors and later versions: gathered, to be reported in one warning.
/// @returns "<gazebo> (3)", …: what is not read, and how often it is there; sorted.
/// @throws InputError naming the line.
[[nodiscard]] std::vector<std::string> unread_elements(const XmlDocument& document,
                                                       const pugi::xml_node& top,
                                                       const XmlVocabulary& vocabulary,
                                                       const std::vector<std::string>& needed);

}  // namespace handway::geometric
