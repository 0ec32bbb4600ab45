#include "view3d/scene_graph.h"

#include "model/settings/orbit_camera.h"
#include "view3d/coin_camera.h"
#include "view3d/coin_conversions.h"
#include "view3d/floor_grid.h"
#include "view3d/orientation_cube.h"
#include "view3d/scene_passes.h"

#include <Inventor/SoPath.h>
#include <Inventor/SoPickedPoint.h>
#include <Inventor/actions/SoGLRenderAction.h>
#include <Inventor/actions/SoGetBoundingBoxAction.h>
#include <Inventor/actions/SoRayPickAction.h>
#include <Inventor/nodes/SoOrthographicCamera.h>
#include <Inventor/nodes/SoPerspectiveCamera.h>
#include <Inventor/nodes/SoSeparator.h>
#include <Inventor/nodes/SoSwitch.h>

#include <GL/gl.h>

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

namespace handway::gui {
namespace {

using geometric::Configuration;
using geometric::Pose;

constexpr double kVeilDepth = 0.06;  // m: a ghost that is no farther before an object is part of it
constexpr double kFloorRadius = 2.5;  // m

}  // namespace

SceneGraph::SceneGraph() : passes_(std::make_unique<ScenePasses>()) {
  passes_->gizmo->addChild(gizmo_.root());
  for (const BodyOutline* outline : {&outline_, &colliding_outline_}) {
    outline->root()->insertChild(passes_->camera.get(), 0);
    outline->root()->insertChild(passes_->detail.get(), 0);
  }
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

void SceneGraph::update_scene(const planning::SceneState& state) {
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

Eigen::Vector3d SceneGraph::floor_centre() const {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  if (bodies_.scene() && !bodies_.scene()->robots.empty()) {
    centre = bodies_.scene()->robots.front().X_WB.translation();
    centre.z() = std::min(0.0, lowest_point(*bodies_.scene()));
  }
  return centre;
}

void SceneGraph::rebuild_floor() {
  floor_centre_ = floor_centre();
  passes_->floor_content->removeAllChildren();
  passes_->floor_content->addChild(
      make_floor_grid(floor_centre_, kFloorRadius, colors_.grid).get());
}

std::optional<FloorDisc> SceneGraph::floor_disc() const {
  const bool is_shown =
      bodies_.scene() && passes_->floor_content->whichChild.getValue() == SO_SWITCH_ALL;
  return is_shown ? std::optional(FloorDisc{floor_centre_, kFloorRadius}) : std::nullopt;
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
  colliding_outline_.set_parts(bodies_.outlined(painted));
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

std::vector<Eigen::Vector3d> SceneGraph::all_points() const {
  return bodies_.scene() ? gui::all_points(*bodies_.scene()) : std::vector<Eigen::Vector3d>{};
}

OpeningView SceneGraph::open_view(const OrbitCamera& camera, double aspect) const {
  return bodies_.scene() ? gui::open_view(*bodies_.scene(), camera, aspect) : OpeningView{camera};
}

std::vector<Eigen::Vector3d> SceneGraph::selected_points() const {
  std::vector<Eigen::Vector3d> points;
  for (SoSeparator* part : bodies_.parts_of(selection_)) {
    SoGetBoundingBoxAction around{SbViewportRegion()};
    around.apply(part);
    const SbBox3f box = around.getBoundingBox();
    if (!box.isEmpty()) {
      const SbVec3f &low = box.getMin(), &high = box.getMax();
      for (int corner = 0; corner < 8; ++corner) {
        points.emplace_back(((corner & 1) ? high : low)[0], ((corner & 2) ? high : low)[1],
                            ((corner & 4) ? high : low)[2]);
      }
    }
  }
  return points;
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

void SceneGraph::render_bodies(SoGLRenderAction& action) {
  action.setTransparencyType(SoGLRenderAction::SORTED_OBJECT_BLEND);
  action.apply(passes_->solids.get());
}

void SceneGraph::render_drawings(SoGLRenderAction& action) {
  action.setTransparencyType(SoGLRenderAction::SORTED_OBJECT_BLEND);
  action.apply(passes_->drawings.get());
  action.setTransparencyType(SoGLRenderAction::BLEND);
  action.apply(passes_->floor.get());
}

void SceneGraph::render_ghosts(SoGLRenderAction& action) {
  for (const Ghost* ghost : ghosts()) {
    ghost->render(action);
  }
}

void SceneGraph::list_shadow_casters(bool only_still) {
  passes_->shadow_casters->removeAllChildren();
  for (SoNode* node : only_still ? passes_->split->still_bodies() : bodies_.opaque()) {
    passes_->shadow_casters->addChild(node);
  }
}

LampView SceneGraph::view_from(const Lamp& lamp) const {
  SoGetBoundingBoxAction around{SbViewportRegion()};
  around.apply(passes_->shadow_casters.get());
  const SbBox3f all = around.getBoundingBox();
  const Eigen::Vector3d half = Eigen::Vector3d::Constant(lamp.radius);
  Eigen::AlignedBox3d box(lamp.near_by - half, lamp.near_by + half);
  if (!all.isEmpty()) {
    const SbVec3f &low = all.getMin(), &high = all.getMax();
    box.clamp(Eigen::AlignedBox3d(Eigen::Vector3d(low[0], low[1], low[2]),
                                  Eigen::Vector3d(high[0], high[1], high[2])));
  }
  if (floor_disc() && !box.isEmpty()) {
    box.min().z() = std::min(box.min().z(), floor_centre_.z());
  }
  LampView view;
  view.R_WL = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), lamp.to_lamp).matrix();
  view.centre = box.isEmpty() ? lamp.near_by : Eigen::Vector3d(box.center());
  view.width = view.depth = box.isEmpty() ? 2.0 * lamp.radius : box.diagonal().norm();
  return view;
}

LampView SceneGraph::render_for_lamp(SoGLRenderAction& action, const Lamp& lamp, int pixels) {
  list_shadow_casters(lamp.only_still);
  const LampView view = view_from(lamp);
  SoOrthographicCamera& eye = *passes_->lamp.get();
  eye.viewportMapping = SoCamera::LEAVE_ALONE;
  eye.aspectRatio = 1.0F;
  eye.orientation = to_coin_rotation(view.R_WL);
  set_range(eye, {view.centre + 1.5 * view.depth * view.R_WL.col(2), view.depth, 2.0 * view.depth});
  eye.height = static_cast<float>(view.width);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LEQUAL);
  glDepthMask(GL_TRUE);
  glClear(GL_DEPTH_BUFFER_BIT);
  action.invalidateState();
  action.setViewportRegion({static_cast<short>(pixels), static_cast<short>(pixels)});
  action.setTransparencyType(SoGLRenderAction::NONE);
  action.apply(passes_->lamp_view.get());
  return view;
}

void SceneGraph::begin_motion() {
  if (bodies_.has_robot()) {
    passes_->split->begin(bodies_.first_robot());
  }
}

void SceneGraph::render_still_bodies(SoGLRenderAction& action) {
  auto [still, moving] = bodies_.others();
  for (const auto& [overlay, shown] : passes_->overlays) {
    if (std::ranges::find(kStillOverlays, overlay) == kStillOverlays.end()) {
      moving.push_back(shown.get());
    }
  }
  passes_->split->list(bodies_.has_robot() ? &bodies_.first_robot() : nullptr, still, moving);
  action.setTransparencyType(SoGLRenderAction::SORTED_OBJECT_BLEND);
  action.apply(passes_->split->still());
}

void SceneGraph::render_still_drawings(SoGLRenderAction& action) {
  action.setTransparencyType(SoGLRenderAction::SORTED_OBJECT_BLEND);
  action.apply(passes_->still_drawings.get());
  action.setTransparencyType(SoGLRenderAction::BLEND);
  action.apply(passes_->floor.get());
}

void SceneGraph::render_moving(SoGLRenderAction& action) {
  action.setTransparencyType(SoGLRenderAction::SORTED_OBJECT_BLEND);
  action.apply(passes_->split->moving());
}

SoNode& SceneGraph::moving_root() const { return *passes_->split->moving(); }

void SceneGraph::render_marks(SoGLRenderAction& action, bool with_gizmo, float pixel_ratio) {
  colliding_outline_.render(action, 4.0F * pixel_ratio);
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

bool SceneGraph::stand_in_world(const std::vector<std::string>& objects) const {
  return bodies_.scene() && !objects.empty() &&
         std::ranges::all_of(objects, [&](const std::string& name) {
           const geometric::SceneObject* object = find_object(*bodies_.scene(), name);
           return object != nullptr && !object->attachment;
         });
}

std::optional<SceneGraph::Surface> SceneGraph::surface_behind(
    const SbVec2s& viewport, const SbVec2s& pixel, const std::vector<std::string>& ignored) {
  auto root = make_coin<SoSeparator>();
  passes_->prepare(root.get());
  for (SoNode* node : bodies_.objects_without(ignored)) {
    root->addChild(node);
  }
  SoRayPickAction action{SbViewportRegion(viewport)};
  action.setPoint(pixel);
  action.apply(root.get());
  const SoPickedPoint* picked = action.getPickedPoint();
  if (picked == nullptr) {
    return std::nullopt;
  }
  const SbVec3f &p = picked->getPoint(), &n = picked->getNormal();
  return Surface{{p[0], p[1], p[2]}, {n[0], n[1], n[2]}};
}

Eigen::Vector3d SceneGraph::top_at(double x, double y) {
  constexpr float kAboveAll = 100.0F;  // m
  auto root = make_coin<SoSeparator>();
  for (SoNode* node : bodies_.objects_without({})) {
    root->addChild(node);
  }
  SoRayPickAction action{SbViewportRegion()};
  action.setRay({static_cast<float>(x), static_cast<float>(y), kAboveAll}, {0.0F, 0.0F, -1.0F});
  action.apply(root.get());
  const SoPickedPoint* picked = action.getPickedPoint();
  return {x, y, picked ? std::max(0.0F, picked->getPoint()[2]) : 0.0};
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
