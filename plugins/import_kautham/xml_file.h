#pragma once

#include "handway/geometric/math/pose.h"
#include "handway/geometric/math/units.h"

#include <pugixml.hpp>

#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace handway::import_kautham {

/// An XML file with checked access: every error names the file, the line, the element and the
/// expected contents.
class XmlFile {
 public:
  /// @throws InputError if the file can't be opened, is not XML, or its root element is not
  /// `root`.
  XmlFile(const std::filesystem::path& file, const char* root);
  XmlFile(const XmlFile&) = delete;
  XmlFile& operator=(const XmlFile&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] pugi::xml_node root() const { return root_; }

  /// The child element. @throws InputError if it is missing.
  [[nodiscard]] pugi::xml_node child(pugi::xml_node node, const char* name) const;
  /// The attribute's text without spaces around it. @throws InputError if it is missing or empty.
  [[nodiscard]] std::string text(pugi::xml_node node, const char* attribute) const;
  /// @throws InputError if it is missing or not a finite number.
  [[nodiscard]] double number(pugi::xml_node node, const char* attribute) const;
  /// Returns `otherwise` for a missing attribute. @throws InputError if it is not a finite number.
  [[nodiscard]] double number_or(pugi::xml_node node, const char* attribute,
                                 double otherwise) const;
  /// @throws InputError if it is missing or neither true nor false.
  [[nodiscard]] bool flag(pugi::xml_node node, const char* attribute) const;

  /// Checks that no child element of `node` is misspelt: neither a known one nor within two letters
  /// of one. Other elements are allowed.
  void refuse_slips(pugi::xml_node node, std::initializer_list<std::string> known) const;

  /// An error about `node`, or about its attribute unless that is empty.
  [[noreturn]] void refuse(pugi::xml_node node, std::string_view attribute,
                           const std::string& found, const std::string& expected,
                           const std::string& advice = "") const;
  /// "file:line" of the node.
  [[nodiscard]] std::string place(pugi::xml_node node) const;

  /// Stores a warning about `node`, for notes().
  void note(pugi::xml_node node, const std::string& what) const;
  [[nodiscard]] const std::vector<std::string>& notes() const { return notes_; }

 private:
  [[nodiscard]] std::string line_at(std::ptrdiff_t offset) const;

  std::filesystem::path path_;
  std::string content_;
  pugi::xml_document document_;
  pugi::xml_node root_;
  mutable std::vector<std::string> notes_;
};

/// Returns the text in quotation marks.
[[nodiscard]] std::string in_quotes(std::string_view text);

/// Units of the numbers in a file.
struct Units {
  double length = geometric::kMillimetre;  ///< m
  double angle = geometric::kDegree;       ///< rad
};

/// The pose that a Location, Home or PreTrans element gives: X, Y, Z, then a rotation by TH about
/// the axis (WX, WY, WZ), which needs no unit length. As in Kautham, an angle about the axis (0, 0,
/// 0) is ignored, with a note.
/// @throws InputError if a number is missing.
[[nodiscard]] geometric::Pose read_location(const XmlFile& xml, pugi::xml_node node,
                                            const Units& units = {});

}  // namespace handway::import_kautham
