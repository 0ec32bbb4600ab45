#pragma once

#include "handway/geometric/mesh/triangle_mesh.h"
#include "handway/geometric/scene/scene.h"

#include <map>
#include <memory>
#include <stop_token>
#include <string>
#include <vector>

namespace handway::gui {

/// Geometry that bodies are drawn with.
enum class BodyDisplay {
  kVisual,     ///< Visual geometry.
  kCollision,  ///< The triangles that collisions are checked with.
  kHulls,      ///< The convex hulls that part two bodies,
  kSpheres,    ///< and the spheres that cover one, before triangles are asked.
};

/// Meshes that replace the visual geometry of a scene's bodies, each in its own frame; null: visual
/// geometry.
struct BodyMeshes {
  std::vector<std::vector<std::shared_ptr<const geometric::TriangleMesh>>> links;  ///< By robot.
  std::map<std::string, std::shared_ptr<const geometric::TriangleMesh>> objects;   ///< By name.
};

/// The meshes that stand in for a scene's bodies; none for BodyDisplay::kVisual. May take
/// seconds the first time; the volumes of links are remembered. For any thread.
[[nodiscard]] BodyMeshes body_meshes(const geometric::Scene& scene, BodyDisplay display,
                                     const std::stop_token& stop = {});

}  // namespace handway::gui
