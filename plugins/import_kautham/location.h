#pragma once

#include "handway/geometric/math/pose.h"
#include "xml_file.h"

namespace handway::import_kautham {

/// The pose that a Location, Home or PreTrans element gives: X, Y, Z in mm, then
/// a turn by TH degrees about the axis (WX, WY, WZ), which needs no unit length.
/// @throws InputError if a number is missing, or an angle has no axis.
[[nodiscard]] geometric::Pose read_location(const XmlFile& xml, pugi::xml_node node);

}  // namespace handway::import_kautham
