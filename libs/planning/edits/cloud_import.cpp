#include "handway/planning/edits/cloud_import.h"

#include "handway/geometric/formats/cloud_reader.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/math/units.h"
#include "handway/geometric/setup/hidden_space.h"
#include "handway/geometric/setup/object_proposal.h"
#include "handway/planning/edits/scene_edits.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

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

/// Points in a frame of their own.
struct PlacedCloud {
  geometric::PointCloud cloud;
  geometric::Pose X_WC = geometric::Pose::Identity();

  void leave_out(const geometric::Scene& scene, const geometric::Configuration& q,
                 const geometric::BodyFilter& bodies) {
    if (cloud.size() > 0) {
      cloud = geometric::without_bodies(cloud, X_WC, scene, q, bodies);
    }
  }
};

/// Takes the points of tables and what stands on them out of what was seen, and the cells in them
/// out of what is hidden. @returns these objects.
std::vector<geometric::SceneObject> take_objects(PlacedCloud& seen, PlacedCloud& hidden,
                                                 const geometric::Scene& scene,
                                                 const geometric::Configuration& q) {
  constexpr double kMargin = 0.005;  // m
  geometric::Scene with_found = scene;
  geometric::BodyFilter found{false, {}, kMargin};
  for (geometric::SceneObject& object : geometric::propose_objects(seen.cloud, seen.X_WC)) {
    object.name = unused_name(with_found, object.name);
    found.objects.push_back(object.name);
    with_found.objects.push_back(std::move(object));
  }
  seen.leave_out(with_found, q, found);
  hidden.leave_out(with_found, q, found);
  const auto first = with_found.objects.end() - static_cast<std::ptrdiff_t>(found.objects.size());
  return {std::move_iterator(first), std::move_iterator(with_found.objects.end())};
}

geometric::Aabb bounds_of(const PlacedCloud& placed) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3f& point : placed.cloud.points) {
    box.extend(placed.X_WC * point.cast<double>());
  }
  return {box.min(), box.max()};
}

/// Returns the cells that the points hide, without those of bodies that are left out.
PlacedCloud hidden_by(const PlacedCloud& seen, const geometric::Scene& scene,
                      const geometric::Configuration& q, const CloudImport& import) {
  PlacedCloud hidden;
  if (import.hidden_from && seen.cloud.size() > 0) {
    const geometric::Aabb box = import.box.value_or(bounds_of(seen));
    hidden.cloud =
        geometric::hidden_cells(seen.cloud, *import.hidden_from, seen.X_WC, box, import.cells.size);
    hidden.X_WC.translation() = box.lower;
    hidden.leave_out(scene, q, import.bodies);
  }
  return hidden;
}

geometric::SceneObject object_of(PlacedCloud placed, const geometric::CloudCells& cells,
                                 const std::string& name, const std::string& source) {
  geometric::SceneObject object;
  object.name = name;
  object.X_PO = placed.X_WC;
  object.shape = geometric::make_cloud(
      std::make_shared<const geometric::PointCloud>(std::move(placed.cloud)), cells, source);
  return object;
}

constexpr geometric::Color kHiddenColor{0.45F, 0.45F, 0.55F, 0.35F};

}  // namespace

std::vector<geometric::BoundParameter> parameters_of(CloudImport& import) {
  using geometric::in_thousandths;
  constexpr double kSmallest = geometric::millimetres(geometric::kSmallestCell);
  constexpr double kLargest = geometric::millimetres(geometric::kLargestCell);
  return {
      in_thousandths({"cell_mm", "Cell", "mm", "Edge of the cells that become solid",
                      &import.cells.size, kSmallest, kLargest}),
      in_thousandths({"radius_mm", "Radius", "mm",
                      "Cells nearer to a point than this become solid, too; at most five times "
                      "the cell",
                      &import.cells.radius, 0.0, geometric::most_radius(kLargest)}),
      in_thousandths({"margin_mm", "Margin", "mm",
                      "Leave out points nearer than this to robots, what they carry, and objects "
                      "that are cut out",
                      &import.bodies.margin, 0.0, 1000.0}),
      {"find_objects", "Find tables and objects", "",
       "Find tables and what stands on them: boxes, upright cylinders and spheres, in place of "
       "their points",
       &import.finds_objects}};
}

ImportedCloud import_cloud(const geometric::Scene& scene, const geometric::Configuration& q,
                           geometric::PointCloud cloud, const CloudImport& import,
                           const std::string& source) {
  if (import.cells.radius > geometric::most_radius(import.cells.size)) {
    throw geometric::InputError(
        {source, "radius", fmt::format("{:g} mm", geometric::millimetres(import.cells.radius)),
         "at most five times the cell", "Make the cells larger"});
  }
  ImportedCloud result;
  PlacedCloud seen{std::move(cloud), import.X_WC};
  if (import.box) {
    result.outside = keep(seen.cloud, geometric::within_box(seen.cloud, seen.X_WC, *import.box));
  }
  result.of_bodies =
      keep(seen.cloud, geometric::without_bodies(seen.cloud, seen.X_WC, scene, q, import.bodies));
  if (import.outliers) {
    result.outliers = keep(seen.cloud, geometric::without_outliers(seen.cloud, *import.outliers));
  }
  const std::size_t filtered = seen.cloud.size();
  PlacedCloud hidden = hidden_by(seen, scene, q, import);
  if (import.finds_objects) {
    result.objects = take_objects(seen, hidden, scene, q);
  }
  result.points = seen.cloud.size();
  result.of_found = filtered - result.points;
  result.hidden = hidden.cloud.size();
  if (result.points > 0 || result.objects.empty()) {
    result.objects.push_back(
        object_of(std::move(seen), import.cells, unused_name(scene, import.name), source));
  }
  if (result.hidden > 0) {
    result.objects.push_back(object_of(std::move(hidden), {import.cells.size, 0.0},
                                       unused_name(scene, import.name + " hidden"), source));
    result.objects.back().color = kHiddenColor;
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
