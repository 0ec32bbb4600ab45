/// Measures point clouds as obstacles: the time to make a body of 10^6 points, and of a
/// configuration beside it, against FCL's octree of the same cells in the same run.
#include "handway/geometric/collision/checkers/exact_collision_checker.h"
#include "handway/geometric/formats/cloud_reader.h"
#include "handway_test/robots.h"
#include "handway_test/solid_robots.h"
#include "random_configurations.h"

#include <benchmark/benchmark.h>
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/octree/octree.h>
#include <fcl/narrowphase/collision.h>
#include <octomap/OcTree.h>

#include <array>
#include <cstdlib>
#include <memory>
#include <random>
#include <vector>

namespace handway::geometric {
namespace {

constexpr int kConfigurations = 256;

/// Points on a table, a wall and twelve boxes on the table, with 1 mm of noise.
class Room {
 public:
  explicit Room(int count) {
    const int tenth = count / 10;
    add(4 * tenth, {0.3, -0.8, 0.3}, {1.0, 0, 0}, {0, 1.6, 0});
    add(3 * tenth, {1.3, -0.8, 0.3}, {0, 0, 1.2}, {0, 1.6, 0});
    for (int box = 0; box < 12; ++box) {
      const Eigen::Vector3d p(0.45 + 0.7 * uniform_(engine_), -0.7 + 1.2 * uniform_(engine_), 0.3);
      const Eigen::Vector3d size(0.15 * uniform_(engine_) + 0.04, 0.15 * uniform_(engine_) + 0.04,
                                 0.2 * uniform_(engine_) + 0.04);
      const Eigen::Vector3d x = size.x() * Eigen::Vector3d::UnitX();
      const Eigen::Vector3d y = size.y() * Eigen::Vector3d::UnitY();
      const Eigen::Vector3d z = size.z() * Eigen::Vector3d::UnitZ();
      add(tenth / 12, p + z, x, y);
      add(tenth / 12, p, x, z);
      add(tenth / 12, p, y, z);
    }
  }
  [[nodiscard]] std::shared_ptr<const PointCloud> cloud() const {
    return std::make_shared<const PointCloud>(cloud_);
  }

 private:
  void add(int count, const Eigen::Vector3d& p, const Eigen::Vector3d& u,
           const Eigen::Vector3d& v) {
    for (int i = 0; i < count; ++i) {
      const Eigen::Vector3d noise(noise_(engine_), noise_(engine_), noise_(engine_));
      const double along = uniform_(engine_);
      cloud_.points.emplace_back((p + along * u + uniform_(engine_) * v + noise).cast<float>());
    }
  }

  std::mt19937_64 engine_{1};
  std::uniform_real_distribution<double> uniform_{0.0, 1.0};
  std::normal_distribution<double> noise_{0.0, 0.001};
  PointCloud cloud_;
};

constexpr CloudCells kCells{0.01, 0.0};

std::shared_ptr<const CollisionWorld> world_of(const std::shared_ptr<const PointCloud>& points) {
  Scene scene = test::scene_of(test::solid_tx90_sah());
  test::add_object(scene, "cloud", make_cloud(points, kCells, "points"), Eigen::Vector3d::Zero());
  return std::make_shared<const CollisionWorld>(scene);
}

// Half of each joint's range around its middle: near the table more often than not.
std::vector<Configuration> configurations_of(const RobotModel& model) {
  return test::random_configurations(model, kConfigurations, 0.25, 0.75);
}

/// The robot's links and FCL's octree of the cloud's cells. The links are not compared with each
/// other.
class OctreeChecker {
 public:
  OctreeChecker(const CollisionWorld& world, const PointCloud& cloud) : world_(world) {
    auto tree = std::make_shared<octomap::OcTree>(kCells.size);
    for (const Eigen::Vector3f& p : cloud.points) {
      tree->updateNode(octomap::point3d(p.x(), p.y(), p.z()), true, true);
    }
    tree->updateInnerOccupancy();
    const std::shared_ptr<const octomap::OcTree> known = tree;
    octree_ = std::make_shared<fcl::OcTree<double>>(known);
    for (const int body : world.moving()) {
      const TriangleMesh& mesh = *world.body(body).mesh;
      auto model = std::make_shared<fcl::BVHModel<fcl::OBBRSS<double>>>();
      model->beginModel();
      for (const auto& [i, j, k] : mesh.triangles) {
        model->addTriangle(mesh.vertices[i], mesh.vertices[j], mesh.vertices[k]);
      }
      model->endModel();
      links_.push_back(model);
    }
    X_BL_.resize(static_cast<std::size_t>(world.model().link_count()));
    X_WBody_.resize(world.bodies().size());
  }

  [[nodiscard]] bool collides(const Configuration& q) {
    world_.place(q, X_BL_, X_WBody_);
    const fcl::CollisionRequest<double> request;
    for (std::size_t i = 0; i < links_.size(); ++i) {
      const Pose& X = X_WBody_[static_cast<std::size_t>(world_.moving()[i])];
      fcl::CollisionResult<double> result;
      fcl::collide(links_[i].get(), X, octree_.get(), fcl::Transform3d::Identity(), request,
                   result);
      if (result.isCollision()) {
        return true;
      }
    }
    return false;
  }

 private:
  const CollisionWorld& world_;
  std::shared_ptr<fcl::OcTree<double>> octree_;
  std::vector<std::shared_ptr<fcl::BVHModel<fcl::OBBRSS<double>>>> links_;
  std::vector<Pose> X_BL_;
  std::vector<Pose> X_WBody_;
};

template <typename Collides>
void ask(benchmark::State& state, const std::vector<Configuration>& configurations,
         const Collides& collides) {
  int in_collision = 0;
  for (const Configuration& q : configurations) {  // fills what is remembered
    in_collision += collides(q) ? 1 : 0;
  }
  std::size_t k = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(collides(configurations[k++ % configurations.size()]));
  }
  state.counters["in_collision"] = in_collision / static_cast<double>(kConfigurations);
}

void bm_body(benchmark::State& state) {
  const std::shared_ptr<const PointCloud> cloud = Room(static_cast<int>(state.range(0))).cloud();
  std::size_t triangles = 0;
  for (auto _ : state) {
    triangles = make_cloud(cloud, kCells, "points").surface->triangles.size();
  }
  state.counters["triangles"] = static_cast<double>(triangles);
}

void bm_configuration(benchmark::State& state) {
  ExactCollisionChecker checker(world_of(Room(static_cast<int>(state.range(0))).cloud()));
  ask(state, configurations_of(checker.world().model()),
      [&](const Configuration& q) { return checker.first_collision(q).has_value(); });
}

void bm_configuration_octree(benchmark::State& state) {
  const std::shared_ptr<const PointCloud> cloud = Room(static_cast<int>(state.range(0))).cloud();
  const std::shared_ptr<const CollisionWorld> world = world_of(cloud);
  OctreeChecker checker(*world, *cloud);
  ask(state, configurations_of(world->model()),
      [&](const Configuration& q) { return checker.collides(q); });
}

BENCHMARK(bm_body)->Arg(100'000)->Arg(1'000'000)->Unit(benchmark::kMillisecond);
BENCHMARK(bm_configuration)->Arg(100'000)->Arg(1'000'000)->Unit(benchmark::kMicrosecond);
BENCHMARK(bm_configuration_octree)->Arg(1'000'000)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace handway::geometric
