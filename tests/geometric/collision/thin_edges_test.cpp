/// Edges of every robot through and past things so thin that sampling steps over them.
#include "../robot/random_configurations.h"
#include "edge_judge.h"
#include "handway_test/scale.h"
#include "handway_test/solid_robots.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace handway::geometric {
namespace {

using test::EdgeJudge;
using test::RandomConfigurations;

constexpr double kPlannersResolution = 5e-5;  // m: what planners use
constexpr double kDense = 5e-5;               // m: farthest travel between the judge's samples
constexpr double kUsual = 5e-3;               // m: the same of a planner that samples
constexpr double kPlate = 1e-4;               // m, thickness
constexpr double kWire = 1e-4;                // m, radius
constexpr int kEdgesInScene = 6;

struct Edge {
  Configuration from;
  Configuration to;
};

class ThinEdges {
 public:
  ThinEdges(const RobotDescription& robot, std::uint64_t seed)
      : bare_scene_(test::scene_of(robot)),
        shared_bare_(std::make_shared<const CollisionWorld>(bare_scene_)),
        bare_(*shared_bare_),
        checker_(shared_bare_),
        motion_(bare_),
        random_(bare_.model(), seed) {}

  /// A scene with a thin thing in the way of, or next to, each of `edges`.
  Scene next(std::vector<Edge>& edges) {
    Scene scene = bare_scene_;
    for (int i = 0; i < kEdgesInScene; ++i) {
      edges.push_back(random_edge());
      add_thing(scene, edges.back(), i);
    }
    return scene;
  }

 private:
  // Returns an edge of 2 to 122 mm, measured at the point that moves the farthest; its ends are
  // free.
  Edge random_edge() {
    for (;;) {
      const Configuration from = random_.next();
      const Configuration way = random_.next() - from;
      const double length = 0.12 * std::pow(random_.uniform(0.0, 1.0), 2) + 0.002;
      const Configuration to =
          from + std::min(1.0, length / motion_.any_point(way.cwiseAbs())) * way;
      if (!checker_.first_collision(from) && !checker_.first_collision(to)) {
        return {from, to};
      }
    }
  }

  std::vector<Eigen::Vector3d> vertices_at(const CollisionBody& body, int index,
                                           const Configuration& q) const {
    std::vector<Pose> X_BL(static_cast<std::size_t>(bare_.model().link_count()));
    std::vector<Pose> X_WBody(bare_.bodies().size());
    bare_.place(q, X_BL, X_WBody);
    std::vector<Eigen::Vector3d> vertices;
    for (const Eigen::Vector3d& p_BV : body.mesh->vertices) {
      vertices.push_back(X_WBody[static_cast<std::size_t>(index)] * p_BV);
    }
    return vertices;
  }

  // Halfway between two samples of a usual count, where the body passes then.
  void add_thing(Scene& scene, const Edge& edge, int number) {
    const int index = static_cast<int>(random_.uniform(0.4, 1.0) *
                                       static_cast<double>(bare_.bodies().size() - 1));
    const CollisionBody& body = bare_.body(index);
    const int samples = 8 << static_cast<int>(random_.uniform(0, 4));
    const double t = (std::floor(random_.uniform(0.2, 0.8) * samples) + 0.5) / samples;
    const Configuration delta = edge.to - edge.from;
    const auto now = vertices_at(body, index, edge.from + t * delta);
    const auto then = vertices_at(body, index, edge.from + (t + 1e-6) * delta);
    const auto vertex =
        static_cast<std::size_t>(random_.uniform(0, 1) * static_cast<double>(now.size() - 1));
    const Eigen::Vector3d& p_WV = now[vertex];
    // x along the motion, y out of the body: touches are deep or hardly any.
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& p : now) {
      middle += p / static_cast<double>(now.size());
    }
    const Eigen::Vector3d x = (then[vertex] - p_WV).normalized();
    const Eigen::Vector3d y = (p_WV - middle - x.dot(p_WV - middle) * x).normalized();
    Pose X_WO = Pose::Identity();
    X_WO.linear() << x, y, x.cross(y);
    if (!X_WO.linear().allFinite() || std::abs(X_WO.linear().determinant() - 1.0) > 1e-6) {
      return;  // the body does not move, or along its own middle: nothing is in its way
    }
    const auto add = [&](const std::string& name, const Shape& shape, double outwards) {
      X_WO.translation() = p_WV + outwards * y;
      test::add_object(scene, name + std::to_string(number), shape, X_WO);
    };
    const double overlap = random_.uniform(-8e-4, 3e-4);
    switch (number % 3) {
      case 0:  // across the way
        add("plate ", Box{{kPlate, 0.02, 0.02}}, 0.01 - overlap);
        break;
      case 1:
        add("wire ", Cylinder{kWire, 0.06}, kWire - overlap);
        break;
      default: {  // two plates along the way, as far apart as the body is wide, or nearly
        double least = 0.0;
        double most = 0.0;
        for (const Eigen::Vector3d& p : now) {
          least = std::min(least, y.dot(p - p_WV));
          most = std::max(most, y.dot(p - p_WV));
        }
        const Box plate{{0.004, kPlate, 0.03}};
        add("left ", plate, most + 0.5 * (kPlate - overlap));
        add("right ", plate, least - 0.5 * (kPlate - overlap));
      }
    }
  }

