#include "view3d/robot_node.h"

#include "model/meshes/crease_normals.h"
#include "model/meshes/drawn_mesh.h"
#include "model/meshes/shaded_meshes.h"
#include "view3d/coin_conversions.h"

#include <Inventor/actions/SoGLRenderAction.h>
#include <Inventor/nodes/SoComplexity.h>
#include <Inventor/nodes/SoCone.h>
#include <Inventor/nodes/SoCube.h>
#include <Inventor/nodes/SoCylinder.h>
#include <Inventor/nodes/SoIndexedFaceSet.h>
#include <Inventor/nodes/SoLevelOfDetail.h>
#include <Inventor/nodes/SoMaterial.h>
#include <Inventor/nodes/SoMatrixTransform.h>
#include <Inventor/nodes/SoPolygonOffset.h>
#include <Inventor/nodes/SoRotationXYZ.h>
#include <Inventor/nodes/SoSeparator.h>
#include <Inventor/nodes/SoShapeHints.h>
#include <Inventor/nodes/SoSphere.h>
#include <Inventor/nodes/SoSwitch.h>
#include <Inventor/nodes/SoVertexProperty.h>

#include <GL/gl.h>

#include <algorithm>
#include <numbers>
#include <utility>
#include <vector>

namespace handway::gui {
namespace {

// Coin's round solids stand along y, ours along z.
void add_upright(SoSeparator* parent, SoNode* solid) {
  auto* turn = new SoRotationXYZ;
  turn->axis = SoRotationXYZ::X;
  turn->angle = static_cast<float>(std::numbers::pi / 2.0);
  parent->addChild(turn);
  parent->addChild(solid);
}

SoNode* make_faces(const ShadedMesh& mesh) {
  auto* properties = new SoVertexProperty;
  static_assert(sizeof(Eigen::Vector3f) == sizeof(SbVec3f));
  const auto count = static_cast<int>(mesh.vertices.size());
  properties->vertex.setValues(0, count, reinterpret_cast<const float(*)[3]>(mesh.vertices.data()));
  properties->normal.setValues(0, count, reinterpret_cast<const float(*)[3]>(mesh.normals.data()));
  properties->normalBinding = SoVertexProperty::PER_VERTEX_INDEXED;

  auto* faces = new SoIndexedFaceSet;
  faces->vertexProperty = properties;
  faces->coordIndex.setNum(static_cast<int>(4 * mesh.triangles.size()));
  std::int32_t* index = faces->coordIndex.startEditing();
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t corner : triangle) {
      *index++ = static_cast<std::int32_t>(corner);
    }
    *index++ = SO_END_FACE_INDEX;
  }
  faces->coordIndex.finishEditing();
  return faces;
}

void add_mesh(SoSeparator* parent, const DrawnMesh& mesh) {
  auto* hints = new SoShapeHints;
  hints->vertexOrdering = SoShapeHints::COUNTERCLOCKWISE;  // lit on both sides,
  hints->shapeType = mesh.is_solid ? SoShapeHints::SOLID   // unless the other one can't be seen
                                   : SoShapeHints::UNKNOWN_SHAPE_TYPE;
  parent->addChild(hints);
  auto* levels = new SoLevelOfDetail;
  levels->addChild(make_faces(mesh.fine));
  for (std::size_t i = 0; i < mesh.coarser.size(); ++i) {
    levels->screenArea.set1Value(static_cast<int>(i), mesh.coarser[i].most_area);
    levels->addChild(make_faces(mesh.coarser[i].mesh));
  }
  parent->addChild(levels);
}

struct AddShape {
  SoSeparator* parent;

  void operator()(const geometric::Box& box) const {
    auto* cube = new SoCube;
    cube->width = static_cast<float>(box.size.x());
    cube->height = static_cast<float>(box.size.y());
    cube->depth = static_cast<float>(box.size.z());
    parent->addChild(cube);
  }
  void operator()(const geometric::Sphere& sphere) const {
    auto* ball = new SoSphere;
    ball->radius = static_cast<float>(sphere.radius);
    parent->addChild(ball);
  }
  void operator()(const geometric::Cylinder& cylinder) const {
    auto* solid = new SoCylinder;
    solid->radius = static_cast<float>(cylinder.radius);
    solid->height = static_cast<float>(cylinder.length);
    add_upright(parent, solid);
  }
  void operator()(const geometric::Cone& cone) const {
    auto* solid = new SoCone;
    solid->bottomRadius = static_cast<float>(cone.radius);
    solid->height = static_cast<float>(cone.length);
    add_upright(parent, solid);
  }
  void operator()(const geometric::Mesh& mesh) const {
    if (mesh.triangles && !mesh.triangles->empty()) {
      add_mesh(parent, *shaded(mesh.triangles));
    }
  }
};

}  // namespace

