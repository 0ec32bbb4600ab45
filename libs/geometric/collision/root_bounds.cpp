#include "collision/root_bounds.h"

#include "collision/vector_units.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace handway::geometric {
namespace {

constexpr float kRootRounding = 2e-5F;  // m: more than single precision can be off within 10 m

// With fewer pairs, to bound the distances of all takes less time than to look for the near ones.
constexpr std::size_t kMany = 600;

}  // namespace

RootBounds::RootBounds(const CollisionWorld& world, std::vector<BoundingSphere> spheres)
    : spheres_(std::move(spheres)), bodies_(world.moving()) {
  for (const BodyPair& pair : world.pairs()) {
    const CollisionBody& still = world.body(pair.b);
    const bool both_move = still.moves();
    moving_ += both_move ? 1 : 0;
    a_.push_back(static_cast<std::uint32_t>(pair.a));
    b_.push_back(static_cast<std::uint32_t>(pair.b));
    radii_.push_back(spheres_[static_cast<std::size_t>(pair.a)].radius +
                     (both_move ? spheres_[static_cast<std::size_t>(pair.b)].radius : 0.0F) +
                     kRootRounding);
    if (both_move) {
      continue;
    }
    const Aabb box = bounding_box(*still.mesh);
    const Pose X_BoxW = Eigen::Translation3d(-box.centre()) * still.X_FB.inverse();
    for (std::size_t row = 0; row < 3; ++row) {
      for (std::size_t column = 0; column < 4; ++column) {
        X_BoxW_[4 * row + column].push_back(static_cast<float>(
            X_BoxW.matrix()(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column))));
      }
      half_[row].push_back(static_cast<float>(0.5 * box.size()[static_cast<Eigen::Index>(row)]));
    }
  }
  if (a_.size() - moving_ > kMany) {
    still_.emplace(world);
  }
}

RootBounds::Placement RootBounds::placement() const {
  const std::vector<float> zeros(spheres_.size());
  return {zeros, zeros, zeros, std::vector<float>(a_.size()), {}};
}

void RootBounds::place(std::span<const Pose> X_WBody, Placement& placement) const {
  for (const int body : bodies_) {
    const auto i = static_cast<std::size_t>(body);
    const Eigen::Vector3d centre = X_WBody[i] * spheres_[i].centre.cast<double>();
    placement.x[i] = static_cast<float>(centre.x());
    placement.y[i] = static_cast<float>(centre.y());
    placement.z[i] = static_cast<float>(centre.z());
  }
}

void RootBounds::find_near(Placement& placement, double tolerance, std::vector<int>& pairs) const {
  bound_moving(placement, {0, moving_}, placement.bounds.data());
  pairs.clear();
  for (std::size_t i = 0; i < moving_; ++i) {
    if (placement.bounds[i] < tolerance) {
      pairs.push_back(static_cast<int>(i));
    }
  }
  find_near_still(placement, tolerance, pairs);
}

void RootBounds::find_near_still(Placement& placement, double tolerance,
                                 std::vector<int>& pairs) const {
  if (!still_) {
    bound_still(placement, {0, a_.size() - moving_}, placement.bounds.data() + moving_);
    for (std::size_t i = moving_; i < a_.size(); ++i) {
      if (placement.bounds[i] < tolerance) {
        pairs.push_back(static_cast<int>(i));
      }
    }
    return;
  }
  std::vector<int>& candidates = placement.candidates;
  candidates.clear();
  for (const int body : bodies_) {
    const auto i = static_cast<std::size_t>(body);
    const float reach = spheres_[i].radius + kRootRounding + static_cast<float>(tolerance);
    still_->append_near(body, {placement.x[i], placement.y[i], placement.z[i]}, reach, candidates);
  }
  std::ranges::sort(candidates);
  std::ranges::copy_if(candidates, std::back_inserter(pairs),
                       [&](int pair) { return bound(placement, pair) < tolerance; });
}

double RootBounds::bound(const Placement& placement, int pair) const {
  const auto i = static_cast<std::size_t>(pair);
  float result = 0.0F;
  if (i < moving_) {
    bound_moving(placement, {i, i + 1}, &result);
  } else {
    bound_still(placement, {i - moving_, i + 1 - moving_}, &result);
  }
  return result;
}

HANDWAY_VECTOR_UNITS void RootBounds::bound_moving(const Placement& at, Range pairs,
                                                   float* __restrict bounds) const {
  for (std::size_t i = pairs.first; i < pairs.end; ++i) {
    const float x = at.x[a_[i]] - at.x[b_[i]];
    const float y = at.y[a_[i]] - at.y[b_[i]];
    const float z = at.z[a_[i]] - at.z[b_[i]];
    bounds[i - pairs.first] = std::sqrt(x * x + y * y + z * z) - radii_[i];
  }
}

HANDWAY_VECTOR_UNITS void RootBounds::bound_still(const Placement& at, Range pairs,
                                                  float* __restrict bounds) const {
  for (std::size_t i = pairs.first; i < pairs.end; ++i) {
    const std::uint32_t body = a_[moving_ + i];
    const float x = at.x[body];
    const float y = at.y[body];
    const float z = at.z[body];
    float squared = 0.0F;
    for (std::size_t row = 0; row < 3; ++row) {
      const float along = X_BoxW_[4 * row][i] * x + X_BoxW_[4 * row + 1][i] * y +
                          X_BoxW_[4 * row + 2][i] * z + X_BoxW_[4 * row + 3][i];
      const float beyond = std::max(std::abs(along) - half_[row][i], 0.0F);
      squared += beyond * beyond;
    }
    bounds[i - pairs.first] = std::sqrt(squared) - radii_[moving_ + i];
  }
}

}  // namespace handway::geometric
