/// The checkers against FCL's surfaces and an inside test of its own kind: generalized winding
/// numbers, summed over solid angles (Jacobson, Kavan, Sorkine-Hornung 2013), without trees or
/// rays.
#include "../robot/random_configurations.h"
#include "handway/geometric/collision/checkers/exact_collision_checker.h"
#include "handway/geometric/collision/checkers/fcl_checker.h"
#include "handway_test/scale.h"
#include "handway_test/solid_robots.h"

#include <Eigen/Geometry>
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/math/bv/OBBRSS.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace handway::geometric {
namespace {

using test::add_object;

/// A closed piece of a body, every triangle wound outwards or every one inwards.
struct Piece {
  explicit Piece(TriangleMesh surface, bool solid = true)
      : mesh(std::move(surface)), box(bounding_box(mesh)), is_solid(solid) {}

  TriangleMesh mesh;
  Aabb box;
  bool is_solid;
};

using Body = std::vector<Piece>;  // in its own frame

// van Oosterom, Strackee, "The solid angle of a plane triangle", 1983.
double winding_number(const TriangleMesh& mesh, const Eigen::Vector3d& p) {
  double sum = 0.0;
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector3d a = mesh.vertices[t[0]] - p;
    const Eigen::Vector3d b = mesh.vertices[t[1]] - p;
    const Eigen::Vector3d c = mesh.vertices[t[2]] - p;
    const double la = a.norm();
    const double lb = b.norm();
    const double lc = c.norm();
    sum += 2.0 * std::atan2(a.dot(b.cross(c)),
                            la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return sum / (4.0 * M_PI);
}

bool has_piece_inside(const Body& inner, const Body& outer, const Pose& X_OI) {
  for (const Piece& part : inner) {
    const Eigen::Vector3d p = X_OI * part.mesh.vertices.back();
    for (const Piece& piece : outer) {
      const bool in_box = (p.array() > piece.box.lower.array()).all() &&
                          (p.array() < piece.box.upper.array()).all();
      if (in_box && piece.is_solid && std::abs(winding_number(piece.mesh, p)) > 0.5) {
        return true;
      }
    }
  }
  return false;
}

TriangleMesh mesh_at(const Shape& shape, const Eigen::Vector3d& p, bool inside_out = false) {
  TriangleMesh mesh = transformed(*tessellate(shape), Pose(Eigen::Translation3d(p)));
  for (auto& triangle : mesh.triangles) {
    if (inside_out) {
      std::swap(triangle[0], triangle[1]);
    }
  }
  return mesh;
}

// A tube of a square profile around z: what is in the middle is not inside.
TriangleMesh tube(double inner, double outer, double length) {
  constexpr std::uint32_t kAround = 12;
  TriangleMesh mesh;
  const std::array<Eigen::Vector2d, 4> profile{
      Eigen::Vector2d(outer, -0.5 * length), Eigen::Vector2d(outer, 0.5 * length),
      Eigen::Vector2d(inner, 0.5 * length), Eigen::Vector2d(inner, -0.5 * length)};
  for (std::uint32_t i = 0; i < kAround; ++i) {
    const double angle = 2.0 * M_PI * i / kAround;
    for (const Eigen::Vector2d& corner : profile) {
      mesh.vertices.emplace_back(corner.x() * std::cos(angle), corner.x() * std::sin(angle),
                                 corner.y());
    }
    const std::uint32_t next = (i + 1) % kAround;
    for (std::uint32_t k = 0; k < 4; ++k) {
      const std::uint32_t l = (k + 1) % 4;
      mesh.triangles.push_back({4 * i + k, 4 * next + k, 4 * i + l});
      mesh.triangles.push_back({4 * next + k, 4 * next + l, 4 * i + l});
    }
  }
  return mesh;
}

Mesh whole(const Body& body) {
  TriangleMesh mesh;
  for (const Piece& piece : body) {
    append(mesh, piece.mesh);
  }
  return {"", Eigen::Vector3d::Ones(), std::make_shared<const TriangleMesh>(std::move(mesh))};
}

/// Options of a scene that change which pairs are checked, and how.
struct Options {
  std::string name;
  Padding bell = {};      ///< For the link "bell".
  Padding pin = {};       ///< For the link "pin".
  bool mirrored = false;  ///< Objects are mirrored, with their triangles turned inside out.
  bool carries = false;   ///< The pin carries a cup, which may touch the bell.
  bool allows = false;    ///< The bell may touch the block, the pin the vessel.
  bool upright = false;   ///< The bell stays within 1 rad of upright.
};

// The body `scale` times as large about the mean of its vertices.
Body scaled_body(const Body& body, double scale) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double count = 0.0;
  for (const Piece& piece : body) {
    for (const Eigen::Vector3d& p : piece.mesh.vertices) {
      sum += p;
      count += 1.0;
    }
  }
  const Eigen::Vector3d centre = sum / count;
  Body larger;
  for (const Piece& piece : body) {
    TriangleMesh mesh = piece.mesh;
    for (Eigen::Vector3d& p : mesh.vertices) {
      p = centre + scale * (p - centre);
    }
    larger.emplace_back(std::move(mesh), piece.is_solid);
  }
  return larger;
}

/// Two links that fly about freely, and things of all kinds around them.
class Flight {
 public:
  explicit Flight(Options options) : options_(std::move(options)) {
    robot_.name = "flight";
    robot_.links.push_back({"frame", {}, {}});
    add_link("bell", {Piece(tube(0.05, 0.06, 0.16)), Piece(mesh_at(Sphere{0.02}, {0.2, 0, 0}))});
    add_link("pin", {Piece(mesh_at(Box{{0.02, 0.02, 0.06}}, {0, 0, 0}))});
    scene_ = test::scene_of(robot_);
    add("block", {Piece(mesh_at(Box{{0.5, 0.4, 0.3}}, {0, 0, 0}))}, {0.5, 0.2, 0.1});
    add("turned", {Piece(mesh_at(Cylinder{0.25, 0.5}, {0, 0, 0}, true))}, {-0.5, 0.1, 0.2});
    add("nested",
        {Piece(mesh_at(Sphere{0.3}, {0, 0, 0})), Piece(mesh_at(Sphere{0.1}, {0, 0, 0}, true)),
         Piece(mesh_at(Box{{0.1, 0.1, 0.1}}, {0.5, 0, 0}))},
        {-0.1, -0.5, -0.3});
    add("room", {Piece(mesh_at(Box{{3, 3, 3}}, {0, 0, 0}), false)}, {0, 0, 0});
    scene_.objects.back().solid = false;
    add("vessel", {Piece(tube(0.15, 0.3, 0.4))}, {0.1, 0.5, -0.4});
    add("seed", {Piece(mesh_at(Sphere{0.008}, {0, 0, 0}))}, {0.1, 0.1, -0.4});
    apply_options();
    world_ = std::make_shared<const CollisionWorld>(scene_);
    for (const CollisionBody& body : world_->bodies()) {
      auto tree = std::make_shared<Tree>();
      tree->beginModel();
      for (const auto& t : body.mesh->triangles) {
        tree->addTriangle(body.mesh->vertices[t[0]], body.mesh->vertices[t[1]],
                          body.mesh->vertices[t[2]]);
      }
      tree->endModel();
      trees_.push_back(tree);
    }
  }

  [[nodiscard]] const std::shared_ptr<const CollisionWorld>& world() const { return world_; }

  void place(const Configuration& q) {
    X_BL_.resize(static_cast<std::size_t>(world_->model().link_count()));
    X_WBody_.resize(world_->bodies().size());
    world_->place(q, X_BL_, X_WBody_);
  }

  [[nodiscard]] bool surfaces_cross(const BodyPair& pair) const {
    const fcl::CollisionRequestd request;
    fcl::CollisionResultd result;
    return fcl::collide(trees_[index(pair.a)].get(), X_WBody_[index(pair.a)],
                        trees_[index(pair.b)].get(), X_WBody_[index(pair.b)], request, result) > 0;
  }

  [[nodiscard]] bool one_is_inside(const BodyPair& pair) const {
    const Pose X_AB = X_WBody_[index(pair.a)].inverse() * X_WBody_[index(pair.b)];
    const Body a = body(pair.a);
    const Body b = body(pair.b);
    return has_piece_inside(b, a, X_AB) || has_piece_inside(a, b, X_AB.inverse());
  }

  // Nearer than the paddings of both, where one of the two stands still.
  [[nodiscard]] bool is_within_padding(const BodyPair& pair) const {
    const std::string& a = world_->body(pair.a).name;
    const double padding = a == "bell" ? options_.bell.distance : options_.pin.distance;
    if (padding == 0.0 || world_->body(pair.b).moves()) {
      return false;
    }
    const fcl::DistanceRequestd request;
    fcl::DistanceResultd result;
    fcl::distance(trees_[index(pair.a)].get(), X_WBody_[index(pair.a)], trees_[index(pair.b)].get(),
                  X_WBody_[index(pair.b)], request, result);
    return result.min_distance < padding;
  }

  [[nodiscard]] bool violates_constraint() const {
    const int bell = world_->model().find_link("bell").value();
    return options_.upright &&
           std::acos(std::clamp(X_BL_[index(bell)].linear()(2, 2), -1.0, 1.0)) > 1.0;
  }

  // Pairs of names that must not touch, by the rules of the scene format.
  [[nodiscard]] std::set<std::pair<std::string, std::string>> expected_pairs() const {
    std::set<std::pair<std::string, std::string>> pairs;
    for (const SceneObject& object : scene_.objects) {
      for (const std::string link : {"bell", "pin"}) {
        if (!object.attachment) {
          pairs.insert(std::minmax(object.name, link));
        }
      }
      if (options_.carries && !object.attachment) {
        pairs.insert(std::minmax(object.name, std::string("cup")));
      }
    }
    pairs.insert({"bell", "pin"});
    if (options_.allows) {
      pairs.erase({"bell", "block"});
      pairs.erase({"pin", "vessel"});
    }
    return pairs;
  }

 private:
  using Tree = fcl::BVHModel<fcl::OBBRSSd>;

  void apply_options() {
    auto& padding = scene_.robots.front().padding;
    if (options_.bell != Padding()) {
      padding["bell"] = options_.bell;
    }
    if (options_.pin != Padding()) {
      padding["pin"] = options_.pin;
    }
    if (options_.carries) {
      add("cup", {Piece(tube(0.02, 0.03, 0.05))}, {0.0, 0.0, 0.08});
      scene_.objects.back().attachment = Attachment{scene_.robots.front().name, "pin", {"bell"}};
    }
    if (options_.allows) {
      scene_.allowed_collisions[{"bell", "block"}] = true;
      scene_.allowed_collisions[{"pin", "vessel"}] = true;
    }
    if (options_.upright) {
      OrientationConstraint upright;
      upright.angle = 1.0;
      scene_.constraints.push_back({"upright", "bell", upright});
    }
  }

  [[nodiscard]] Body body(int number) const {
    const CollisionBody& one = world_->body(number);
    const Body& named = bodies_.at(one.name);
    return one.is_scaled_copy
               ? scaled_body(named, one.name == "bell" ? options_.bell.scale : options_.pin.scale)
               : named;
  }

  static std::size_t index(int body) { return static_cast<std::size_t>(body); }

  // Adds a link on three slides and three hinges of its own.
  void add_link(const std::string& name, const Body& body) {
    std::string parent = "frame";
    for (int i = 0; i < 6; ++i) {
      Joint joint;
      joint.type = i < 3 ? JointType::kPrismatic : JointType::kRevolute;
      joint.name = name + std::to_string(i);
      joint.parent = parent;
      joint.child = i < 5 ? joint.name : name;
      joint.axis = Eigen::Vector3d::Unit(i % 3);
      joint.limits.lower = i < 3 ? -0.7 : -3.1;
      joint.limits.upper = -joint.limits.lower;
      robot_.links.push_back({joint.child, {}, {}});
      robot_.joints.push_back(joint);
      parent = joint.child;
    }
    robot_.links.back().collision.push_back({whole(body), Pose::Identity(), {}});
    bodies_[name] = body;
  }

  void add(const std::string& name, Body body, const Eigen::Vector3d& p_WO) {
    if (options_.mirrored) {
      for (Piece& piece : body) {
        piece = Piece(transformed(piece.mesh, Pose::Identity(), {-1.0, 1.0, 1.0}), piece.is_solid);
      }
    }
    add_object(scene_, name, whole(body), p_WO);
    bodies_[name] = body;
  }

  Options options_;
  RobotDescription robot_;
  Scene scene_;
  std::map<std::string, Body> bodies_;
  std::shared_ptr<const CollisionWorld> world_;
  std::vector<std::shared_ptr<Tree>> trees_;
  std::vector<Pose> X_BL_;
  std::vector<Pose> X_WBody_;
};

class WindingNumber : public testing::TestWithParam<Options> {};

TEST_P(WindingNumber, FindsTheSameAsTheCheckers) {
  Flight flight(GetParam());
  const CollisionWorld& world = *flight.world();
  std::set<std::pair<std::string, std::string>> pairs;
  for (const auto& [a, b] : world.pairs()) {
    pairs.insert(std::minmax(world.body(a).name, world.body(b).name));
  }
  ASSERT_EQ(pairs, flight.expected_pairs());
  ExactCollisionChecker fast(flight.world());
  FclChecker reference(flight.world());
  test::RandomConfigurations random(world.model(), 5);
  const int count = test::scaled(1000);
  int crossing = 0;
  int inside = 0;
  int near = 0;
  int colliding = 0;
  for (int i = 0; i < count; ++i) {
    const Configuration q = random.next();
    flight.place(q);
    reference.place(q);
    fast.place(q);
    bool any = flight.violates_constraint();
    for (std::size_t p = 0; p < world.pairs().size(); ++p) {
      const BodyPair& pair = world.pairs()[p];
      const int index = static_cast<int>(p);
      const bool crosses = flight.surfaces_cross(pair);
      const bool contained = !crosses && flight.one_is_inside(pair);
      const bool too_near = !crosses && !contained && flight.is_within_padding(pair);
      const bool collides = crosses || contained || too_near;
      crossing += crosses ? 1 : 0;
      inside += contained ? 1 : 0;
      near += too_near ? 1 : 0;
      any = any || collides;
      ASSERT_EQ(reference.pair_collides(index), collides)
          << world.body(pair.a).name << " with " << world.body(pair.b).name << " at "
          << q.transpose();
      ASSERT_EQ(fast.pair_collides(index), collides)
          << world.body(pair.a).name << " with " << world.body(pair.b).name << " at "
          << q.transpose();
    }
    ASSERT_EQ(fast.first_collision(q).has_value(), any) << q.transpose();
    colliding += any ? 1 : 0;
  }
  std::cout << count << " configurations compared, " << colliding
            << " in collision; pairs: " << crossing << " crossing, " << inside
            << " one inside of the other, " << near << " within their padding alone\n";
  EXPECT_GT(inside, count / 50);
  EXPECT_LT(colliding, count);
  const bool is_padded = GetParam().bell.distance + GetParam().pin.distance > 0.0;
  EXPECT_EQ(near > count / 100, is_padded);
}

INSTANTIATE_TEST_SUITE_P(
    Options, WindingNumber,
    testing::Values(Options{.name = "Plain"}, Options{.name = "Mirrored", .mirrored = true},
                    Options{.name = "Padded", .bell = {1.0, 0.03}, .pin = {1.0, 0.02}},
                    Options{.name = "Scaled", .bell = {1.3, 0.0}, .pin = {0.8, 0.0}},
                    Options{.name = "PaddedAndScaled", .bell = {1.2, 0.02}, .mirrored = true},
                    Options{.name = "Carrying", .carries = true},
                    Options{.name = "CarryingPadded", .pin = {1.0, 0.02}, .carries = true},
                    Options{.name = "Allowing", .allows = true},
                    Options{.name = "Upright", .upright = true},
                    Options{.name = "All",
                            .bell = {1.1, 0.01},
                            .pin = {1.2, 0.02},
                            .mirrored = true,
                            .carries = true,
                            .allows = true,
                            .upright = true}),
    [](const auto& one) { return one.param.name; });

}  // namespace
}  // namespace handway::geometric
