#include "handway/planning/edits/cloud_import.h"

#include "handway/geometric/formats/cloud_reader.h"
#include "handway/geometric/setup/object_proposal.h"
#include "handway/planning/edits/scene_edits.h"

#include <cstddef>
#include <iterator>
#include <memory>
#include <utility>

namespace handway::planning {
namespace {

/// Replaces the cloud by a part of it. @returns how many points have gone.
std::size_t keep(geometric::PointCloud& cloud, geometric::PointCloud part) {
  const std::size_t gone = cloud.size() - part.size();
  cloud = std::move(part);
  return gone;
}

/// Takes the points of tables and what stands on them out of a cloud. @returns these objects.
std::vector<geometric::SceneObject> take_objects(geometric::PointCloud& cloud,
                                                 const geometric::Scene& scene,
                                                 const geometric::Configuration& q,
                                                 const geometric::Pose& X_WC) {
  constexpr double kMargin = 0.005;  // m
  geometric::Scene with_found = scene;
  geometric::BodyFilter found{false, {}, kMargin};
  for (geometric::SceneObject& object : geometric::propose_objects(cloud, X_WC)) {
    object.name = unused_name(with_found, object.name);
    found.objects.push_back(object.name);
    with_found.objects.push_back(std::move(object));
  }
  cloud = geometric::without_bodies(cloud, X_WC, with_found, q, found);
  const auto first = with_found.objects.end() - static_cast<std::ptrdiff_t>(found.objects.size());
  return {std::move_iterator(first), std::move_iterator(with_found.objects.end())};
}

}  // namespace

ImportedCloud import_cloud(const geometric::Scene& scene, const geometric::Configuration& q,
                           geometric::PointCloud cloud, const CloudImport& import,
                           const std::string& source) {
  ImportedCloud result;
  if (import.box) {
    result.outside = keep(cloud, geometric::within_box(cloud, import.X_WC, *import.box));
  }
  result.of_bodies =
      keep(cloud, geometric::without_bodies(cloud, import.X_WC, scene, q, import.bodies));
  if (import.outliers) {
    result.outliers = keep(cloud, geometric::without_outliers(cloud, *import.outliers));
  }
  const std::size_t filtered = cloud.size();
  if (import.finds_objects) {
    result.objects = take_objects(cloud, scene, q, import.X_WC);
  }
  result.points = cloud.size();
  result.of_found = filtered - result.points;
  if (result.points > 0 || result.objects.empty()) {
    geometric::SceneObject& object = result.objects.emplace_back();
    object.name = unused_name(scene, import.name);
    object.X_PO = import.X_WC;
    object.shape = geometric::make_cloud(
        std::make_shared<const geometric::PointCloud>(std::move(cloud)), import.cells, source);
  }
  return result;
}

SceneState with_cloud(const SceneState& state, const ImportedCloud& cloud) {
  SceneState next = state;
  for (const geometric::SceneObject& object : cloud.objects) {
    next = with_object(next, object);
  }
  return next;
}

}  // namespace handway::planning