CoinRef<SoSeparator> make_shape_node(const geometric::Shape& shape) {
  auto separator = make_coin<SoSeparator>();
  separator->renderCaching = SoSeparator::OFF;
  if (!std::holds_alternative<geometric::Mesh>(shape)) {
    auto* complexity = new SoComplexity;
    complexity->value = 0.9F;
    separator->addChild(complexity);
  }
  std::visit(AddShape{separator.get()}, shape);
  return separator;
}

CoinRef<SoMaterial> make_material(const geometric::Color& color) {
  auto material = make_coin<SoMaterial>();
  const SbColor diffuse = to_coin(color);
  material->diffuseColor = diffuse;
  material->ambientColor = diffuse;
  material->specularColor = SbColor(0.22F, 0.22F, 0.22F);
  material->shininess = 0.35F;
  material->transparency = 1.0F - color.alpha;
  return material;
}

namespace {

constexpr double kApart = 1e-3;

}  // namespace

void Ghost::clear() {
  robot_.reset();
  root_ = {};
}

void Ghost::show(const geometric::RobotInstance& robot, const geometric::Configuration& q,
                 const LinkShapes& shapes, const geometric::Color& color, const Prepare& prepare) {
  if (!robot_) {
    geometric::Color faint = color;
    faint.alpha = opacity_;
    robot_ = std::make_unique<RobotNode>(robot.model, shapes, faint);
    show(robot_->root(), prepare);
  }
  robot_->place(robot.X_WB, q);
}

void Ghost::show(SoNode* drawing, const Prepare& prepare) {
  root_ = make_coin<SoSeparator>();
  prepare(root_.get());
  auto* behind = new SoPolygonOffset;  // does not flicker with the robot where both coincide
  behind->factor = 2.0F;
  behind->units = 60.0F;
  root_->addChild(behind);
  root_->addChild(drawing);
}

// First the depth alone, then the colour of what is in front: a ghost is one
// even veil, however many surfaces lie behind each other.
void Ghost::render(SoGLRenderAction& action) const {
  if (!is_visible()) {
    return;
  }
  glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  action.setTransparencyType(SoGLRenderAction::NONE);
  action.apply(root_.get());
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_FALSE);
  action.setTransparencyType(SoGLRenderAction::BLEND);
  action.apply(root_.get());
}

void Ghost::render_opaque(SoGLRenderAction& action) const {
  if (is_visible()) {
    action.setTransparencyType(SoGLRenderAction::NONE);
    action.apply(root_.get());
  }
}

bool hide_doubled_links(const RobotNode& robot, std::span<const Ghost* const> ghosts) {
  bool changed = false;
  std::vector<const RobotNode*> before{&robot};
  for (const Ghost* ghost : ghosts) {
    if (!ghost->robot()) {
      continue;
    }
    const auto poses = ghost->robot()->link_poses();
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const bool doubled = std::ranges::any_of(before, [&](const RobotNode* other) {
        return poses[i].isApprox(other->link_poses()[i], kApart);
      });
      changed |= ghost->robot()->set_link_visible(static_cast<int>(i), !doubled);
    }
    if (ghost->is_visible()) {
      before.push_back(ghost->robot());
    }
  }
  return changed;
}

BodyShape::BodyShape(const CoinRef<SoSeparator>& looks, const geometric::Color& color)
    : color_(color), root_(make_coin<SoSeparator>()), drawings_(make_coin<SoSwitch>()) {
  root_->renderCaching = SoSeparator::OFF;
  root_->addChild(drawings_.get());
  drawings_->addChild(looks.get());
  drawings_->whichChild = 0;
}

void BodyShape::stand_in(const std::shared_ptr<const geometric::TriangleMesh>& mesh) const {
  while (drawings_->getNumChildren() > 1) {
    drawings_->removeChild(1);
  }
  if (mesh) {
    auto drawing = make_coin<SoSeparator>();
    drawing->renderCaching = SoSeparator::OFF;
    drawing->addChild(make_material(color_).get());
    drawing->addChild(make_shape_node(geometric::Mesh{{}, Eigen::Vector3d::Ones(), mesh}).get());
    drawings_->addChild(drawing.get());
  }
  drawings_->whichChild = mesh ? 1 : 0;
}

namespace {

CoinRef<SoMaterial> overriding(const geometric::Color& color, float glow) {
  CoinRef<SoMaterial> material = make_material(color);
  const SbColor diffuse = to_coin(color);
  material->emissiveColor = SbColor(diffuse[0] * glow, diffuse[1] * glow, diffuse[2] * glow);
  material->setOverride(TRUE);
  return material;
}

CoinRef<SoSeparator> make_geometry_node(const geometric::LinkGeometry& geometry) {
  auto separator = make_coin<SoSeparator>();
  separator->renderCaching = SoSeparator::OFF;
  auto* transform = new SoMatrixTransform;
  transform->matrix = to_coin(geometry.X_LG);
  separator->addChild(transform);
  separator->addChild(make_material(geometry.color).get());
  separator->addChild(make_shape_node(geometry.shape).get());
  return separator;
}

constexpr geometric::Color kColliding{0.86F, 0.13F, 0.11F, 1.0F};
constexpr geometric::Color kCollidingRed{0.98F, 0.80F, 0.05F, 1.0F};  // of what is red already

}  // namespace

