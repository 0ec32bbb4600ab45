#pragma once

#include "handway/geometric/math/pose.h"
#include "xml_file.h"

#include <array>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace handway::import_kautham {

/// Range of a robot's base along x, y and z of the world, m.
using BaseLimits = std::array<std::pair<double, double>, 3>;

/// A problem file of Kautham 2013 or later, before the files named in it are opened.
struct KauthamProblem {
  /// A Robot element.
  struct PlacedRobot {
    std::filesystem::path file;  ///< Path in the file, relative to the problem's folder.
    double scale = 1.0;          ///< Scale of the meshes.
    geometric::Pose X_WH = geometric::Pose::Identity();  ///< Home.
    BaseLimits limits = {};
  };
  /// A Scene element, or an Obstacle of later versions.
  struct Obstacle {
    std::filesystem::path mesh;  ///< Path in the file, relative to the problem's folder.
    double scale = 1.0;
    geometric::Pose X_WO = geometric::Pose::Identity();  ///< Location, or Home.
  };

  std::filesystem::path file;
  std::string name;
  /// Units: metres and radians for later versions with unscaled URDF files.
  Units units = {};
  std::filesystem::path controls;  ///< `.cntr`, as written; empty: in the robots' files.
  std::vector<PlacedRobot> robots;
  std::vector<Obstacle> obstacles;
  std::string planner;                                          ///< May be empty.
  std::vector<std::pair<std::string, std::string>> parameters;  ///< Texts for the planner.
  std::vector<double> init;  ///< Controls of all robots; empty: no start.
  std::vector<double> goal;  ///< Controls of all robots at the goal.
  std::string query_place;   ///< "file:line" of the query.
  std::vector<std::string> warnings;
};

/// @throws InputError naming file, line, element, the value found and the expected one.
[[nodiscard]] KauthamProblem read_kautham_problem(const std::filesystem::path& file);

}  // namespace handway::import_kautham
