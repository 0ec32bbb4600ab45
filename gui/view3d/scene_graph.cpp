#include "view3d/scene_graph.h"

#include "view3d/axes_node.h"
#include "view3d/coin_conversions.h"
#include "view3d/floor_grid.h"
#include "view3d/lights.h"
#include "view3d/path_node.h"
#include "view3d/scene_extent.h"
#include "view3d/view_overlay.h"

#include <Inventor/SoPath.h>
#include <Inventor/SoPickedPoint.h>
#include <Inventor/actions/SoGLRenderAction.h>
#include <Inventor/actions/SoRayPickAction.h>
#include <Inventor/nodes/SoOrthographicCamera.h>
#include <Inventor/nodes/SoPerspectiveCamera.h>
#include <Inventor/nodes/SoPolygonOffset.h>
#include <Inventor/nodes/SoSeparator.h>
#include <Inventor/nodes/SoSwitch.h>

#include <GL/gl.h>

#include <algorithm>
#include <utility>

namespace handway::gui {

using geometric::Configuration;
using geometric::Pose;

/// One root a pass, all seen by the same camera under the same lights.
struct SceneGraph::Passes {
  CoinRef<SoPerspectiveCamera> camera = make_coin<SoPerspectiveCamera>();
  CoinRef<SoGroup> camera_lights = make_camera_lights();
  CoinRef<SoGroup> sky_light = make_sky_light();
  CoinRef<SoSeparator> solids = make_coin<SoSeparator>();
  CoinRef<SoSeparator> solid_content = make_coin<SoSeparator>();
  CoinRef<SoSeparator> floor = make_coin<SoSeparator>();
  CoinRef<SoSwitch> floor_content = make_coin<SoSwitch>();
  CoinRef<SoSwitch> path = make_coin<SoSwitch>();
  CoinRef<SoSwitch> dots = make_coin<SoSwitch>();
  CoinRef<SoOrthographicCamera> axes_camera = make_coin<SoOrthographicCamera>();
  CoinRef<SoSeparator> axes = make_coin<SoSeparator>();

  Passes() {
    for (SoSeparator* root : {solids.get(), floor.get()}) {
      prepare(root);
    }
    solids->addChild(solid_content.get());
    solids->addChild(path.get());
    solids->addChild(dots.get());
    solid_content->renderCaching = SoSeparator::OFF;
    floor->addChild(floor_content.get());
    for (SoSwitch* shown : {path.get(), dots.get(), floor_content.get()}) {
      shown->whichChild = SO_SWITCH_ALL;
    }
    axes->addChild(camera_lights.get());
    axes->addChild(axes_camera.get());
    axes->addChild(make_axes_node().get());
  }

