#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace handway::import_mjcf {

/// Meshes that MuJoCo refused, with its reasons, by name: boxes replace them.
using FaultyMeshes = std::map<std::string, std::string>;

/// A mesh named in a file.
struct MjcfMesh {
  std::filesystem::path file;  ///< Absolute path where it must be.
  std::string place;           ///< "FILE:LINE" of the element.
  bool missing = false;
  int geometries = 0;  ///< Number of geometries that name it.
};

/// Two bodies, or sites, that are connected.
struct MjcfLoop {
  std::string first;
  std::string second;  ///< Empty: the world.
  std::string anchor;  ///< In the frame of body `first`, three numbers; empty: not by a point.
};

/// An MJCF file with the files that it includes, as one text for MuJoCo 2.2.
struct MjcfText {
  std::string text;
  std::vector<std::string> places;  ///< "FILE:LINE" of each line's element.
  std::vector<MjcfLoop> loops;
  std::vector<std::string> unread;         ///< "ATTRIBUTE of <ELEMENT>", unknown to MuJoCo.
  std::map<std::string, MjcfMesh> meshes;  ///< By name; those with a file.
};

/// Actuators, sensors, lights, cameras and inertia are not needed for planning: the text does not
/// have them, so that they can't make MuJoCo refuse a robot when it does not know them or misses a
/// file. Joints with a range are limited and frames are bodies, as in later versions of MuJoCo, and
/// attributes of those are left out unless they look misspelt. Box kStandIn is written for meshes
/// that are missing or faulty.
/// @throws InputError naming the line if a file is not XML, or includes itself.
[[nodiscard]] MjcfText mjcf_text(const std::filesystem::path& file, const FaultyMeshes& faulty);

/// Half the sides of the box that replaces meshes, m, centred at its origin: its axes are the axes
/// of inertia, in MuJoCo's order.
inline constexpr std::array kStandIn{1.0, 2.0, 3.0};

}  // namespace handway::import_mjcf
