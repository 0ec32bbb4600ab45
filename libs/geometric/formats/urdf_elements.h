#pragma once

#include "formats/xml_document.h"
#include "handway/geometric/io/input_error.h"

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace handway::geometric {

/// Elements that can't be drawn. Planning doesn't need them: they are reported in one warning.
class DrawingFaults {
 public:
  void add(const InputError& fault);

  /// Text "3 visual elements can't be read, the collision geometry is drawn instead: …"; empty
  /// without faults.
  [[nodiscard]] std::string summary() const;

 private:
  std::vector<std::string> faults_;
};

/// Name of a cylinder in the text that stands for a capsule, which urdfdom doesn't know.
inline constexpr const char* kCapsule = "capsule";

/// The elements of a URDF file, checked.
struct UrdfElements {
  std::string text;  ///< Input of urdfdom: only the elements that are read.
  /// The links of the text, with how many collision elements each has.
  std::map<std::string, std::ptrdiff_t> links;
  std::vector<std::string> warnings;  ///< Elements that are ignored.
  DrawingFaults drawing;              ///< Elements that can't be drawn.
};

/// Checks elements that urdfdom drops silently or with a line in the log: shapes, origins and
/// joints with broken numbers, misspelt and misplaced elements, and with them the rest of their
/// link. Elements that planning ignores (inertia, dynamics, materials, vendors' elements) are left
/// out of the text, so that they can't cost a link its geometry. So are visual elements that can't
/// be read, which become drawing faults.
/// @throws InputError naming the line of an element that planning needs and that can't be read.
[[nodiscard]] UrdfElements check_urdf_elements(const XmlDocument& document);

}  // namespace handway::geometric
