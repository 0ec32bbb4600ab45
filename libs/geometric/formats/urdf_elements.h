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

  /// "3 visual elements can't be read, the collision geometry is drawn instead: …"; empty
  /// if there is nothing to tell.
  [[nodiscard]] std::string summary() const;

 private:
  std::vector<std::string> faults_;
};

/// Name of a cylinder in the text that stands for a capsule, which urdfdom doesn't know.
inline constexpr const char* kCapsule = "capsule";

/// The elements of a URDF file, checked.
struct UrdfElements {
  std::string text;  ///< The file for urdfdom: what is read of it, and no more.
  /// The links of the text, with how many collision elements each has.
  std::map<std::string, std::ptrdiff_t> links;
  std::vector<std::string> warnings;  ///< Elements that are ignored.
  DrawingFaults drawing;              ///< Elements that can't be drawn.
};

/// Checks what urdfdom drops without a word or with one for the log: shapes, origins and
/// joints with broken numbers, misspelt and misplaced elements, and with them the rest of
/// their link. What planning does without (inertia, dynamics, materials, what vendors add)
/// is left out of the text, so that it can't cost a link its geometry; visual elements that
/// can't be read too, as drawing faults.
/// @throws InputError naming the line of what planning needs and can't be read.
[[nodiscard]] UrdfElements check_urdf_elements(const XmlDocument& document);

}  // namespace handway::geometric
