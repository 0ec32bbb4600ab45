#pragma once

#include <pugixml.hpp>

#include <filesystem>
#include <string>

namespace handway::geometric {

/// A well-formed XML file whose nodes know their line: of at most 64 MB and a million tags, nested
/// at most 100 deep, with at most 200 attributes an element.
class XmlDocument {
 public:
  /// @param what expected kind of the file, for messages: "a robot file (URDF)".
  /// @throws InputError if the file can't be read, or is not XML (naming the line).
  XmlDocument(const std::filesystem::path& file, const std::string& what);

  /// The top element. @throws InputError if its name is not `name`.
  [[nodiscard]] pugi::xml_node root(const std::string& name) const;

  [[nodiscard]] pugi::xml_document& nodes() { return nodes_; }
  [[nodiscard]] const std::string& text() const { return text_; }
  [[nodiscard]] const std::filesystem::path& file() const { return file_; }

  /// "FILE:LINE" of a node; "FILE" for a null node.
  [[nodiscard]] std::string where(const pugi::xml_node& node) const;

  /// A mandatory attribute that must not be empty.
  /// @throws InputError otherwise.
  [[nodiscard]] std::string need(const pugi::xml_node& node, const char* attribute) const;

 private:
  [[nodiscard]] std::string where(std::ptrdiff_t offset) const;

  std::filesystem::path file_;
  std::string what_;
  std::string text_;
  pugi::xml_document nodes_;
};

/// The text of a document, indented by two blanks, with an XML declaration.
[[nodiscard]] std::string xml_text(const pugi::xml_document& document);

}  // namespace handway::geometric
