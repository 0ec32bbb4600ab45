#include "collision/broad_phase/oriented_boxes.h"

#include <Eigen/Core>

#include <cmath>

namespace handway::geometric {
namespace {

constexpr int kFaces = 3;  // faces of a box with distinct axes

struct PlacedBox {
  const Pose& X_WBody;
  const Eigen::Vector3d& half;
};

// Gap along an axis of the first box; the other's centre is at `between` (m, world).
double gap(const PlacedBox& box, const PlacedBox& other, const Eigen::Vector3d& between, int axis) {
  const Eigen::Vector3d normal = box.X_WBody.linear().col(axis);
  const Eigen::Vector3d along = other.X_WBody.linear().transpose() * normal;
  return std::abs(normal.dot(between)) - box.half[axis] - along.cwiseAbs().dot(other.half);
}

}  // namespace

OrientedBoxes::OrientedBoxes(const CollisionWorld& world) : pairs_(world.pairs()) {
  boxes_.reserve(world.bodies().size());
  for (const CollisionBody& body : world.bodies()) {
    const Aabb box = bounding_box(*body.mesh);
    boxes_.push_back({box.centre(), 0.5 * box.size()});
  }
}

bool OrientedBoxes::are_apart(int pair, std::span<const Pose> X_WBody, double distance,
                              LastAxes& last) const {
  const BodyPair& bodies = pairs_[static_cast<std::size_t>(pair)];
  const auto i = static_cast<std::size_t>(bodies.a);
  const auto j = static_cast<std::size_t>(bodies.b);
  const PlacedBox a{X_WBody[i], boxes_[i].half};
  const PlacedBox b{X_WBody[j], boxes_[j].half};
  const Eigen::Vector3d between = X_WBody[j] * boxes_[j].centre - X_WBody[i] * boxes_[i].centre;
  std::uint8_t& first = last[static_cast<std::size_t>(pair)];
  for (int k = 0; k < 2 * kFaces; ++k) {
    const int axis = (first + k) % (2 * kFaces);
    const double apart =
        axis < kFaces ? gap(a, b, between, axis) : gap(b, a, between, axis - kFaces);
    if (apart >= distance) {
      first = static_cast<std::uint8_t>(axis);
      return true;
    }
  }
  return false;
}

}  // namespace handway::geometric