  Scene bare_scene_;
  std::shared_ptr<const CollisionWorld> shared_bare_;
  const CollisionWorld& bare_;
  FclChecker checker_;
  MotionBound motion_;
  RandomConfigurations random_;
};

struct Tally {
  int free = 0;
  int refused = 0;
  int hidden = 0;  ///< Refused, though usual samples touch nothing.
};

void judge(EdgeJudge& judge, const Edge& edge, Tally& tally) {
  const EdgeResult result = judge.edges().check(edge.from, edge.to);
  if (result.free) {
    ++tally.free;
    ASSERT_FALSE(judge.collides(edge.from, edge.to, kDense))
        << "said to be free: " << edge.from.transpose() << " to " << edge.to.transpose();
    return;
  }
  ++tally.refused;
  tally.hidden += judge.collides(edge.from, edge.to, kUsual) ? 0 : 1;
  ASSERT_TRUE(result.pair.has_value());
  judge.exact().place(edge.from + result.at * (edge.to - edge.from));
  ASSERT_LE(judge.exact().pair_distance(*result.pair, 1.0), 1.5 * kPlannersResolution + 1e-9)
      << "refused for nothing: " << edge.from.transpose() << " to " << edge.to.transpose();
}

Tally judge_edges(const RobotDescription& robot, std::uint64_t seed, int count) {
  ThinEdges things(robot, seed);
  Tally tally;
  while (tally.free + tally.refused < count) {
    std::vector<Edge> edges;
    EdgeJudge among(things.next(edges), kPlannersResolution);
    for (const Edge& edge : edges) {
      if (!among.exact().first_collision(edge.from) && !among.exact().first_collision(edge.to)) {
        judge(among, edge, tally);
        if (testing::Test::HasFatalFailure()) {
          return tally;
        }
      }
    }
  }
  std::cout << tally.free + tally.refused << " edges: " << tally.free << " free, " << tally.refused
            << " refused, of these " << tally.hidden << " for what samples 5 mm apart miss\n";
  return tally;
}

class ThinThings : public testing::TestWithParam<std::pair<const char*, int>> {
 protected:
  static RobotDescription robot(const std::string& name) {
    return name == "HandArm"  ? test::solid_tx90_sah()
           : name == "Planar" ? test::planar_hand_arm()
                              : test::gantry(Box{{0.016, 0.016, 0.05}});
  }
};

TEST_P(ThinThings, AreNeverMissedNorRefusedForNothing) {
  const auto [name, edges] = GetParam();
  const int count = test::scaled(edges);
  const Tally tally = judge_edges(robot(name), 51, count);
  if (count >= edges) {  // fewer may be all of a kind
    EXPECT_GT(tally.free, 0);
    EXPECT_GT(tally.refused, 0);
    EXPECT_GT(tally.hidden, 0) << "nothing was thin enough to tell";
  }
}

INSTANTIATE_TEST_SUITE_P(Robots, ThinThings,
                         testing::Values(std::pair("HandArm", 60), std::pair("Planar", 200),
                                         std::pair("Gantry", 200)),
                         [](const auto& test) { return std::string(test.param.first); });

}  // namespace
}  // namespace handway::geometric
