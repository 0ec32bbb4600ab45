#pragma once

#include "formats/xml_document.h"
#include "handway/geometric/math/pose.h"

#include <cstddef>
#include <string>
#include <vector>

namespace handway::geometric {

/// Reads parts of elements of a URDF file (http://wiki.ros.org/urdf/XML). The argument `element`
/// of the functions names the link or joint in messages, such as "joint elbow". Errors name the
/// line of the XML element.
class UrdfElements {
 public:
  /// Largest number that is read, m or rad: what is beyond is a slip, or means "no limit".
  static constexpr double kLargestNumber = 1e6;

  /// @param document must outlive this object.
  explicit UrdfElements(const XmlDocument& document) : document_(document) {}

  [[nodiscard]] const XmlDocument& document() const { return document_; }

  /// Throws an InputError about an XML element.
  [[noreturn]] void refuse(const pugi::xml_node& node, const std::string& element,
                           const std::string& found, const std::string& expected,
                           const std::string& advice = "") const;

  /// Returns the numbers of an attribute, which blanks separate.
  /// @throws InputError if there are not `count` of them, or one is not within ±1e6.
  [[nodiscard]] std::vector<double> numbers(const pugi::xml_node& node, const std::string& element,
                                            const char* attribute, std::size_t count) const;
  /// Returns the number of an attribute, or `otherwise` without that attribute.
  /// @throws InputError as numbers().
  [[nodiscard]] double number(const pugi::xml_node& node, const std::string& element,
                              const char* attribute, double otherwise) const;
  /// Returns the numbers of an attribute that must be there.
  /// @throws InputError as numbers(), and if one is not above 0.
  [[nodiscard]] std::vector<double> sizes(const pugi::xml_node& node, const std::string& element,
                                          const char* attribute, std::size_t count) const;
  /// Returns the pose of the <origin>: the identity without one. A second <origin> is noted.
  /// @throws InputError as numbers().
  [[nodiscard]] Pose origin(const pugi::xml_node& parent, const std::string& element);

  /// Returns the only child of that name; an empty node if there is none.
  /// @throws InputError for a second one.
  [[nodiscard]] pugi::xml_node only(const pugi::xml_node& parent, const std::string& element,
                                    const char* name) const;
  /// @throws InputError if an attribute is missing or empty.
  void need(const pugi::xml_node& node, const std::string& element, const char* attribute) const;

  /// Returns the elements that have a second <origin>, and where.
  [[nodiscard]] const std::vector<std::string>& second_origins() const { return second_origins_; }

 private:
  const XmlDocument& document_;
  std::vector<std::string> second_origins_;
};

/// Appends "WHAT: NAME, NAME, …" to `warnings`, or nothing without names.
void add_warning(const std::string& what, const std::vector<std::string>& names,
                 std::vector<std::string>& warnings);

/// Returns warnings about elements of a URDF file that are not read, such as vendors' elements.
/// @throws InputError naming the line of a misspelt element, or of a misplaced one that planning
/// needs.
[[nodiscard]] std::vector<std::string> check_urdf_names(const XmlDocument& document);

}  // namespace handway::geometric
