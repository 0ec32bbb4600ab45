#include "view3d/overlay.h"

#include "handway/planning/edits/scene_edits.h"
#include "model/settings/options.h"
#include "view3d/coin_conversions.h"
#include "view3d/robot_node.h"
#include "view3d/unlit_nodes.h"

#include <Inventor/nodes/SoAnnotation.h>
#include <Inventor/nodes/SoComplexity.h>
#include <Inventor/nodes/SoDepthBuffer.h>
#include <Inventor/nodes/SoLineSet.h>
#include <Inventor/nodes/SoMaterial.h>
#include <Inventor/nodes/SoMatrixTransform.h>
#include <Inventor/nodes/SoNode.h>
#include <Inventor/nodes/SoSeparator.h>
#include <Inventor/nodes/SoSphere.h>
#include <Inventor/nodes/SoTranslation.h>
#include <Inventor/nodes/SoVertexProperty.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

namespace handway::gui {
Drawing::Drawing(SoNode* node) : node_(node) {
  if (node_) {
    node_->ref();
  }
}

Drawing::~Drawing() {
  if (node_) {
    node_->unref();
  }
}

namespace {

using Edges = std::vector<std::pair<int, int>>;

constexpr geometric::Color kKeptColor{0.05F, 0.55F, 0.62F, 1.0F};
constexpr geometric::Color kViolatedColor{0.86F, 0.16F, 0.14F, 1.0F};
constexpr geometric::Color kReachedColor{0.13F, 0.60F, 0.28F, 1.0F};
constexpr float kVeil = 0.14F;  // opacity of a face
constexpr float kEdgeWidth = 1.5F;
constexpr float kAxisWidth = 3.0F;
constexpr float kDotSize = 9.0F;

constexpr double kSlant = 0.25;  // m, of a cone, and the length of the axis in it
constexpr int kRim = 48;         // corners of its rim

void add_veil(SoSeparator& parent, const geometric::Shape& shape, const geometric::Pose& X_WS,
              geometric::Color color) {
  auto* veil = new SoSeparator;
  auto* place = new SoMatrixTransform;
  place->matrix = to_coin(X_WS);
  veil->addChild(place);
  color.alpha = kVeil;
  veil->addChild(make_material(color).get());
  veil->addChild(make_shape_node(shape).get());
  parent.addChild(veil);
}

// Adds a cone about `direction` (of length 1), open at its end. @param angle less than a right one.
// @param slant m, from the apex to the rim.
void add_open_cone(SoSeparator& parent, const Eigen::Vector3d& apex,
                   const Eigen::Vector3d& direction, double angle, double slant,
                   const geometric::Color& color) {
  const geometric::Cone cone{slant * std::sin(angle), slant * std::cos(angle)};
  const Eigen::Quaterniond turn =
      Eigen::Quaterniond::FromTwoVectors(-Eigen::Vector3d::UnitZ(), direction);
  const geometric::Pose X_WC = Eigen::Translation3d(apex + 0.5 * cone.length * direction) * turn;
  add_veil(parent, cone, X_WC, color);
  std::vector<Eigen::Vector3d> rim;
  Edges edges;
  for (int i = 0; i < kRim; ++i) {
    const double at = 2.0 * std::numbers::pi * i / kRim;
    rim.emplace_back(X_WC * Eigen::Vector3d(cone.radius * std::cos(at), cone.radius * std::sin(at),
                                            -0.5 * cone.length));
    edges.emplace_back(i, (i + 1) % kRim);
  }
  parent.addChild(make_edges_node(rim, edges, color, kEdgeWidth));
}

// Adds a cone with its apex at the body's origin. A constraint that allows more than a right angle
// has no cone.
void add_cone(SoSeparator& parent, const geometric::OrientationConstraint& upright,
              const geometric::Pose& X_WB) {
  const Eigen::Vector3d direction = upright.direction.normalized();
  const Eigen::Vector3d axis = X_WB.linear() * upright.axis.normalized();
  const double angle = std::atan2(axis.cross(direction).norm(), axis.dot(direction));
  const geometric::Color color = angle <= upright.angle ? kKeptColor : kViolatedColor;
  const std::array<Eigen::Vector3d, 2> ends{X_WB.translation(),
                                            X_WB.translation() + 1.15 * kSlant * axis};
  parent.addChild(make_edges_node(ends, Edges{{0, 1}}, color, kAxisWidth));
  if (upright.angle >= 0.5 * std::numbers::pi) {
    return;
  }
  add_open_cone(parent, X_WB.translation(), direction, upright.angle, kSlant, color);
}

// Edges of boxes, whose corners are numbered by their bits: 1 for x, 2 for y, 4 for z.
constexpr std::array<std::pair<int, int>, 12> kBoxEdges{{{0, 1},
                                                         {2, 3},
                                                         {4, 5},
                                                         {6, 7},
                                                         {0, 2},
                                                         {1, 3},
                                                         {4, 6},
                                                         {5, 7},
                                                         {0, 4},
                                                         {1, 5},
                                                         {2, 6},
                                                         {3, 7}}};

std::array<Eigen::Vector3d, 8> box_corners(const geometric::Pose& X_WB,
                                           const Eigen::Vector3d& half_size) {
  std::array<Eigen::Vector3d, 8> corners;
  for (std::size_t corner = 0; corner < corners.size(); ++corner) {
    const auto side = [corner](std::size_t bit) { return (corner & bit) != 0 ? 1.0 : -1.0; };
    corners[corner] = X_WB * half_size.cwiseProduct(Eigen::Vector3d(side(1), side(2), side(4)));
  }
  return corners;
}

SoSeparator* make_dot(const Eigen::Vector3d& point, const geometric::Color& color) {
  return make_dots_node(std::array{point}, {color}, kDotSize);
}

void add_box(SoSeparator& parent, const geometric::PositionConstraint& region,
             const geometric::Pose& X_WB) {
  const Eigen::Vector3d p_W = X_WB * region.point;
  const bool is_kept =
      ((region.X_WR.inverse() * p_W).cwiseAbs().array() <= 0.5 * region.size.array()).all();
  const geometric::Color color = is_kept ? kKeptColor : kViolatedColor;
  add_veil(parent, geometric::Box{region.size}, region.X_WR, color);
  parent.addChild(
      make_edges_node(box_corners(region.X_WR, 0.5 * region.size), kBoxEdges, color, kEdgeWidth));
  parent.addChild(make_dot(p_W, color));
}

}  // namespace

namespace {

const geometric::Color& color_of(PoseReached reached) {
  switch (reached) {
    case PoseReached::kYes:
      return kReachedColor;
    case PoseReached::kNo:
      return kViolatedColor;
    default:
      return kGoalColor;
  }
}

// Red, green and blue for x, y and z.
void add_frame(SoSeparator& parent, const geometric::Pose& X_WF, double length) {
  constexpr std::array kColors{geometric::Color{0.82F, 0.18F, 0.16F, 1.0F},
                               geometric::Color{0.20F, 0.62F, 0.20F, 1.0F},
                               geometric::Color{0.16F, 0.36F, 0.82F, 1.0F}};
  for (int axis = 0; axis < 3; ++axis) {
    const std::array<Eigen::Vector3d, 2> ends{
        X_WF.translation(), X_WF * Eigen::Vector3d(length * Eigen::Vector3d::Unit(axis))};
    parent.addChild(make_edges_node(ends, Edges{{0, 1}}, kColors.at(static_cast<std::size_t>(axis)),
                                    kAxisWidth));
  }
}

}  // namespace

Drawing make_goal_poses_node(const geometric::Scene& scene, std::span<const PoseReached> reached) {
  constexpr double kAxis = 0.1;      // m
  constexpr double kVisible = 2e-3;  // m, of tolerances
  auto separator = make_coin<SoSeparator>();
  for (std::size_t i = 0; i < scene.goal_poses.size(); ++i) {
    const geometric::PoseGoal& goal = scene.goal_poses[i];
    const geometric::Color& color =
        color_of(i < reached.size() ? reached[i] : PoseReached::kUnknown);
    add_frame(*separator.get(), goal.X_WG, kAxis);
    if (goal.position_tolerance.maxCoeff() >= kVisible) {
      add_veil(*separator.get(), geometric::Box{2.0 * goal.position_tolerance.cwiseMax(1e-4)},
               goal.X_WG, color);
    }
    separator->addChild(make_dot(goal.X_WG.translation(), color));
  }
  return separator;
}

Drawing make_reach_node(const Eigen::Vector3d& target, const Eigen::Vector3d& tool, bool reached) {
  auto separator = make_coin<SoSeparator>();
  const geometric::Color& color = color_of(reached ? PoseReached::kYes : PoseReached::kNo);
  if (!reached) {
    separator->addChild(
        make_edges_node(std::array{target, tool}, Edges{{0, 1}}, color, kAxisWidth));
  }
  separator->addChild(make_dot(target, color));
  return separator;
}

Drawing make_constraints_node(const geometric::Scene& scene, const geometric::Configuration& q) {
  auto separator = make_coin<SoSeparator>();
  for (const geometric::PathConstraint& constraint : scene.constraints) {
    const std::optional<geometric::Pose> X_WB = planning::body_pose(scene, q, constraint.body);
    if (!X_WB) {
      continue;
    }
    if (const auto* upright = std::get_if<geometric::OrientationConstraint>(&constraint.what)) {
      add_cone(*separator.get(), *upright, *X_WB);
    } else {
      add_box(*separator.get(), std::get<geometric::PositionConstraint>(constraint.what), *X_WB);
    }
  }
  return separator;
}

namespace {

geometric::Color mixed(const geometric::Color& a, const geometric::Color& b, float share) {
  return {a.red + share * (b.red - a.red), a.green + share * (b.green - a.green),
          a.blue + share * (b.blue - a.blue), 1.0F};
}

}  // namespace

geometric::Color color_along(std::size_t i, std::size_t count) {
  return mixed(kStartColor, kGoalColor,
               count > 1 ? static_cast<float>(i) / static_cast<float>(count - 1) : 0.0F);
}

namespace {

constexpr float kBeadRadius = 0.005F;  // m
constexpr geometric::Color kMeasureColor{0.52F, 0.20F, 0.80F, 1.0F};
constexpr geometric::Color kExecutedColor{0.80F, 0.12F, 0.46F, 1.0F};
constexpr geometric::Color kWeakestColor{0.90F, 0.42F, 0.05F, 1.0F};
constexpr geometric::Color kContactColor{0.93F, 0.05F, 0.60F, 1.0F};

// In the colours from start to goal.
SoSeparator* make_line(std::span<const Eigen::Vector3d> points, float width) {
  std::vector<geometric::Color> colors;
  for (std::size_t i = 0; i < points.size(); ++i) {
    colors.push_back(color_along(i, points.size()));
  }
  return make_line_node(points, colors, width);
}

// Adds a line that ends in an arrow's tip.
void add_arrow(SoSeparator& parent, const std::vector<Eigen::Vector3d>& points,
               const geometric::Color& color) {
  constexpr double kTip = 0.014;  // m
  const Eigen::Vector3d& end = points.back();
  const Eigen::Vector3d along = (end - points[points.size() - 2]).normalized();
  const geometric::Cone tip{0.35 * kTip, kTip};
  auto* separator = new SoSeparator;
  auto* place = new SoMatrixTransform;
  place->matrix =
      to_coin(geometric::Pose(Eigen::Translation3d(end) *
                              Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), along)));
  separator->addChild(place);
  separator->addChild(make_material(color).get());
  separator->addChild(make_shape_node(tip).get());
  parent.addChild(make_line_node(points, {color}, kAxisWidth));
  parent.addChild(separator);
}

