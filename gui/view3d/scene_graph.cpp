#include "view3d/scene_graph.h"

#include "model/settings/orbit_camera.h"
#include "view3d/coin_conversions.h"
#include "view3d/orientation_cube.h"
#include "view3d/scene_passes.h"
#include "view3d/unlit_nodes.h"

#include <Inventor/SoPath.h>
#include <Inventor/SoPickedPoint.h>
#include <Inventor/actions/SoGLRenderAction.h>
#include <Inventor/actions/SoGetBoundingBoxAction.h>
#include <Inventor/actions/SoRayPickAction.h>
#include <Inventor/nodes/SoLineSet.h>
#include <Inventor/nodes/SoOrthographicCamera.h>
#include <Inventor/nodes/SoPerspectiveCamera.h>
#include <Inventor/nodes/SoSeparator.h>
#include <Inventor/nodes/SoSwitch.h>
#include <Inventor/nodes/SoVertexProperty.h>

#include <GL/gl.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace handway::gui {
namespace {

constexpr double kSpacing = 0.1;  // m
constexpr int kStrongEvery = 5;

class GridLines {
 public:
  GridLines(const Eigen::Vector3d& centre, double radius, const geometric::Color& color)
      : centre_(centre), radius_(radius), color_(color) {}

  // A line parallel to `along`, `offset` from the middle, in pieces that fade.
  void add(const Eigen::Vector3d& along, const Eigen::Vector3d& across, double offset,
           float strength) {
    const double half = std::sqrt(std::max(radius_ * radius_ - offset * offset, 0.0));
    const int pieces = std::max(2, static_cast<int>(std::ceil(2.0 * half / 0.25)));
    for (int i = 0; i <= pieces; ++i) {
      const double s = half * (2.0 * i / pieces - 1.0);
      const double from_middle = std::hypot(s, offset) / radius_;
      geometric::Color color = color_;
      color.alpha = strength * static_cast<float>(std::pow(1.0 - std::min(from_middle, 1.0), 1.2));
      points_.push_back(to_coin(Eigen::Vector3d(centre_ + s * along + offset * across)));
      colors_.push_back(packed_rgba(color));
    }
    counts_.push_back(pieces + 1);
  }

  [[nodiscard]] SoLineSet* make() const {
    auto* properties = new SoVertexProperty;
    properties->vertex.setValues(0, static_cast<int>(points_.size()), points_.data());
    properties->orderedRGBA.setValues(0, static_cast<int>(colors_.size()), colors_.data());
    properties->materialBinding = SoVertexProperty::PER_VERTEX;
    auto* lines = new SoLineSet;
    lines->vertexProperty = properties;
    lines->numVertices.setValues(0, static_cast<int>(counts_.size()), counts_.data());
    return lines;
  }

 private:
  Eigen::Vector3d centre_;
  double radius_;
  geometric::Color color_;
  std::vector<SbVec3f> points_;
  std::vector<std::uint32_t> colors_;
  std::vector<std::int32_t> counts_;
};

}  // namespace

CoinRef<SoSeparator> make_floor_grid(const Eigen::Vector3d& centre, double radius,
                                     const geometric::Color& color) {
  // Lines stand at whole multiples of the spacing in the world.
  const Eigen::Vector3d middle(std::round(centre.x() / kSpacing) * kSpacing,
                               std::round(centre.y() / kSpacing) * kSpacing, centre.z());
  GridLines grid(middle, radius, color);
  const int count = static_cast<int>(radius / kSpacing);
  const auto strength = [](long line) { return line % kStrongEvery == 0 ? 0.55F : 0.22F; };
  for (int i = -count; i <= count; ++i) {
    grid.add(Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(), i * kSpacing,
             strength(std::lround(middle.y() / kSpacing) + i));
    grid.add(Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitX(), i * kSpacing,
             strength(std::lround(middle.x() / kSpacing) + i));
  }
  auto separator = make_coin<SoSeparator>();
  add_unlit_style(*separator.get(), 1.0F);
  separator->addChild(grid.make());
  return separator;
}

