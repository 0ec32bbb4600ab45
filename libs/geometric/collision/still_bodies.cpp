#include "collision/still_bodies.h"

#include <algorithm>

namespace handway::geometric {
namespace {

constexpr double kRounding = 2e-6;  // of the coordinates: more than single precision can be off
constexpr double kNear = 10.0;      // m: the same for all below

using FloatBox = Eigen::AlignedBox3f;

FloatBox box_from(const Eigen::Vector3d& p_WO, const CollisionBody& body) {
  FloatBox box;
  double farthest = kNear;
  for (const Eigen::Vector3d& vertex : body.mesh->vertices) {
    const Eigen::Vector3d p = body.X_FB * vertex - p_WO;
    farthest = std::max(farthest, p.lpNorm<Eigen::Infinity>());
    box.extend(p.cast<float>());
  }
  const auto rounding = static_cast<float>(kRounding * farthest);
  box.min().array() -= rounding;
  box.max().array() += rounding;
  return box;
}

// What Eigen's tree asks of a query.
struct NearBodies {
  const Eigen::Vector3f& centre;
  float squared;
  const std::vector<int>& pair_of;
  std::vector<int>& pairs;

  // NOLINTNEXTLINE(readability-identifier-naming)
  [[nodiscard]] bool intersectVolume(const FloatBox& box) const {
    return box.squaredExteriorDistance(centre) <= squared;
  }
  // NOLINTNEXTLINE(readability-identifier-naming)
  [[nodiscard]] bool intersectObject(int still) const {
    if (const int pair = pair_of[static_cast<std::size_t>(still)]; pair >= 0) {
      pairs.push_back(pair);
    }
    return false;  // go on
  }
};

}  // namespace

StillBodies::StillBodies(const CollisionWorld& world, const Eigen::Vector3d& p_WO) {
  std::vector<int> numbers(world.bodies().size(), -1);
  std::vector<int> still;
  std::vector<FloatBox> boxes;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (!world.bodies()[i].moves()) {
      numbers[i] = static_cast<int>(still.size());
      still.push_back(numbers[i]);
      boxes.push_back(box_from(p_WO, world.bodies()[i]));
    }
  }
  tree_.init(still.begin(), still.end(), boxes.begin(), boxes.end());
  pair_of_.resize(numbers.size());
  for (const int body : world.moving()) {
    pair_of_[static_cast<std::size_t>(body)].assign(still.size(), -1);
  }
  for (std::size_t p = 0; p < world.pairs().size(); ++p) {
    const BodyPair& pair = world.pairs()[p];
    if (const int number = numbers[static_cast<std::size_t>(pair.b)]; number >= 0) {
      pair_of_[static_cast<std::size_t>(pair.a)][static_cast<std::size_t>(number)] =
          static_cast<int>(p);
    }
  }
}

void StillBodies::append_near(int body, const Eigen::Vector3f& centre, float reach,
                              std::vector<int>& pairs) const {
  if (reach <= 0.0F) {
    return;
  }
  NearBodies near{centre, reach * reach, pair_of_[static_cast<std::size_t>(body)], pairs};
  Eigen::BVIntersect(tree_, near);
}

}  // namespace handway::geometric
