#include "scene_families.h"

#include "handway/geometric/formats/mesh_reader.h"
#include "handway/geometric/io/resources.h"
#include "handway/geometric/setup/placing.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

namespace handway::tools {
namespace {

using Eigen::Vector3d;
using geometric::Pose;
using geometric::SceneObject;
using sampling::RandomStream;

constexpr geometric::Color kWood{0.72F, 0.56F, 0.38F};
constexpr geometric::Color kMetal{0.45F, 0.47F, 0.5F};
constexpr geometric::Color kTarget{0.8F, 0.16F, 0.14F};
constexpr geometric::Color kOther{0.2F, 0.42F, 0.6F};
constexpr double kBoard = 0.02;  // m, thickness of boards and walls

double between(RandomStream& random, double lower, double upper) {
  return lower + (upper - lower) * random.uniform();
}

// Rounded to 0.1 mm, as a person would write it.
double rounded(double metres) { return std::round(metres * 1e4) / 1e4; }

Pose rounded_pose(const Pose& X) {
  const double yaw = std::atan2(X.linear()(1, 0), X.linear()(0, 0));
  const double degrees = std::round(yaw * 1800.0 / std::numbers::pi) / 10.0;
  const Vector3d p = X.translation().unaryExpr([](double value) { return rounded(value); });
  return Pose(Eigen::Translation3d(p) *
              Eigen::AngleAxisd(degrees * std::numbers::pi / 180.0, Vector3d::UnitZ()));
}

/// A shape that stands on its z = 0 once it is raised by `foot`.
struct Standing {
  geometric::Shape shape;
  double foot = 0.0;  ///< m
};

Standing standing_box(double x, double y, double z) {
  return {geometric::Box{{rounded(x), rounded(y), rounded(z)}}, 0.5 * rounded(z)};
}

Standing standing_cylinder(double radius, double height) {
  return {geometric::Cylinder{rounded(radius), rounded(height)}, 0.5 * rounded(height)};
}

Standing shipped(const std::string& name) {
  const auto file =
      geometric::find_resource(geometric::ResourceKind::kObject, name, geometric::resource_dir());
  return {geometric::Mesh{file, Vector3d::Ones(), geometric::read_mesh(file)}, 0.0};
}

// A thing that a hand can grasp.
Standing graspable(RandomStream& random) {
  switch (random.below(4)) {
    case 0:
      return shipped("can");
    case 1:
      return shipped("mug");
    case 2:
      return standing_cylinder(between(random, 0.025, 0.038), between(random, 0.10, 0.16));
    default:
      return standing_box(between(random, 0.045, 0.07), between(random, 0.045, 0.07),
                          between(random, 0.10, 0.16));
  }
}

/// Collects the objects of a scene, by places on the table in its frame F.
class SceneBuilder {
 public:
  SceneBuilder(const Pose& X_WF, RandomStream& random) : X_WF_(X_WF), random_(random) {
    const Standing top = standing_box(1.0, 1.6, 0.04);
    SceneObject table{
        "table", top.shape, Pose(Eigen::Translation3d(0.84, 0.0, kTableHeight - 0.02)), kWood, {}};
    surroundings_.objects.push_back(std::move(table));
    surroundings_.supports = {"table"};
  }

  /// Adds an object that stands at `foot`, turned about the vertical.
  void add(const std::string& name, const Standing& standing, const Vector3d& foot,
           const geometric::Color& color = kMetal, double yaw = 0.0) {
    const Pose X_FO(Eigen::Translation3d(foot + Vector3d(0.0, 0.0, standing.foot)) *
                    Eigen::AngleAxisd(yaw, Vector3d::UnitZ()));
    surroundings_.objects.push_back({name, standing.shape, rounded_pose(X_WF_ * X_FO), color, {}});
  }

  void add_box(const std::string& name, const Vector3d& size, const Vector3d& foot,
               const geometric::Color& color = kMetal) {
    add(name, standing_box(size.x(), size.y(), size.z()), foot, color);
  }

  /// Adds the object to grasp. @param height of what it stands on above the table, m.
  void add_target(double height = 0.0) {
    surroundings_.target = "target";
    add("target", graspable(random_), {0.0, 0.0, height + geometric::kRestingGap}, kTarget,
        between(random_, -std::numbers::pi, std::numbers::pi));
    // Rounding to 0.1 mm must not bring it into its support.
    surroundings_.objects.back().X_PO.translation().z() += geometric::kRestingGap;
  }