namespace {

using geometric::Aabb;
using geometric::Configuration;
using geometric::Pose;
using Points = std::vector<Eigen::Vector3d>;

constexpr double kAround = 0.12;  // m

void add_corners(Points& points, const Aabb& box, const Pose& X) {
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3d p((corner & 1) ? box.upper.x() : box.lower.x(),
                            (corner & 2) ? box.upper.y() : box.lower.y(),
                            (corner & 4) ? box.upper.z() : box.lower.z());
    points.push_back(X * p);
  }
}

void add_shape(Points& points, const geometric::Shape& shape, const Pose& X) {
  const auto mesh = geometric::tessellate(shape);
  if (mesh && !mesh->vertices.empty()) {
    add_corners(points, geometric::bounding_box(*mesh), X);
  }
}

std::vector<Pose> link_poses(const geometric::RobotInstance& robot, const Configuration& q) {
  std::vector<Pose> X_WL(static_cast<std::size_t>(robot.model->link_count()));
  robot.model->forward_kinematics(q, X_WL);
  for (Pose& X : X_WL) {
    X = robot.X_WB * X;
  }
  return X_WL;
}

void add_robot(Points& points, const geometric::RobotInstance& robot, const Configuration& q) {
  const std::vector<Pose> X_WL = link_poses(robot, q);
  for (int i = 0; i < robot.model->link_count(); ++i) {
    const geometric::Link& link = robot.model->link(i);
    for (const auto& geometry : link.visual.empty() ? link.collision : link.visual) {
      add_shape(points, geometry.shape, X_WL[static_cast<std::size_t>(i)] * geometry.X_LG);
    }
  }
}

Aabb box_around(const Points& points) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  Aabb box{Eigen::Vector3d::Constant(kFar), Eigen::Vector3d::Constant(-kFar)};
  for (const Eigen::Vector3d& point : points) {
    box.lower = box.lower.cwiseMin(point);
    box.upper = box.upper.cwiseMax(point);
  }
  return box;
}

Points robot_points(const geometric::Scene& scene) {
  Points points;
  for (const geometric::RobotInstance& robot : scene.robots) {
    add_robot(points, robot, robot.configuration);
  }
  for (const auto& q : {scene.start, scene.goal}) {
    if (q && !scene.robots.empty()) {
      add_robot(points, scene.robots.front(), *q);
    }
  }
  return points;
}

}  // namespace

Points points_of_interest(const geometric::Scene& scene) {
  Points points = robot_points(scene);
  const bool has_robot = !points.empty();
  Aabb near = box_around(points);
  near.lower.array() -= kAround;
  near.upper.array() += kAround;
  for (const geometric::SceneObject& object : scene.objects) {
    Points corners;
    if (!object.attachment) {
      add_shape(corners, object.shape, object.X_PO);
    }
    if (has_robot && !corners.empty()) {
      const Aabb box = box_around(corners);
      const Aabb part{box.lower.cwiseMax(near.lower), box.upper.cwiseMin(near.upper)};
      corners.clear();
      if ((part.lower.array() <= part.upper.array()).all()) {
        add_corners(corners, part, Pose::Identity());
      }
    }
    points.insert(points.end(), corners.begin(), corners.end());
  }
  return points;
}

double lowest_point(const geometric::Scene& scene) {
  Points points = robot_points(scene);
  for (const geometric::SceneObject& object : scene.objects) {
    if (!object.attachment) {
      add_shape(points, object.shape, object.X_PO);
    }
  }
  return points.empty() ? 0.0 : box_around(points).lower.z();
}