CoinRef<SoMaterial> make_look_material(Look look, const geometric::Color& plain) {
  switch (look) {
    case Look::kColliding: {
      const bool is_red = plain.red > 0.5F && plain.green < 0.4F && plain.blue < 0.4F;
      return overriding(is_red ? kCollidingRed : kColliding, 0.25F);
    }
    case Look::kPlain:
      break;
  }
  return {};
}

LinkShapes make_link_shapes(const geometric::RobotModel& model) {
  LinkShapes shapes;
  for (int i = 0; i < model.link_count(); ++i) {
    const geometric::Link& link = model.link(i);
    auto separator = make_coin<SoSeparator>();
    separator->renderCaching = SoSeparator::OFF;
    const std::vector<geometric::LinkGeometry>& shown = shown_geometry(link);
    for (const geometric::LinkGeometry& geometry : shown) {
      separator->addChild(make_geometry_node(geometry).get());
    }
    shapes.emplace_back(separator, shown.empty() ? geometric::Color() : shown.front().color);
  }
  return shapes;
}

RobotNode::RobotNode(std::shared_ptr<const geometric::RobotModel> model, const LinkShapes& shapes,
                     std::optional<geometric::Color> ghost)
    : model_(std::move(model)),
      root_(make_coin<SoSeparator>()),
      plain_(ghost ? 0 : SO_SWITCH_NONE),
      X_WL_(static_cast<std::size_t>(model_->link_count()), geometric::Pose::Identity()) {
  root_->renderCaching = SoSeparator::OFF;
  for (const BodyShape& shape : shapes) {
    LinkNode node{make_coin<SoSwitch>(), make_coin<SoSeparator>(), make_coin<SoMatrixTransform>(),
                  make_coin<SoSwitch>()};
    node.visible->whichChild = SO_SWITCH_ALL;
    node.separator->renderCaching = SoSeparator::OFF;
    node.separator->addChild(node.transform.get());
    const CoinRef<SoMaterial> colliding = make_look_material(Look::kColliding);
    if (ghost) {
      node.look->addChild(overriding(*ghost, 0.15F).get());
      colliding->transparency = 1.0F - ghost->alpha;
    }
    node.look->addChild(colliding.get());
    node.look->whichChild = plain_;
    node.separator->addChild(node.look.get());
    node.separator->addChild(shape.get());
    node.visible->addChild(node.separator.get());
    root_->addChild(node.visible.get());
    links_.push_back(std::move(node));
  }
}

RobotNode::~RobotNode() = default;

void RobotNode::place(const geometric::Pose& X_WB, const geometric::Configuration& q) {
  model_->forward_kinematics(q, X_WL_);
  for (std::size_t i = 0; i < links_.size(); ++i) {
    X_WL_[i] = X_WB * X_WL_[i];
    links_[i].transform->matrix = to_coin(X_WL_[i]);
  }
}

void RobotNode::move_from(int link, const geometric::Pose& X_WL) {
  const geometric::Pose motion = X_WL * X_WL_[static_cast<std::size_t>(link)].inverse();
  std::vector<bool> moves(links_.size(), false);
  for (std::size_t i = static_cast<std::size_t>(link); i < links_.size(); ++i) {
    const int parent = model_->parent(static_cast<int>(i));
    moves[i] =
        static_cast<int>(i) == link || (parent >= 0 && moves[static_cast<std::size_t>(parent)]);
    if (moves[i]) {
      X_WL_[i] = motion * X_WL_[i];
      links_[i].transform->matrix = to_coin(X_WL_[i]);
    }
  }
}

bool RobotNode::set_look(int link, Look look) {
  const int child = look == Look::kPlain ? plain_ : plain_ + 1;
  SoSwitch& node = *links_[static_cast<std::size_t>(link)].look.get();
  if (node.whichChild.getValue() == child) {
    return false;
  }
  node.whichChild = child;
  return true;
}

bool RobotNode::set_link_visible(int link, bool visible) {
  SoSwitch& node = *links_[static_cast<std::size_t>(link)].visible.get();
  const int child = visible ? SO_SWITCH_ALL : SO_SWITCH_NONE;
  if (node.whichChild.getValue() == child) {
    return false;
  }
  node.whichChild = child;
  return true;
}

std::optional<int> RobotNode::find_link(const SoNode* node) const {
  const auto found = std::ranges::find_if(
      links_, [&](const LinkNode& link) { return link.separator.get() == node; });
  return found == links_.end() ? std::nullopt
                               : std::optional(static_cast<int>(found - links_.begin()));
}

}  // namespace handway::gui
