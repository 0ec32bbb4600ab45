#include "collision/still_bodies.h"

namespace handway::geometric {
namespace {

constexpr float kRounding = 2e-5F;  // m: more than single precision can be off within 10 m

using FloatBox = Eigen::AlignedBox3f;

FloatBox box_in_world(const CollisionBody& body) {
  FloatBox box;
  for (const Eigen::Vector3d& vertex : body.mesh->vertices) {
    box.extend((body.X_FB * vertex).cast<float>());
  }
  box.min().array() -= kRounding;
  box.max().array() += kRounding;
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

StillBodies::StillBodies(const CollisionWorld& world) {
  std::vector<int> numbers(world.bodies().size(), -1);
  std::vector<int> still;
  std::vector<FloatBox> boxes;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (!world.bodies()[i].moves()) {
      numbers[i] = static_cast<int>(still.size());
      still.push_back(numbers[i]);
      boxes.push_back(box_in_world(world.bodies()[i]));
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