double task_azimuth(const geometric::Scene& scene) {
  if (scene.robots.empty()) {
    return 0.0;
  }
  const geometric::RobotInstance& robot = scene.robots.front();
  const std::vector<Pose> X_WL = link_poses(robot, scene.goal.value_or(robot.configuration));
  const Eigen::Vector3d reach = X_WL.back().translation() - robot.X_WB.translation();
  return reach.head<2>().norm() > 0.05 ? std::atan2(reach.y(), reach.x()) : 0.0;
}

Points all_points(const geometric::Scene& scene) {
  Points points = robot_points(scene);
  for (const geometric::SceneObject& object : scene.objects) {
    if (!object.attachment) {
      add_shape(points, object.shape, object.X_PO);
    }
  }
  return points;
}

namespace {

constexpr int kSeenPoints = 24;        // of the robot
constexpr double kEnoughSeen = 0.7;    // share of them
constexpr double kFarEye = 4.0;        // m from the middle
constexpr double kNearlyThere = 0.97;  // of the ray: what is seen may touch something

// Does something of the mesh lie between the two (in its frame)?
bool hides(const geometric::TriangleMesh& mesh, const Eigen::Vector3d& eye,
           const Eigen::Vector3d& point) {
  const Eigen::Vector3d ray = point - eye;
  return std::ranges::any_of(mesh.triangles, [&](const auto& corners) {
    const Eigen::Vector3d& a = mesh.vertices[corners[0]];
    const Eigen::Vector3d ab = mesh.vertices[corners[1]] - a, ac = mesh.vertices[corners[2]] - a;
    const Eigen::Vector3d p = ray.cross(ac);
    const double det = ab.dot(p);
    if (std::abs(det) < 1e-12) {
      return false;
    }
    const Eigen::Vector3d from = eye - a, q = from.cross(ab);
    const double u = from.dot(p) / det, v = ray.dot(q) / det, t = ac.dot(q) / det;
    return u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0 && t < kNearlyThere;
  });
}

/// What stands around the robot, to look past it.
class Obstacles {
 public:
  explicit Obstacles(const geometric::Scene& scene) {
    for (const geometric::SceneObject& object : scene.objects) {
      const auto mesh = object.attachment ? nullptr : geometric::tessellate(object.shape);
      if (mesh && !mesh->vertices.empty() && !scene.display.of(object.name).hidden) {
        const Aabb box = geometric::bounding_box(*mesh);
        parts_.push_back({mesh, Eigen::AlignedBox3d(box.lower, box.upper), object.X_PO.inverse()});
      }
    }
  }

  [[nodiscard]] bool hide(const Eigen::Vector3d& eye, const Eigen::Vector3d& point) const {
    return std::ranges::any_of(parts_, [&](const Part& part) {
      const Eigen::Vector3d from = part.X_OW * eye, to = part.X_OW * point;
      return meets(part.box, from, to) && hides(*part.mesh, from, to);
    });
  }

 private:
  struct Part {
    std::shared_ptr<const geometric::TriangleMesh> mesh;
    Eigen::AlignedBox3d box;  // in its frame
    Pose X_OW;
  };

  static bool meets(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& from,
                    const Eigen::Vector3d& to) {
    double begin = 0.0, end = 1.0;
    for (int axis = 0; axis < 3; ++axis) {
      const double step = to[axis] - from[axis];
      if (std::abs(step) < 1e-12) {
        if (from[axis] < box.min()[axis] || from[axis] > box.max()[axis]) {
          return false;
        }
        continue;
      }
      const auto [low, high] = std::minmax(
          {(box.min()[axis] - from[axis]) / step, (box.max()[axis] - from[axis]) / step});
      begin = std::max(begin, low);
      end = std::min(end, high);
    }
    return begin <= end;
  }

  std::vector<Part> parts_;
};

}  // namespace