// Points on most of a circle about an axis of length 1.
std::vector<Eigen::Vector3d> arc_about(const Eigen::Vector3d& centre, const Eigen::Vector3d& axis,
                                       double radius) {
  constexpr int kSteps = 40;
  const Eigen::Vector3d u = planning::tangent(axis);
  const Eigen::Vector3d v = axis.cross(u);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i <= kSteps; ++i) {
    const double at = 1.5 * std::numbers::pi * i / kSteps;
    points.emplace_back(centre + radius * (std::cos(at) * u + std::sin(at) * v));
  }
  return points;
}

// For what is seen through the robot, which would hide most of it.
CoinRef<SoSeparator> make_seen_through() {
  auto separator = make_coin<SoSeparator>();
  auto* through = new SoDepthBuffer;
  through->test = FALSE;
  separator->addChild(through);
  return separator;
}

// Makes a line of one colour that is visible through everything.
CoinRef<SoSeparator> make_plain_line(std::span<const Eigen::Vector3d> points,
                                     const geometric::Color& rgb, float width) {
  auto separator = make_seen_through();
  separator->addChild(make_line_node(points, {rgb}, width));
  return separator;
}

SoSeparator* make_bead(const Eigen::Vector3d& place, const geometric::Color& color) {
  auto* separator = new SoSeparator;
  auto* translation = new SoTranslation;
  translation->translation = to_coin(place);
  separator->addChild(translation);
  separator->addChild(make_material(color).get());
  separator->addChild(new SoComplexity);
  auto* ball = new SoSphere;
  ball->radius = kBeadRadius;
  separator->addChild(ball);
  return separator;
}

}  // namespace

