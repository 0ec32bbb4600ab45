#include "handway/geometric/collision/narrow_phase/closest_points.h"

#include "collision/narrow_phase/narrow_phase_query.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace handway::geometric {

/// Surfaces of the requested bodies, and buffers of the queries.
struct ClosestPointFinder::Surfaces {
  explicit Surfaces(const CollisionWorld& world) : of_bodies(world.bodies().size()) {}

  const Surface& of(const CollisionWorld& world, int body) {
    std::shared_ptr<const Surface>& surface = of_bodies[static_cast<std::size_t>(body)];
    if (!surface) {
      surface = make_surfaces({world.body(body).mesh}).front();
    }
    return *surface;
  }

  std::vector<std::shared_ptr<const Surface>> of_bodies;  ///< Null until requested.
  std::vector<std::uint32_t> triangles;
  std::vector<Pose> X_BL;
  std::vector<Pose> X_WBody;
};

ClosestPointFinder::ClosestPointFinder(std::shared_ptr<const CollisionWorld> world)
    : world_(std::move(world)), surfaces_(std::make_unique<Surfaces>(*world_)) {}

ClosestPointFinder::~ClosestPointFinder() = default;

std::optional<ClosestPoints> ClosestPointFinder::between(std::string_view a, std::string_view b,
                                                         const Configuration& q) {
  const auto& bodies = world_->bodies();
  const auto find = [&](std::string_view name) {
    return std::ranges::find(bodies, name, &CollisionBody::name);
  };
  const auto body_a = find(a);
  const auto body_b = find(b);
  if (body_a == bodies.end() || body_b == bodies.end()) {
    return std::nullopt;
  }
  std::vector<Pose>& X_WBody = surfaces_->X_WBody;
  surfaces_->X_BL.resize(static_cast<std::size_t>(world_->model().link_count()));
  X_WBody.resize(bodies.size());
  world_->place(q, surfaces_->X_BL, X_WBody);
  const auto a_index = static_cast<int>(body_a - bodies.begin());
  const auto b_index = static_cast<int>(body_b - bodies.begin());
  return between(a_index, b_index, X_WBody[static_cast<std::size_t>(a_index)],
                 X_WBody[static_cast<std::size_t>(b_index)]);
}

std::optional<ClosestPoints> ClosestPointFinder::between(int a, int b, const Pose& X_WA,
                                                         const Pose& X_WB, double enough) {
  const Surface& of_a = surfaces_->of(*world_, a);
  const Surface& of_b = surfaces_->of(*world_, b);
  if (gives_spheres(of_a, of_b)) {
    return NarrowPhaseQuery(of_a, of_b, X_WA, X_WB, surfaces_->triangles).closest_points(enough);
  }
  auto found =
      NarrowPhaseQuery(of_b, of_a, X_WB, X_WA, surfaces_->triangles).closest_points(enough);
  if (found) {
    std::swap(found->p_WA, found->p_WB);
  }
  return found;
}

}  // namespace handway::geometric