double open_azimuth(const geometric::Scene& scene) {
  const double task = task_azimuth(scene);
  const Obstacles obstacles(scene);
  const Points robot = robot_points(scene);
  if (robot.empty()) {
    return task;
  }
  const Eigen::Vector3d middle = box_around(robot).centre();
  const std::size_t step = std::max<std::size_t>(1, robot.size() / kSeenPoints);
  double best = task;
  double most = -1.0;
  for (const double turn : {0.0, 70.0, -40.0, 110.0, -90.0, 145.0, -140.0, 180.0}) {
    OrbitCamera camera;
    camera.look_from(StandardView::kOblique, task + geometric::radians(turn));
    const Eigen::Vector3d eye = middle + kFarEye * camera.orientation().col(2);
    double seen = 0.0, all = 0.0;
    for (std::size_t i = 0; i < robot.size(); i += step) {
      const Eigen::Vector3d point = 0.5 * (robot[i] + middle);  // corners are outside of links
      seen += obstacles.hide(eye, point) ? 0.0 : 1.0;
      all += 1.0;
    }
    if (seen / all > most + 0.05) {
      most = seen / all;
      best = task + geometric::radians(turn);
    }
    if (most >= kEnoughSeen) {
      break;
    }
  }
  return best;
}

namespace {

constexpr double kVeilDepth = 0.06;  // m: a ghost that is no farther before an object is part of it
constexpr double kReach = 12.0;      // m: what is shown behind the target

void turn(SoCamera& eye, const OrbitCamera& camera, double aspect) {
  const Eigen::Matrix3f R = camera.orientation().cast<float>();
  SbMatrix turn = SbMatrix::identity();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      turn[row][column] = R(column, row);
    }
  }
  eye.viewportMapping = SoCamera::LEAVE_ALONE;
  eye.aspectRatio = static_cast<float>(aspect);
  eye.orientation = SbRotation(turn);
}

}  // namespace

void aim_camera(SoPerspectiveCamera& eye, const OrbitCamera& camera, double aspect) {
  turn(eye, camera, aspect);
  eye.position = to_coin(camera.position());
  eye.heightAngle = static_cast<float>(OrbitCamera::kFieldOfView);
  const double distance = camera.placement().distance;
  eye.nearDistance = static_cast<float>(std::max(0.01, 0.05 * distance));
  eye.farDistance = static_cast<float>(distance + kReach);
  eye.focalDistance = static_cast<float>(distance);
}

void aim_camera(SoOrthographicCamera& eye, const OrbitCamera& camera, double aspect) {
  turn(eye, camera, aspect);
  const Eigen::Vector3d backwards = camera.orientation().col(2);
  eye.position = to_coin(Eigen::Vector3d(camera.placement().target + kReach * backwards));
  eye.height = static_cast<float>(camera.seen_height(camera.placement().distance));
  eye.nearDistance = 0.01F;
  eye.farDistance = static_cast<float>(2.0 * kReach);
  eye.focalDistance = static_cast<float>(kReach);
}

SceneGraph::SceneGraph() : passes_(std::make_unique<ScenePasses>()) {
  passes_->gizmo->addChild(gizmo_.root());
  outline_.root()->insertChild(passes_->camera.get(), 0);
  outline_.root()->insertChild(passes_->detail.get(), 0);
}
SceneGraph::~SceneGraph() = default;

void SceneGraph::set_scene(std::shared_ptr<const geometric::Scene> scene) {
  bodies_.show(std::move(scene));
  start_.clear();
  goal_.clear();
  show_frontier({});
  traces_.clear();
  colliding_.clear();
  selection_ = {};
  for (const auto& [overlay, shown] : passes_->overlays) {
    shown->removeAllChildren();
  }
  if (bodies_.scene()) {
    add_ghosts();
    if (bodies_.has_robot()) {
      set_configuration(bodies_.scene()->robots.front().configuration);
    }
  }
  list_solids();
  update_outline();
  rebuild_floor();
}

void SceneGraph::update_scene(const SceneState& state) {
  if (state.scene != bodies_.scene()) {
    bodies_.update(state.scene);
    show_frontier({});
    add_ghosts();
    set_configuration(Configuration(bodies_.configuration()));
  }
  list_solids();
  update_looks();
}

