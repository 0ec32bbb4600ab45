#include "handway/planning/edits/cloud_import.h"

#include "handway/geometric/formats/cloud_reader.h"
#include "handway/planning/edits/scene_edits.h"

#include <chrono>
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

}  // namespace

ImportedCloud import_cloud(const SceneState& state, const geometric::Configuration& q,
                           geometric::PointCloud cloud, const CloudImport& import,
                           const std::string& source) {
  const auto begin = std::chrono::steady_clock::now();
  ImportedCloud result;
  if (import.box) {
    result.outside = keep(cloud, geometric::within_box(cloud, import.X_WC, *import.box));
  }
  if (import.robot_margin) {
    result.of_bodies = keep(cloud, geometric::without_bodies(cloud, import.X_WC, *state.scene, q,
                                                             import.cut_out, *import.robot_margin));
  }
  if (import.outliers) {
    result.outliers = keep(cloud, geometric::without_outliers(cloud, *import.outliers));
  }
  geometric::SceneObject object;
  object.name = unused_name(*state.scene, import.name);
  object.X_PO = import.X_WC;
  object.shape = geometric::make_cloud(
      std::make_shared<const geometric::PointCloud>(std::move(cloud)), import.cells, source);
  result.name = object.name;
  result.points = std::get<geometric::Cloud>(object.shape).points->size();
  result.state = with_object(state, std::move(object));
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return result;
}

}  // namespace handway::planning