Drawing make_trail_node(std::span<const Eigen::Vector3d> points) {
  return CoinRef<SoSeparator>(make_line(points, 1.5F));
}

Drawing make_executed_node(std::span<const Eigen::Vector3d> points) {
  return make_plain_line(points, kExecutedColor, 2.0F);
}

Drawing make_optimized_node(std::span<const Eigen::Vector3d> points,
                            std::span<const Eigen::Vector3d> waypoints) {
  CoinRef<SoSeparator> separator = make_plain_line(points, kOptimizedColor, 4.0F);
  for (const Eigen::Vector3d& waypoint : waypoints) {
    separator->addChild(make_bead(waypoint, kOptimizedColor));
  }
  return separator;
}

Drawing make_measure_node(std::span<const Eigen::Vector3d> points) {
  CoinRef<SoSeparator> separator = make_plain_line(points, kMeasureColor, 2.0F);
  separator->addChild(make_dots_node(points, {kMeasureColor}, kDotSize));
  return separator;
}

Drawing make_path_node(std::span<const Eigen::Vector3d> points,
                       std::span<const Eigen::Vector3d> waypoints) {
  auto separator = make_seen_through();
  separator->addChild(make_line(points, 3.0F));
  for (std::size_t i = 0; i < waypoints.size(); ++i) {
    separator->addChild(make_bead(waypoints[i], color_along(i, waypoints.size())));
  }
  return separator;
}