void SceneGraph::preview(const SceneItem& item, const Pose& X_WO) { bodies_.preview(item, X_WO); }

void SceneGraph::stand_in(const BodyMeshes& meshes) { bodies_.stand_in(meshes); }

void SceneGraph::set_handles(const Drawing& handles) {
  passes_->gizmo->replaceChild(ScenePasses::kGizmo,
                               handles.node() ? handles.node() : gizmo_.root());
}

void SceneGraph::add_ghosts() {
  add_ghost(start_, bodies_.scene()->start, kStartColor);
  add_ghost(goal_, bodies_.scene()->goal, kGoalColor);
}

void SceneGraph::add_ghost(Ghost& ghost, const std::optional<Configuration>& q,
                           const geometric::Color& color) {
  if (!q || bodies_.scene()->robots.empty()) {
    ghost.clear();
    return;
  }
  ghost.show(bodies_.scene()->robots.front(), *q, bodies_.first_robot_shapes(), color,
             [this](SoSeparator* root) { passes_->prepare(root); });
}

void SceneGraph::list_solids() {
  passes_->solid_content->removeAllChildren();
  for (SoNode* node : bodies_.shown()) {
    passes_->solid_content->addChild(node);
  }
}

void SceneGraph::set_colors(const ViewColors& colors) {
  colors_ = colors;
  rebuild_floor();
}

void SceneGraph::rebuild_floor() {
  passes_->floor_content->removeAllChildren();
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  if (bodies_.scene() && !bodies_.scene()->robots.empty()) {
    centre = bodies_.scene()->robots.front().X_WB.translation();
    centre.z() = std::min(0.0, lowest_point(*bodies_.scene()));
  }
  passes_->floor_content->addChild(make_floor_grid(centre, 2.5, colors_.grid).get());
}

bool SceneGraph::set_configuration(const Configuration& q) {
  if (!bodies_.has_robot()) {
    return false;
  }
  bodies_.place(q);
  const bool ghosts_changed = update_ghosts();
  return passes_->split->note_motion(bodies_.first_robot()) || ghosts_changed;
}

bool SceneGraph::update_ghosts() {
  return bodies_.has_robot() &&
         hide_doubled_links(bodies_.first_robot(), std::array<const Ghost*, 4>{
                                                       &start_, &goal_, &from_start_, &from_goal_});
}

void SceneGraph::show_ghosts(bool start, bool goal) {
  wants_start_ = start;
  wants_goal_ = goal;
  const bool frontier = from_start_.is_visible();
  start_.set_visible(start && !frontier);
  goal_.set_visible(goal && !frontier);
  update_ghosts();
}

void SceneGraph::show_frontier(const std::optional<Frontier>& frontier) {
  from_start_.clear();
  from_goal_.clear();
  obstacles_.clear();
  if (frontier) {
    add_ghost(from_start_, frontier->from_start, kFromStartColor);
    add_ghost(from_goal_, frontier->from_goal, kFromGoalColor);
    paint_frontier(frontier->colliding);
  }
  show_ghosts(wants_start_, wants_goal_);
  update_looks();
}

void SceneGraph::paint_frontier(const std::vector<std::string>& colliding) {
  for (const geometric::SceneObject& object : bodies_.scene()->objects) {
    if (std::ranges::count(colliding, object.name) > 0) {
      obstacles_.push_back(object.name);
    }
  }
  for (const Ghost* ghost : {&from_start_, &from_goal_}) {
    RobotNode* robot = ghost->robot();
    for (int i = 0; robot && i < robot->model().link_count(); ++i) {
      if (std::ranges::count(colliding, robot->model().link(i).name) > 0) {
        robot->set_look(i, Look::kColliding);
      }
    }
  }
}

