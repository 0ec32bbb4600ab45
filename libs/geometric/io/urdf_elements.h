#pragma once

#include "io/drawing_faults.h"
#include "io/xml_document.h"

#include <string>
#include <vector>

namespace handway::geometric {

/// The elements of a URDF file, checked.
struct UrdfElements {
  std::string text;                   ///< The file for urdfdom: what is read of it, and no more.
  std::vector<std::string> warnings;  ///< What is not read.
  DrawingFaults drawing;              ///< What of it can't be drawn.
};

/// Checks what urdfdom drops without a word or with one for the log: shapes, origins and
/// joints with broken numbers, misspelt and misplaced elements, and with them the rest of
/// their link. What planning does without (inertia, dynamics, materials, what vendors add)
/// is left out of the text, so that it can't cost a link its geometry; visual elements that
/// can't be read too, as drawing faults.
/// @throws InputError naming the line of what planning needs and can't be read.
[[nodiscard]] UrdfElements check_urdf_elements(const XmlDocument& document);

}  // namespace handway::geometric
