#pragma once

#include "handway/geometric/math/pose.h"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace handway::import_kautham {

/// A problem file of Kautham 2013, before the files it names are opened.
struct KauthamProblem {
  /// A Robot element.
  struct PlacedRobot {
    std::filesystem::path file;  ///< As written, relative to the problem's folder.
    double scale = 1.0;          ///< Of the meshes.
    geometric::Pose X_WH = geometric::Pose::Identity();  ///< Home.
  };
  /// A Scene element: an obstacle.
  struct Obstacle {
    std::filesystem::path mesh;  ///< As written, relative to the problem's folder.
    double scale = 1.0;
    geometric::Pose X_WO = geometric::Pose::Identity();  ///< Location.
  };

  std::filesystem::path file;
  std::string name;
  std::vector<PlacedRobot> robots;
  std::vector<Obstacle> obstacles;
  std::string planner;                                          ///< May be empty.
  std::vector<std::pair<std::string, std::string>> parameters;  ///< Of the planner, as written.
  std::vector<double> init;  ///< Controls of all robots; empty: no query.
  std::vector<double> goal;
  std::string query_place;  ///< "file:line" of the query.
  std::vector<std::string> warnings;
};

/// @throws InputError naming file, line, element, what was found and expected.
[[nodiscard]] KauthamProblem read_kautham_problem(const std::filesystem::path& file);

}  // namespace handway::import_kautham