  /// Adds `count` things around the target, at distances from `nearest` to `farthest` (m).
  void add_things(int count, double nearest, double farthest) {
    for (int i = 1; i <= count; ++i) {
      const double angle = between(random_, -std::numbers::pi, std::numbers::pi);
      const double distance = between(random_, nearest, farthest);
      add(fmt::format("thing_{}", i), graspable(random_),
          {distance * std::cos(angle), distance * std::sin(angle), geometric::kRestingGap}, kOther,
          between(random_, -std::numbers::pi, std::numbers::pi));
    }
  }

  void add_support(const std::string& name) { surroundings_.supports.push_back(name); }
  [[nodiscard]] RandomStream& random() { return random_; }
  [[nodiscard]] Surroundings take() { return std::move(surroundings_); }

 private:
  Pose X_WF_;
  RandomStream& random_;
  Surroundings surroundings_;
};

/// A value for each level, from wide to narrow.
using ByLevel = std::array<double, 3>;

double at(const ByLevel& values, int level) { return values[static_cast<std::size_t>(level - 1)]; }

int count_at(int first, int step, int level) { return first + step * (level - 1); }

void build_table(SceneBuilder& scene, int level) {
  scene.add_target();
  scene.add_things(count_at(2, 2, level), at({0.16, 0.13, 0.11}, level), 0.3);
}

// A board above and below, walls at both sides and at the back.
void build_shelf(SceneBuilder& scene, int level) {
  const double half = at({0.36, 0.29, 0.23}, level);
  const double height = at({0.44, 0.38, 0.32}, level);
  const double depth = 0.3;
  scene.add_box("shelf_bottom", {depth, 2.0 * half, kBoard}, {0.05, 0.0, 0.0}, kWood);
  scene.add_box("shelf_top", {depth, 2.0 * half, kBoard}, {0.05, 0.0, kBoard + height}, kWood);
  scene.add_box("shelf_left", {depth, kBoard, height + 2.0 * kBoard},
                {0.05, half + 0.5 * kBoard, 0.0}, kWood);
  scene.add_box("shelf_right", {depth, kBoard, height + 2.0 * kBoard},
                {0.05, -half - 0.5 * kBoard, 0.0}, kWood);
  scene.add_box("shelf_back", {kBoard, 2.0 * half, height + 2.0 * kBoard}, {0.21, 0.0, 0.0}, kWood);
  scene.add_support("shelf_bottom");
  scene.add_target(kBoard);
}

// Four walls, open at the top.
void build_bin(SceneBuilder& scene, int level) {
  const double half = at({0.22, 0.18, 0.15}, level);
  const double height = at({0.06, 0.09, 0.12}, level);
  const double whole = 2.0 * (half + kBoard);
  for (const double side : {-1.0, 1.0}) {
    const char* end = side < 0.0 ? "near" : "far";
    scene.add_box(fmt::format("bin_{}", end), {kBoard, whole, height},
                  {side * (half + 0.5 * kBoard), 0.0, 0.0}, kWood);
    scene.add_box(fmt::format("bin_{}", side < 0.0 ? "right" : "left"),
                  {2.0 * half, kBoard, height}, {0.0, side * (half + 0.5 * kBoard), 0.0}, kWood);
  }
  scene.add_target();
}

// Four posts that carry a frame of beams.
void build_cage(SceneBuilder& scene, int level) {
  const double half = at({0.26, 0.22, 0.19}, level);
  const double height = at({0.42, 0.37, 0.33}, level);
  const double bar = 0.02;
  for (const double x : {-1.0, 1.0}) {
    for (const double y : {-1.0, 1.0}) {
      scene.add_box(
          fmt::format("post_{}{}", x < 0.0 ? "near" : "far", y < 0.0 ? "_right" : "_left"),
          {bar, bar, height}, {x * half, y * half, 0.0});
    }
    scene.add_box(x < 0.0 ? "beam_near" : "beam_far", {bar, 2.0 * half + bar, bar},
                  {x * half, 0.0, height});
    scene.add_box(x < 0.0 ? "beam_right" : "beam_left", {2.0 * half - bar, bar, bar},
                  {0.0, x * half, height});
  }
  scene.add_target();
}

// A wall with an opening between the robot and the target.
void build_window(SceneBuilder& scene, int level) {
  const double half = at({0.24, 0.2, 0.17}, level);
  const double sill = 0.03;
  const double height = at({0.44, 0.38, 0.33}, level);
  const double wall = 0.75;
  const double x = -0.16;
  const double side = 0.5;
  scene.add_box("wall_left", {kBoard, side, wall}, {x, half + 0.5 * side, 0.0});
  scene.add_box("wall_right", {kBoard, side, wall}, {x, -half - 0.5 * side, 0.0});
  scene.add_box("wall_below", {kBoard, 2.0 * half, sill}, {x, 0.0, 0.0});
  scene.add_box("wall_above", {kBoard, 2.0 * half, wall - sill - height}, {x, 0.0, sill + height});
  scene.add_target();
}

// A plate on two walls, open in front and behind.
void build_bridge(SceneBuilder& scene, int level) {
  const double half = at({0.36, 0.29, 0.24}, level);
  const double height = at({0.44, 0.38, 0.32}, level);
  const double depth = at({0.3, 0.36, 0.42}, level);
  scene.add_box("bridge_left", {depth, kBoard, height}, {0.0, half + 0.5 * kBoard, 0.0});
  scene.add_box("bridge_right", {depth, kBoard, height}, {0.0, -half - 0.5 * kBoard, 0.0});
  scene.add_box("bridge_plate", {depth, 2.0 * (half + kBoard), kBoard}, {0.0, 0.0, height});
  scene.add_target();
}

void build_pillars(SceneBuilder& scene, int level) {
  const int count = count_at(3, 2, level);
  const double turn = between(scene.random(), 0.0, 2.0 * std::numbers::pi);
  for (int i = 0; i < count; ++i) {
    const double angle = turn + 2.0 * std::numbers::pi * i / count;
    const double distance = at({0.2, 0.175, 0.155}, level) + between(scene.random(), 0.0, 0.08);
    scene.add(fmt::format("pillar_{}", i + 1),
              standing_cylinder(between(scene.random(), 0.015, 0.025),
                                between(scene.random(), 0.25, 0.5)),
              {distance * std::cos(angle), distance * std::sin(angle), 0.0});
  }
  scene.add_target();
}

// Bars across the space above the target.
void build_bars(SceneBuilder& scene, int level) {
  const int count = count_at(2, 1, level);
  for (int i = 0; i < count; ++i) {
    const double x = -0.24 + 0.5 * (i + between(scene.random(), 0.2, 0.8)) / count;
    const double height = between(scene.random(), at({0.34, 0.3, 0.27}, level), 0.5);
    scene.add_box(fmt::format("bar_{}", i + 1), {0.025, 0.9, 0.025}, {x, 0.0, height});
  }
  scene.add_target();
}

// The target stands on a step between higher ones.
void build_steps(SceneBuilder& scene, int level) {
  const double half = at({0.2, 0.16, 0.135}, level);
  const double higher = at({0.12, 0.18, 0.24}, level);
  const double step = 0.06;
  scene.add_box("step_middle", {0.3, 2.0 * half, step}, {0.0, 0.0, 0.0}, kWood);
  scene.add_box("step_left", {0.3, 0.16, higher}, {0.0, half + 0.08, 0.0}, kWood);
  scene.add_box("step_right", {0.3, 0.16, 0.5 * (step + higher)}, {0.0, -half - 0.08, 0.0}, kWood);
  scene.add_support("step_middle");
  scene.add_target(step);
}

void build_clutter(SceneBuilder& scene, int level) {
  scene.add_target();
  scene.add_things(count_at(6, 4, level), at({0.15, 0.125, 0.105}, level), 0.38);
}

/// A family with the function that builds its scenes.
struct Builder {
  SceneFamily family;
  void (*build)(SceneBuilder& scene, int level);
};

constexpr std::array<Builder, 10> kBuilders = {{
    {{"table", "a few objects on a table"}, build_table},
    {{"shelf", "in a shelf, between two boards and three walls"}, build_shelf},
    {{"bin", "in a box that is open at the top"}, build_bin},
    {{"cage", "between four posts that carry a frame"}, build_cage},
    {{"window", "behind a wall with an opening"}, build_window},
    {{"bridge", "under a plate on two walls"}, build_bridge},
    {{"pillars", "between upright cylinders"}, build_pillars},
    {{"bars", "below bars across the table"}, build_bars},
    {{"steps", "on a step between higher ones"}, build_steps},
    {{"clutter", "among many objects"}, build_clutter},
}};

std::array<SceneFamily, kBuilders.size()> families() {
  std::array<SceneFamily, kBuilders.size()> families{};
  std::ranges::transform(kBuilders, families.begin(), &Builder::family);
  return families;
}

}  // namespace

std::span<const SceneFamily> scene_families() {
  static const auto kFamilies = families();
  return kFamilies;
}

Surroundings draw_surroundings(std::size_t family, int level, const Pose& X_WF,
                               RandomStream& random) {
  SceneBuilder scene(X_WF, random);
  kBuilders.at(family).build(scene, level);
  return scene.take();
}

}  // namespace handway::tools