Drawing make_contacts_node(std::span<const Eigen::Vector3d> points) {
  auto separator = make_seen_through();
  for (const Eigen::Vector3d& point : points) {
    separator->addChild(make_bead(point, kContactColor));
  }
  return separator;
}

Drawing make_grasp_node(const geometric::Pose& X_WO, const Eigen::Vector3d& p_O,
                        const planning::Pregrasp& grasp, double friction) {
  constexpr double kConeSlant = 0.025;  // m
  constexpr double kLength = 0.12;      // m, of the arrow of a force without torque
  constexpr double kLeast = 0.1;        // share of the wrench that is worth an arrow
  CoinRef<SoSeparator> separator = make_seen_through();
  for (const planning::HandContact& touch : grasp.contacts) {
    const Eigen::Vector3d p_W = X_WO * touch.contact.p_O;
    separator->addChild(make_dot(p_W, kContactColor));
    add_open_cone(*separator.get(), p_W, -(X_WO.linear() * touch.contact.normal_O),
                  std::atan(friction), kConeSlant, kContactColor);
  }
  const Eigen::Vector3d centre = X_WO * p_O;
  const Eigen::Vector3d force = X_WO.linear() * grasp.quality.weakest.head<3>();
  const Eigen::Vector3d torque = X_WO.linear() * grasp.quality.weakest.tail<3>();
  if (force.norm() > kLeast) {
    add_arrow(*separator.get(), {centre, centre + kLength * force}, kWeakestColor);
  }
  if (torque.norm() > kLeast) {
    add_arrow(*separator.get(),
              arc_about(centre, torque.normalized(), 0.5 * kLength * torque.norm()), kWeakestColor);
  }
  return separator;
}

