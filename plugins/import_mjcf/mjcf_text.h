#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace handway::import_mjcf {

/// What MuJoCo turned out not to take of a file, and is left out of its text.
struct MjcfOmissions {
  std::set<std::pair<std::string, std::string>> attributes;  ///< Element and attribute.
  std::set<std::string> meshes;                              ///< By name: boxes stand in for them.
};

/// A mesh that a file names.
struct MjcfMesh {
  std::filesystem::path file;  ///< Where it must be; absolute.
  std::string place;           ///< "FILE:LINE" of the element.
  bool missing = false;
  int geometries = 0;  ///< How many name it.
};

/// An MJCF file and those that it includes, as one text for MuJoCo 2.2.
struct MjcfText {
  std::string text;
  std::vector<std::string> places;         ///< "FILE:LINE" of each line's element.
  std::vector<std::string> loops;          ///< "A with B": bodies that loops connect.
  std::map<std::string, MjcfMesh> meshes;  ///< By name; those with a file.
};

/// Planning does without what acts, senses, lights or looks on, and without inertia: it is not in
/// the text, so that it costs no robot when MuJoCo does not know it or misses a file. Joints with a
/// range are limited and frames are bodies, as in later versions of MuJoCo. Box kStandIn is
/// written for meshes that are missing or among `omissions`.
/// @throws InputError naming the line if a file is no XML, or includes itself.
[[nodiscard]] MjcfText mjcf_text(const std::filesystem::path& file, const MjcfOmissions& omissions);

/// Half the sides of the box that stands in for meshes, m, centred at its origin: so that its axes
/// are its axes of inertia, in MuJoCo's order.
inline constexpr std::array kStandIn{1.0, 2.0, 3.0};

}  // namespace handway::import_mjcf