void SceneGraph::preview_ghost(bool start, const std::optional<Configuration>& q) {
  add_ghost(start ? start_ : goal_, q, start ? kStartColor : kGoalColor);
  update_ghosts();
}

void SceneGraph::set_traces(const Drawing& drawing) {
  traces_.clear();
  if (drawing.node()) {
    traces_.show(drawing.node(), [this](SoSeparator* root) { passes_->prepare(root); });
  }
}

bool SceneGraph::set_collisions(std::vector<std::string> bodies) {
  colliding_ = std::move(bodies);
  return update_looks();
}

void SceneGraph::set_selection(const Selection& selection) {
  selection_ = selection;
  update_looks();
}

// @returns whether something looks different that stood still.
bool SceneGraph::update_looks() {
  std::vector<std::string> painted = colliding_;
  painted.insert(painted.end(), obstacles_.begin(), obstacles_.end());
  const bool changed = bodies_.set_colliding(painted, *passes_->split);
  update_outline();
  return changed;
}

void SceneGraph::update_outline() { outline_.set_parts(bodies_.parts_of(selection_)); }

void SceneGraph::set_overlay(Overlay overlay, const Drawing& drawing) {
  SoSwitch& shown = *passes_->overlays.at(overlay).get();
  shown.removeAllChildren();
  if (drawing.node()) {
    shown.addChild(drawing.node());
  }
}

void SceneGraph::set_overlay_visible(Overlay overlay, bool visible) {
  passes_->overlays.at(overlay)->whichChild = visible ? SO_SWITCH_ALL : SO_SWITCH_NONE;
}

void SceneGraph::set_floor_visible(bool visible) {
  passes_->floor_content->whichChild = visible ? SO_SWITCH_ALL : SO_SWITCH_NONE;
}

std::vector<Eigen::Vector3d> SceneGraph::points_of_interest() const {
  return bodies_.scene() ? gui::points_of_interest(*bodies_.scene())
                         : std::vector<Eigen::Vector3d>{};
}

double SceneGraph::open_azimuth() const {
  return bodies_.scene() ? gui::open_azimuth(*bodies_.scene()) : 0.0;
}

Points SceneGraph::selected_points() const {
  Points points;
  for (SoSeparator* part : bodies_.parts_of(selection_)) {
    SoGetBoundingBoxAction around{SbViewportRegion()};
    around.apply(part);
    const SbBox3f box = around.getBoundingBox();
    if (!box.isEmpty()) {
      const SbVec3f &low = box.getMin(), &high = box.getMax();
      add_corners(points, {{low[0], low[1], low[2]}, {high[0], high[1], high[2]}},
                  Pose::Identity());
    }
  }
  return points.empty() && bodies_.scene() ? all_points(*bodies_.scene()) : points;
}

void SceneGraph::aim(const OrbitCamera& camera, double aspect) {
  const bool parallel = camera.projection() == Projection::kOrthographic;
  passes_->camera->whichChild = parallel ? 1 : 0;
  if (parallel) {
    aim_camera(*passes_->orthographic.get(), camera, aspect);
  } else {
    aim_camera(*passes_->perspective.get(), camera, aspect);
  }
  backwards_ = camera.orientation().col(2);
}

void SceneGraph::set_fine(bool fine) { passes_->set_fine(fine); }

void SceneGraph::render(SoGLRenderAction& action) {
  action.setTransparencyType(SoGLRenderAction::SORTED_OBJECT_BLEND);
  action.apply(passes_->solids.get());
  action.setTransparencyType(SoGLRenderAction::BLEND);
  action.apply(passes_->floor.get());
  for (const Ghost* ghost : ghosts()) {
    ghost->render(action);
  }
}

void SceneGraph::begin_motion() {
  if (bodies_.has_robot()) {
    passes_->split->begin(bodies_.first_robot());
  }
}