Drawing make_clearance_node(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  constexpr double kFar = 0.03;  // m, from which on all is green
  const auto t = static_cast<float>(std::min(1.0, (a - b).norm() / kFar));
  const geometric::Color color{std::min(0.90F, 1.8F * (1.0F - t)), std::min(0.68F, 1.36F * t),
                               0.12F, 1.0F};
  const std::array ends{a, b};
  CoinRef<SoSeparator> separator = make_plain_line(ends, color, 2.5F);
  separator->addChild(make_dots_node(ends, {color}, 7.0F));
  return separator;
}

namespace {

const geometric::Color kVolumeColor{0.36F, 0.44F, 0.78F, Ghost::kFaint};

}  // namespace

Drawing make_trails_node(std::span<const std::vector<Eigen::Vector3d>> trails) {
  auto all = make_coin<SoSeparator>();
  for (const std::vector<Eigen::Vector3d>& trail : trails) {
    all->addChild(make_trail_node(trail).node());
  }
  return all;
}

Drawing make_copies_node(const geometric::RobotInstance& robot,
                         std::span<const geometric::Configuration> postures) {
  const LinkShapes shapes = make_link_shapes(*robot.model);
  auto all = make_coin<SoSeparator>();
  for (std::size_t i = 0; i < postures.size(); ++i) {
    geometric::Color color = color_along(i, postures.size());
    color.alpha = Ghost::kFaint;
    RobotNode copy(robot.model, shapes, color);
    copy.place(robot.X_WB, postures[i]);
    all->addChild(copy.root());
  }
  return all;
}

Drawing make_volume_node(std::shared_ptr<const geometric::TriangleMesh> mesh) {
  auto all = make_coin<SoSeparator>();
  all->addChild(make_material(kVolumeColor).get());
  all->addChild(make_shape_node(geometric::Mesh{.file = {}, .triangles = std::move(mesh)}).get());
  return all;
}

namespace {

constexpr float kSampleVeil = 0.30F;  // opacity of one sample

void add_dots(SoSeparator& parent, std::span<const Eigen::Vector3d> points, geometric::Color color,
              float opacity, float width) {
  auto* separator = new SoSeparator;
  add_unlit_style(*separator, 1.0F, width);
  color.alpha = opacity;
  separator->addChild(make_material(color).get());
  auto* dots = new RoundPoints;
  dots->vertexProperty = make_vertices(points);
  separator->addChild(dots);
  parent.addChild(separator);
}

}  // namespace

Drawing make_region_node(const planning::RegionDraws& draws) {
  auto separator = make_coin<SoSeparator>();
  auto* motion = new SoAnnotation;  // the clouds and the robot would hide most of it
  add_unlit_style(*motion, 2.5F);
  motion->addChild(make_material(kStraightColor).get());
  auto* line = new SoLineSet;
  line->vertexProperty = make_vertices(draws.motion);
  motion->addChild(line);
  if (!draws.centres.empty()) {
    add_dots(*motion, draws.centres, kStraightColor, 1.0F, 8.0F);
  }
  add_dots(*separator.get(), draws.fingertips, kFingertipColor, kSampleVeil, 5.0F);
  add_dots(*separator.get(), draws.palms, kPalmColor, kSampleVeil, 7.0F);
  separator->addChild(motion);
  return separator;
}

namespace {

constexpr float kBoxLineWidth = 1.5F;
constexpr double kRounding = 0.005;  // of the way

}  // namespace

Drawing make_boxes_node(const std::vector<planning::PalmBox>& boxes,
                        std::pair<double, double> range) {
  std::vector<Eigen::Vector3d> corners;
  Edges searched;
  Edges given_up;
  const bool is_joined = range.second - range.first < kRounding;  // nothing is left to search
  for (const planning::PalmBox& box : boxes) {
    const bool is_within =
        is_joined || (box.step >= range.first - kRounding && box.step <= range.second + kRounding);
    const auto first = static_cast<int>(corners.size());
    std::ranges::copy(box_corners(box.X_WC, box.half_size), std::back_inserter(corners));
    for (const auto& [from, to] : kBoxEdges) {
      (is_within ? searched : given_up).emplace_back(first + from, first + to);
    }
  }
  auto separator = make_coin<SoSeparator>();
  for (const auto& [edges, color] :
       {std::pair(&given_up, kGivenUpColor), std::pair(&searched, kSearchedColor)}) {
    if (!edges->empty()) {
      separator->addChild(make_edges_node(corners, *edges, color, kBoxLineWidth));
    }
  }
  return separator;
}

