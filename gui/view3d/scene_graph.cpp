#include "view3d/scene_graph.h"

#include "view3d/coin_camera.h"
#include "view3d/coin_conversions.h"
#include "view3d/floor_grid.h"
#include "view3d/scene_extent.h"
#include "view3d/scene_passes.h"
#include "view3d/view_overlay.h"

#include <Inventor/SoPath.h>
#include <Inventor/SoPickedPoint.h>
#include <Inventor/actions/SoGLRenderAction.h>
#include <Inventor/actions/SoRayPickAction.h>
#include <Inventor/nodes/SoPerspectiveCamera.h>
#include <Inventor/nodes/SoSeparator.h>
#include <Inventor/nodes/SoSwitch.h>

#include <GL/gl.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace handway::gui {

using geometric::Configuration;
using geometric::Pose;

SceneGraph::SceneGraph() : passes_(std::make_unique<ScenePasses>()) {
  passes_->gizmo->addChild(gizmo_.root());
  outline_.root()->insertChild(passes_->camera.get(), 0);
}
SceneGraph::~SceneGraph() = default;

void SceneGraph::set_scene(std::shared_ptr<const geometric::Scene> scene) {
  scene_ = std::move(scene);
  robots_.clear();
  objects_.clear();
  first_robot_shapes_.clear();
  q_ = {};
  start_.clear();
  goal_.clear();
  traces_.clear();
  colliding_.clear();
  selection_ = {};
  for (const auto& [overlay, shown] : passes_->overlays) {
    shown->removeAllChildren();
  }
  if (scene_) {
    add_robots();
    add_ghosts();
    make_objects();
    if (!scene_->robots.empty()) {
      set_configuration(scene_->robots.front().configuration);
    }
  }
  list_solids();
  update_outline();
  rebuild_floor();
}

void SceneGraph::update_scene(const SceneState& state) {
  if (state.scene != scene_) {
    scene_ = state.scene;
    for (std::size_t i = 0; i < robots_.size(); ++i) {
      robots_[i]->place(scene_->robots[i].X_WB, scene_->robots[i].configuration);
    }
    add_ghosts();
    make_objects();
    set_configuration(Configuration(q_));
  }
  list_solids();
  update_looks();
}

void SceneGraph::preview(const SceneItem& item, const Pose& X_WO) {
  for (const auto& object : objects_) {
    if (item.kind == SceneItem::Kind::kObject && object->name() == item.name) {
      object->place(X_WO);
    }
  }
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    if (item.kind == SceneItem::Kind::kRobot && scene_->robots[i].name == item.robot) {
      robots_[i]->place(X_WO, i == 0 ? q_ : scene_->robots[i].configuration);
      if (i == 0) {
        place_attached();
      }
    }
  }
}

void SceneGraph::set_handles(SoNode* handles) {
  passes_->gizmo->replaceChild(ScenePasses::kGizmo, handles ? handles : gizmo_.root());
}

void SceneGraph::add_robots() {
  for (std::size_t i = 0; i < scene_->robots.size(); ++i) {
    const geometric::RobotInstance& robot = scene_->robots[i];
    const LinkShapes shapes = make_link_shapes(*robot.model);
    robots_.push_back(std::make_unique<RobotNode>(robot.model, shapes));
    robots_.back()->place(robot.X_WB, robot.configuration);
    if (i == 0) {
      first_robot_shapes_ = shapes;
    }
  }
}

void SceneGraph::add_ghosts() {
  add_ghost(start_, scene_->start, kStartColor);
  add_ghost(goal_, scene_->goal, kGoalColor);
}

void SceneGraph::add_ghost(Ghost& ghost, const std::optional<Configuration>& q,
                           const geometric::Color& color) {
  if (!q || scene_->robots.empty()) {
    ghost.clear();
    return;
  }
  ghost.show(scene_->robots.front(), *q, first_robot_shapes_, color,
             [this](SoSeparator* root) { passes_->prepare(root); });
}

void SceneGraph::make_objects() {
  std::vector<std::unique_ptr<ObjectNode>> old = std::move(objects_);
  objects_.clear();
  for (const geometric::SceneObject& object : scene_->objects) {
    const auto same =
        std::ranges::find_if(old, [&](const auto& node) { return node && node->draws(object); });
    objects_.push_back(same == old.end() ? std::make_unique<ObjectNode>(object) : std::move(*same));
    objects_.back()->place(object.X_PO);
  }
}