  void prepare(SoSeparator* root) const {
    root->renderCaching = SoSeparator::OFF;
    root->addChild(camera_lights.get());
    root->addChild(camera.get());
    root->addChild(sky_light.get());
  }
};

SceneGraph::SceneGraph() : passes_(std::make_unique<Passes>()) {}
SceneGraph::~SceneGraph() = default;

void SceneGraph::set_scene(std::shared_ptr<const geometric::Scene> scene) {
  scene_ = std::move(scene);
  robots_.clear();
  objects_.clear();
  start_ = {};
  goal_ = {};
  colliding_.clear();
  selection_ = {};
  passes_->solid_content->removeAllChildren();
  passes_->path->removeAllChildren();
  passes_->dots->removeAllChildren();
  if (scene_) {
    add_robots();
    add_objects();
    if (!scene_->robots.empty()) {
      set_configuration(scene_->robots.front().configuration);
    }
  }
  rebuild_floor();
}

void SceneGraph::add_robots() {
  for (std::size_t i = 0; i < scene_->robots.size(); ++i) {
    const geometric::RobotInstance& robot = scene_->robots[i];
    const LinkShapes shapes = make_link_shapes(*robot.model);
    robots_.push_back(std::make_unique<RobotNode>(robot.model, shapes));
    robots_.back()->place(robot.X_WB, robot.configuration);
    passes_->solid_content->addChild(robots_.back()->root());
    if (i == 0) {
      add_ghost(start_, scene_->start, kStartColor, shapes);
      add_ghost(goal_, scene_->goal, kGoalColor, shapes);
    }
  }
}

void SceneGraph::add_ghost(Ghost& ghost, const std::optional<Configuration>& q,
                           const geometric::Color& color, const LinkShapes& shapes) {
  if (!q) {
    return;
  }
  geometric::Color faint = color;
  faint.alpha = 0.26F;
  ghost.q = *q;
  ghost.robot = std::make_unique<RobotNode>(scene_->robots.front().model, shapes, faint);
  ghost.robot->place(scene_->robots.front().X_WB, *q);
  ghost.root = make_coin<SoSeparator>();
  passes_->prepare(ghost.root.get());
  auto* behind = new SoPolygonOffset;  // does not flicker with the robot where both coincide
  behind->factor = 2.0F;
  behind->units = 60.0F;
  ghost.root->addChild(behind);
  ghost.root->addChild(ghost.robot->root());
}

void SceneGraph::add_objects() {
  for (const geometric::SceneObject& object : scene_->objects) {
    objects_.push_back(std::make_unique<ObjectNode>(object));
    passes_->solid_content->addChild(objects_.back()->root());
  }
}

void SceneGraph::set_colors(const ViewColors& colors) {
  colors_ = colors;
  rebuild_floor();
}

void SceneGraph::rebuild_floor() {
  passes_->floor_content->removeAllChildren();
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  if (scene_ && !scene_->robots.empty()) {
    centre = scene_->robots.front().X_WB.translation();
    centre.z() = std::min(0.0, lowest_point(*scene_));
  }
  passes_->floor_content->addChild(make_floor_grid(centre, 2.5, colors_.grid).get());
}

void SceneGraph::set_configuration(const Configuration& q) {
  if (!scene_ || robots_.empty()) {
    return;
  }
  robots_.front()->place(scene_->robots.front().X_WB, q);
  for (std::size_t i = 0; i < objects_.size(); ++i) {
    const geometric::SceneObject& object = scene_->objects[i];
    if (!object.attachment) {
      continue;
    }
    for (std::size_t r = 0; r < robots_.size(); ++r) {
      const auto link = robots_[r]->model().find_link(object.attachment->link);
      if (scene_->robots[r].name == object.attachment->robot && link) {
        const Pose& X_WL = robots_[r]->link_poses()[static_cast<std::size_t>(*link)];
        objects_[i]->place(X_WL * object.X_PO);
      }
    }
  }
  update_ghosts();
}

// A ghost's link that lies where the robot's own is would only flicker with it.
void SceneGraph::update_ghosts() {
  for (const Ghost* ghost : {&start_, &goal_}) {
    if (!ghost->robot) {
      continue;
    }
    for (std::size_t i = 0; i < ghost->robot->link_poses().size(); ++i) {
      const bool apart =
          !ghost->robot->link_poses()[i].isApprox(robots_.front()->link_poses()[i], 1e-3);
      const bool doubled =
          ghost == &goal_ && start_.robot && start_.visible &&
          ghost->robot->link_poses()[i].isApprox(start_.robot->link_poses()[i], 1e-3);
      ghost->robot->set_link_visible(static_cast<int>(i), apart && !doubled);
    }
  }
}

void SceneGraph::show_ghosts(bool start, bool goal) {
  start_.visible = start;
  goal_.visible = goal;
  update_ghosts();
}

void SceneGraph::set_collisions(std::vector<std::string> bodies) {
  colliding_ = std::move(bodies);
  update_looks();
}

void SceneGraph::set_selection(const SceneItem& item) {
  selection_ = item;
  update_looks();
}

void SceneGraph::update_looks() {
  const auto collides = [this](const std::string& body) {
    return std::ranges::find(colliding_, body) != colliding_.end();
  };
  using Kind = SceneItem::Kind;
  for (std::size_t r = 0; r < robots_.size(); ++r) {
    const std::string& robot = scene_->robots[r].name;
    for (int i = 0; i < robots_[r]->model().link_count(); ++i) {
      const std::string& link = robots_[r]->model().link(i).name;
      const bool selected = selection_.robot == robot &&
                            (selection_.kind == Kind::kRobot ||
                             (selection_.kind == Kind::kLink && selection_.name == link));
      robots_[r]->set_look(i, collides(r == 0 ? link : robot + "/" + link) ? Look::kColliding
                              : selected                                   ? Look::kSelected
                                                                           : Look::kPlain);
    }
  }
  for (const auto& object : objects_) {
    const bool selected = selection_.kind == Kind::kObject && selection_.name == object->name();
    object->set_look(collides(object->name()) ? Look::kColliding
                     : selected               ? Look::kSelected
                                              : Look::kPlain);
  }
}

void SceneGraph::set_path(std::span<const Eigen::Vector3d> points,
                          std::span<const Eigen::Vector3d> waypoints) {
  passes_->path->removeAllChildren();
  if (!points.empty()) {
    passes_->path->addChild(make_path_node(points, waypoints).get());
  }
}

void SceneGraph::set_dots(std::span<const Eigen::Vector3d> points) {
  passes_->dots->removeAllChildren();
  if (!points.empty()) {
    passes_->dots->addChild(make_dots_node(points).get());
  }
}

void SceneGraph::set_dots_visible(bool visible) {
  passes_->dots->whichChild = visible ? SO_SWITCH_ALL : SO_SWITCH_NONE;
}

void SceneGraph::set_floor_visible(bool visible) {
  passes_->floor_content->whichChild = visible ? SO_SWITCH_ALL : SO_SWITCH_NONE;
}

std::vector<Eigen::Vector3d> SceneGraph::points_of_interest() const {
  return scene_ ? gui::points_of_interest(*scene_) : std::vector<Eigen::Vector3d>{};
}

double SceneGraph::task_azimuth() const { return scene_ ? gui::task_azimuth(*scene_) : 0.0; }

void SceneGraph::render(SoGLRenderAction& action, const OrbitCamera& camera, double aspect) {
  SoPerspectiveCamera& eye = *passes_->camera.get();
  const Eigen::Matrix3f R = camera.orientation().cast<float>();
  SbMatrix turn = SbMatrix::identity();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      turn[row][column] = R(column, row);
    }
  }
  eye.viewportMapping = SoCamera::LEAVE_ALONE;
  eye.aspectRatio = static_cast<float>(aspect);
  eye.position = to_coin(camera.position());
  eye.orientation = SbRotation(turn);
  eye.heightAngle = static_cast<float>(OrbitCamera::kFieldOfView);
  const double distance = camera.placement().distance;
  eye.nearDistance = static_cast<float>(std::max(0.01, 0.05 * distance));
  eye.farDistance = static_cast<float>(distance + 12.0);
  eye.focalDistance = static_cast<float>(distance);

  action.setTransparencyType(SoGLRenderAction::SORTED_OBJECT_BLEND);
  action.apply(passes_->solids.get());
  action.setTransparencyType(SoGLRenderAction::BLEND);
  action.apply(passes_->floor.get());
  render_ghost(action, start_);
  render_ghost(action, goal_);
}