namespace {

constexpr std::array<geometric::Color, 6> kScale{{{0.16F, 0.40F, 0.78F, 1.0F},
                                                  {0.05F, 0.60F, 0.62F, 1.0F},
                                                  {0.36F, 0.63F, 0.15F, 1.0F},
                                                  {0.88F, 0.63F, 0.05F, 1.0F},
                                                  {0.86F, 0.31F, 0.13F, 1.0F},
                                                  {0.70F, 0.17F, 0.50F, 1.0F}}};

}  // namespace

geometric::Color pmd_color(int count, int most) {
  if (count <= 0) {
    return {0.47F, 0.50F, 0.55F, 1.0F};
  }
  const int steps = std::max(most, static_cast<int>(kScale.size())) - 1;
  const float place = static_cast<float>(std::min(count - 1, steps) * (kScale.size() - 1)) /
                      static_cast<float>(steps);
  const auto below = static_cast<std::size_t>(place);
  return mixed(kScale.at(below), kScale.at(std::min(below + 1, kScale.size() - 1)),
               place - static_cast<float>(below));
}

namespace {

constexpr float kDotWidth = 6.0F;
constexpr float kLineWidth = 1.0F;
constexpr geometric::Color kEdgeColor{0.52F, 0.58F, 0.67F, 1.0F};

SoSeparator* make_dots(const PalmRoadmap& roadmap) {
  const int most = most_pmds(roadmap);
  std::vector<geometric::Color> colors;
  for (const auto& node : roadmap.roadmap.nodes) {
    colors.push_back(pmd_color(node.pmd_count, most));
  }
  return make_dots_node(roadmap.palms, colors, kDotWidth);
}

}  // namespace

Drawing make_roadmap_node(const PalmRoadmap& roadmap) {
  auto separator = make_coin<SoSeparator>();
  if (!roadmap.roadmap.edges.empty()) {
    separator->addChild(
        make_edges_node(roadmap.palms, roadmap.roadmap.edges, kEdgeColor, kLineWidth));
  }
  separator->addChild(make_dots(roadmap));
  return separator;
}

int most_pmds(const PalmRoadmap& roadmap) {
  int most = 0;
  for (const auto& node : roadmap.roadmap.nodes) {
    most = std::max(most, node.pmd_count);
  }
  return most;
}

namespace {

namespace lines = planning::algorithm_lines;

constexpr geometric::Color kNode{0.16F, 0.36F, 0.72F, 1.0F};
constexpr geometric::Color kEdge{0.42F, 0.52F, 0.70F, 1.0F};
constexpr geometric::Color kFree{0.11F, 0.66F, 0.36F, 1.0F};
constexpr geometric::Color kRefused{0.85F, 0.16F, 0.14F, 1.0F};

}  // namespace

Drawing make_steps_node(const Microscope& microscope) {
  auto all = make_seen_through();
  const std::size_t done = microscope.position() + 1;
  const RecordedRun& run = *microscope.run();
  const auto edges = run.edges_after(done);
  if (!edges.empty()) {
    all->addChild(make_edges_node(microscope.palms(), edges, kEdge, 1.5F));
  }
  const int nodes = run.nodes_after(done);
  const std::span palms(microscope.palms());
  all->addChild(make_dots_node(palms.first(static_cast<std::size_t>(nodes)), {kNode}, 6.0F));
  const planning::AlgorithmStep& step = microscope.step().step;
  if (step.to >= 0 && step.line != lines::kJoined) {
    const std::pair<int, int> edge(step.from, step.to);
    all->addChild(make_edges_node(microscope.palms(), std::span(&edge, 1),
                                  step.yes ? kFree : kRefused, 4.0F));
  }
  if (step.from >= 0 && step.to < 0) {
    all->addChild(
        make_dots_node(palms.subspan(static_cast<std::size_t>(step.from), 1), {kFree}, 11.0F));
  }
  return all;
}

}  // namespace handway::gui