void SceneGraph::list_solids() {
  passes_->solid_content->removeAllChildren();
  for (const auto& robot : robots_) {
    passes_->solid_content->addChild(robot->root());
  }
  for (std::size_t i = 0; i < objects_.size(); ++i) {
    if (!scene_->objects[i].hidden) {
      passes_->solid_content->addChild(objects_[i]->root());
    }
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

bool SceneGraph::set_configuration(const Configuration& q) {
  if (!scene_ || robots_.empty()) {
    return false;
  }
  q_ = q;
  robots_.front()->place(scene_->robots.front().X_WB, q);
  place_attached();
  const bool ghosts_changed = update_ghosts();
  return passes_->split->note_motion(*robots_.front()) || ghosts_changed;
}

void SceneGraph::place_attached() {
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
}

bool SceneGraph::update_ghosts() {
  return !robots_.empty() && hide_doubled_links(*robots_.front(), start_, goal_);
}

void SceneGraph::show_ghosts(bool start, bool goal) {
  start_.set_visible(start);
  goal_.set_visible(goal);
  update_ghosts();
}

void SceneGraph::preview_ghost(bool start, const std::optional<Configuration>& q) {
  add_ghost(start ? start_ : goal_, q, start ? kStartColor : kGoalColor);
  update_ghosts();
}

void SceneGraph::set_traces(SoNode* drawing) {
  traces_.clear();
  if (drawing) {
    traces_.show(drawing, [this](SoSeparator* root) { passes_->prepare(root); });
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
  bool changed = false;
  const auto collides = [this](const std::string& body) {
    return std::ranges::find(colliding_, body) != colliding_.end();
  };
  for (std::size_t r = 0; r < robots_.size(); ++r) {
    const std::string& robot = scene_->robots[r].name;
    for (int i = 0; i < robots_[r]->model().link_count(); ++i) {
      const std::string& link = robots_[r]->model().link(i).name;
      const bool collides_now = collides(r == 0 ? link : robot + "/" + link);
      const bool differs = robots_[r]->set_look(i, collides_now ? Look::kColliding : Look::kPlain);
      changed |= differs && !(r == 0 && passes_->split->moves(i));
    }
  }
  for (const auto& object : objects_) {
    changed |= object->set_look(collides(object->name()) ? Look::kColliding : Look::kPlain);
  }
  update_outline();
  return changed;
}

void SceneGraph::update_outline() {
  const SceneItem& item = selection_.item;
  std::vector<SoSeparator*> parts;
  for (std::size_t r = 0; r < robots_.size(); ++r) {
    const bool is_here = item.robot == scene_->robots[r].name;
    if (is_here && item.kind == SceneItem::Kind::kRobot) {
      parts.push_back(robots_[r]->root());
    } else if (const auto link = robots_[r]->model().find_link(item.name);
               is_here && item.kind == SceneItem::Kind::kLink && link) {
      parts.push_back(robots_[r]->link_root(*link));
    }
  }
  for (const auto& object : objects_) {
    if (std::ranges::count(selection_.objects, object->name()) > 0) {
      parts.push_back(object->root());
    }
  }
  outline_.set_parts(parts);
}

void SceneGraph::set_overlay(Overlay overlay, SoNode* drawing) {
  SoSwitch& shown = *passes_->overlays.at(overlay).get();
  shown.removeAllChildren();
  if (drawing) {
    shown.addChild(drawing);
  }
}

void SceneGraph::set_overlay_visible(Overlay overlay, bool visible) {
  passes_->overlays.at(overlay)->whichChild = visible ? SO_SWITCH_ALL : SO_SWITCH_NONE;
}

void SceneGraph::set_floor_visible(bool visible) {
  passes_->floor_content->whichChild = visible ? SO_SWITCH_ALL : SO_SWITCH_NONE;
}

std::vector<Eigen::Vector3d> SceneGraph::points_of_interest() const {
  return scene_ ? gui::points_of_interest(*scene_) : std::vector<Eigen::Vector3d>{};
}

double SceneGraph::task_azimuth() const { return scene_ ? gui::task_azimuth(*scene_) : 0.0; }

void SceneGraph::aim(const OrbitCamera& camera, double aspect) {
  aim_camera(*passes_->camera.get(), camera, aspect);
}

void SceneGraph::render(SoGLRenderAction& action) {
  action.setTransparencyType(SoGLRenderAction::SORTED_OBJECT_BLEND);
  action.apply(passes_->solids.get());
  action.setTransparencyType(SoGLRenderAction::BLEND);
  action.apply(passes_->floor.get());
  start_.render(action);
  goal_.render(action);
  traces_.render(action);
}

void SceneGraph::begin_motion() {
  if (!robots_.empty()) {
    passes_->split->begin(*robots_.front());
  }
}

void SceneGraph::render_still(SoGLRenderAction& action) {
  const auto overlay = [this](Overlay which) { return passes_->overlays.at(which).get(); };
  std::vector<SoNode*> still{overlay(Overlay::kPath), overlay(Overlay::kRoadmap),
                             overlay(Overlay::kTrails), overlay(Overlay::kSteps)};
  std::vector<SoNode*> moving{overlay(Overlay::kExecuted), overlay(Overlay::kContacts),
                              overlay(Overlay::kRegion), overlay(Overlay::kClearance)};
  for (std::size_t r = 1; r < robots_.size(); ++r) {
    still.push_back(robots_[r]->root());
  }
  for (std::size_t i = 0; i < objects_.size(); ++i) {
    const geometric::SceneObject& object = scene_->objects[i];
    if (passes_->solid_content->findChild(objects_[i]->root()) >= 0) {
      const bool apart = object.attachment || object.color.alpha < 1.0F;
      (apart ? moving : still).push_back(objects_[i]->root());
    }
  }
  passes_->split->list(robots_.empty() ? nullptr : robots_.front().get(), still, moving);
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
  std::optional<SceneHit> nearest;
  double least = std::numeric_limits<double>::infinity();
  const auto look_at = [&](SoNode* root, const auto& item_of_path) {
    action.apply(root);
    if (const SoPickedPoint* picked = action.getPickedPoint()) {
      const SbVec3f& p = picked->getPoint();
      const Eigen::Vector3d point(p[0], p[1], p[2]);
      const double distance = (p - passes_->camera->position.getValue()).length();
      if (distance < least) {
        least = distance;
        nearest = SceneHit{item_of_path(*picked->getPath()), point};
      }
    }
  };
  look_at(passes_->solids.get(), [this](const SoPath& path) { return item_of(path); });
  for (const auto& [ghost, kind] :
       {std::pair(&start_, SceneItem::Kind::kStart), std::pair(&goal_, SceneItem::Kind::kGoal)}) {
    if (ghost->is_visible()) {
      look_at(ghost->root(), [kind = kind](const SoPath&) { return SceneItem{kind, "", ""}; });
    }
  }
  return nearest;
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
