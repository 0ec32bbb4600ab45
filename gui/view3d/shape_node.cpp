#include "view3d/shape_node.h"

#include "handway/geometric/mesh/point_cloud.h"
#include "model/meshes/crease_normals.h"
#include "model/meshes/drawn_mesh.h"
#include "model/meshes/shaded_meshes.h"
#include "view3d/coin_conversions.h"

#include <Inventor/nodes/SoComplexity.h>
#include <Inventor/nodes/SoCone.h>
#include <Inventor/nodes/SoCube.h>
#include <Inventor/nodes/SoCylinder.h>
#include <Inventor/nodes/SoDrawStyle.h>
#include <Inventor/nodes/SoIndexedFaceSet.h>
#include <Inventor/nodes/SoLevelOfDetail.h>
#include <Inventor/nodes/SoLightModel.h>
#include <Inventor/nodes/SoMaterial.h>
#include <Inventor/nodes/SoPointSet.h>
#include <Inventor/nodes/SoRotationXYZ.h>
#include <Inventor/nodes/SoSeparator.h>
#include <Inventor/nodes/SoShapeHints.h>
#include <Inventor/nodes/SoSphere.h>
#include <Inventor/nodes/SoVertexProperty.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>

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

/// Colours of points: their own, or greys that are lighter the higher a point is, so that shapes
/// can be told apart.
class PointColors {
 public:
  explicit PointColors(const geometric::PointCloud& cloud) : cloud_(cloud) {
    for (const Eigen::Vector3f& point : cloud.points) {
      lowest_ = std::min(lowest_, point.z());
      highest_ = std::max(highest_, point.z());
    }
  }

  [[nodiscard]] std::uint32_t rgba(std::size_t point) const {
    if (!cloud_.colors.empty()) {
      const auto& [red, green, blue] = cloud_.colors[point];
      return packed(red, green, blue);
    }
    const float height = (cloud_.points[point].z() - lowest_) / std::max(highest_ - lowest_, 1e-6F);
    const auto grey = static_cast<std::uint8_t>(70.0F + 130.0F * height);
    return packed(grey, grey, static_cast<std::uint8_t>(grey + 25));
  }

 private:
  static std::uint32_t packed(std::uint8_t red, std::uint8_t green, std::uint8_t blue) {
    return static_cast<std::uint32_t>(red) << 24U | static_cast<std::uint32_t>(green) << 16U |
           static_cast<std::uint32_t>(blue) << 8U | 0xFFU;
  }

  const geometric::PointCloud& cloud_;
  float lowest_ = std::numeric_limits<float>::max();
  float highest_ = std::numeric_limits<float>::lowest();
};

// If there are very many points, an evenly chosen part of them is drawn.
void add_points(SoSeparator* parent, const geometric::PointCloud& cloud) {
  constexpr std::size_t kMostDrawn = 250'000;
  const std::size_t every = cloud.size() / kMostDrawn + 1;
  const auto count = static_cast<int>((cloud.size() + every - 1) / every);
  const PointColors colors(cloud);
  auto* properties = new SoVertexProperty;
  properties->vertex.setNum(count);
  properties->orderedRGBA.setNum(count);
  SbVec3f* place = properties->vertex.startEditing();
  std::uint32_t* color = properties->orderedRGBA.startEditing();
  for (std::size_t i = 0; i < cloud.size(); i += every) {
    const Eigen::Vector3f& p = cloud.points[i];
    *place++ = SbVec3f(p.x(), p.y(), p.z());
    *color++ = colors.rgba(i);
  }
  properties->vertex.finishEditing();
  properties->orderedRGBA.finishEditing();
  properties->materialBinding = SoVertexProperty::PER_VERTEX;

  auto* light = new SoLightModel;
  light->model = SoLightModel::BASE_COLOR;
  parent->addChild(light);
  auto* style = new SoDrawStyle;
  style->pointSize = 3.0F;
  parent->addChild(style);
  auto* points = new SoPointSet;
  points->vertexProperty = properties;
  parent->addChild(points);
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
  void operator()(const geometric::Cloud& cloud) const { add_points(parent, *cloud.points); }
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

namespace {

/// Reflection of the lamps by a surface.
struct Finish {
  float specular;
  float shininess;
};

/// Files have colours and no finishes: dark greys are taken for rubber, other greys for brushed
/// metal, browns for wood, and all else for paint.
Finish finish_of(const geometric::Color& color) {
  constexpr Finish kRubber{0.10F, 0.12F}, kMetal{0.34F, 0.30F}, kWood{0.05F, 0.10F},
      kPaint{0.22F, 0.35F};
  const auto [least, most] = std::minmax({color.red, color.green, color.blue});
  const float saturation = most > 0.0F ? (most - least) / most : 0.0F;
  if (saturation < 0.18F) {
    return most < 0.35F ? kRubber : kMetal;
  }
  const bool is_brown = color.red >= color.green && color.green >= color.blue &&
                        color.green > 0.6F * color.red && saturation < 0.65F;
  return is_brown ? kWood : kPaint;
}

}  // namespace

CoinRef<SoMaterial> make_material(const geometric::Color& color) {
  auto material = make_coin<SoMaterial>();
  const SbColor diffuse = to_coin(color);
  material->diffuseColor = diffuse;
  material->ambientColor = diffuse;
  const Finish finish = finish_of(color);
  material->specularColor = SbColor(finish.specular, finish.specular, finish.specular);
  material->shininess = finish.shininess;
  material->transparency = 1.0F - color.alpha;
  return material;
}

}  // namespace handway::gui