// First the depth alone, then the colour of what is in front: a ghost is one
// even veil, however many surfaces lie behind each other.
void SceneGraph::render_ghost(SoGLRenderAction& action, const Ghost& ghost) const {
  if (!ghost.robot || !ghost.visible) {
    return;
  }
  glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  action.setTransparencyType(SoGLRenderAction::NONE);
  action.apply(ghost.root.get());
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_FALSE);
  action.setTransparencyType(SoGLRenderAction::BLEND);
  action.apply(ghost.root.get());
}

void SceneGraph::render_axes(SoGLRenderAction& action, const OrbitCamera& camera) {
  SoOrthographicCamera& eye = *passes_->axes_camera.get();
  passes_->axes_camera->orientation = passes_->camera->orientation;
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
  action.apply(passes_->solids.get());
  const SoPickedPoint* picked = action.getPickedPoint();
  if (!picked) {
    return std::nullopt;
  }
  const SbVec3f& p = picked->getPoint();
  return SceneHit{item_of(*picked->getPath()), {p[0], p[1], p[2]}};
}

SceneItem SceneGraph::item_of(const SoPath& path) const {
  for (int i = 0; i < path.getLength(); ++i) {
    const SoNode* node = path.getNode(i);
    for (const auto& object : objects_) {
      if (object->root() == node) {
        return {SceneItem::Kind::kObject, "", object->name()};
      }
    }
    for (std::size_t r = 0; r < robots_.size(); ++r) {
      if (const auto link = robots_[r]->find_link(node)) {
        return {SceneItem::Kind::kLink, scene_->robots[r].name,
                robots_[r]->model().link(*link).name};
      }
    }
  }
  return {};
}

}  // namespace handway::gui