void SceneGraph::render_still(SoGLRenderAction& action) {
  const auto overlay = [this](Overlay which) { return passes_->overlays.at(which).get(); };
  auto [still, moving] = bodies_.others();
  still.insert(still.begin(),
               {overlay(Overlay::kPath), overlay(Overlay::kRoadmap), overlay(Overlay::kTrails),
                overlay(Overlay::kSteps), overlay(Overlay::kHypercubes)});
  moving.insert(
      moving.begin(),
      {overlay(Overlay::kExecuted), overlay(Overlay::kOptimized), overlay(Overlay::kContacts),
       overlay(Overlay::kRegion), overlay(Overlay::kClearance), overlay(Overlay::kConstraints),
       overlay(Overlay::kMeasure), overlay(Overlay::kGoalPoses), overlay(Overlay::kReach)});
  passes_->split->list(bodies_.has_robot() ? &bodies_.first_robot() : nullptr, still, moving);
  action.setTransparencyType(SoGLRenderAction::SORTED_OBJECT_BLEND);
  action.apply(passes_->split->still());
  action.setTransparencyType(SoGLRenderAction::BLEND);
  action.apply(passes_->floor.get());
}

void SceneGraph::render_moving(SoGLRenderAction& action) {
  action.setTransparencyType(SoGLRenderAction::SORTED_OBJECT_BLEND);
  action.apply(passes_->split->moving());
}

SoNode& SceneGraph::moving_root() const { return *passes_->split->moving(); }

void SceneGraph::render_marks(SoGLRenderAction& action, bool with_gizmo, float pixel_ratio) {
  outline_.render(action, 4.0F * pixel_ratio);
  if (with_gizmo) {
    glClear(GL_DEPTH_BUFFER_BIT);
    action.setTransparencyType(SoGLRenderAction::BLEND);
    action.apply(passes_->gizmo.get());
  }
}

void SceneGraph::render_axes(SoGLRenderAction& action, const OrbitCamera& camera) {
  SoOrthographicCamera& eye = *passes_->axes_camera.get();
  aim_camera(eye, camera, 1.0);
  eye.position = to_coin(Eigen::Vector3d(4.0 * camera.orientation().col(2)));
  eye.height = static_cast<float>(ViewOverlay::kAxesHeight);
  eye.nearDistance = 1.0F;
  eye.farDistance = 8.0F;
  action.setTransparencyType(SoGLRenderAction::NONE);
  action.apply(passes_->axes.get());
}

std::optional<SceneHit> SceneGraph::pick(const SbVec2s& viewport, const SbVec2s& pixel) {
  SoRayPickAction action{SbViewportRegion(viewport)};
  action.setPoint(pixel);
  action.setRadius(3.0F);
  std::optional<SceneHit> nearest;
  double most = -std::numeric_limits<double>::infinity();
  const auto look_at = [&](SoNode* root, const auto& item_of_path) {
    action.apply(root);
    if (const SoPickedPoint* picked = action.getPickedPoint()) {
      const SbVec3f& p = picked->getPoint();
      const Eigen::Vector3d point(p[0], p[1], p[2]);
      const double nearness = backwards_.dot(point);
      if (nearness > most) {
        most = nearness;
        nearest = SceneHit{item_of_path(*picked->getPath()), point};
      }
    }
  };
  look_at(passes_->solids.get(), [this](const SoPath& path) { return bodies_.item_of(path); });
  if (nearest && nearest->item.kind == SceneItem::Kind::kLink) {
    return nearest;  // ghosts are veils that often hang before the robot
  }
  if (nearest) {
    most += kVeilDepth;  // what a ghost grasps is meant, not the ghost
  }
  for (const auto& [ghost, kind] :
       {std::pair(&start_, SceneItem::Kind::kStart), std::pair(&goal_, SceneItem::Kind::kGoal)}) {
    if (ghost->is_visible()) {
      look_at(ghost->root(), [kind = kind](const SoPath&) { return SceneItem{kind, "", ""}; });
    }
  }
  return nearest;
}

}  // namespace handway::gui
