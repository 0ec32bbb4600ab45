#include "model/meshes/shaded_meshes.h"

#include <map>
#include <mutex>
#include <utility>

namespace handway::gui {
namespace {

class Shop {
 public:
  std::shared_ptr<const DrawnMesh> find(
      const std::shared_ptr<const geometric::TriangleMesh>& mesh) {
    const std::lock_guard lock(mutex_);
    const auto found = made_.find(mesh);
    return found == made_.end() ? nullptr : found->second;
  }

  void keep(const std::shared_ptr<const geometric::TriangleMesh>& mesh,
            std::shared_ptr<const DrawnMesh> shaded) {
    const std::lock_guard lock(mutex_);
    std::erase_if(made_, [](const auto& entry) { return entry.first.expired(); });
    made_.emplace(mesh, std::move(shaded));
  }

 private:
  std::mutex mutex_;
  std::map<std::weak_ptr<const geometric::TriangleMesh>, std::shared_ptr<const DrawnMesh>,
           std::owner_less<>>
      made_;
};

Shop& shop() {
  static Shop shop;
  return shop;
}

}  // namespace

std::shared_ptr<const DrawnMesh> shaded(
    const std::shared_ptr<const geometric::TriangleMesh>& mesh) {
  if (auto known = shop().find(mesh)) {
    return known;
  }
  auto made = std::make_shared<const DrawnMesh>(prepare_to_draw(*mesh));
  shop().keep(mesh, made);
  return made;
}

void shade_meshes(const geometric::Scene& scene) {
  const auto shade = [](const geometric::Shape& shape) {
    if (const auto* mesh = std::get_if<geometric::Mesh>(&shape); mesh && mesh->triangles) {
      static_cast<void>(shaded(mesh->triangles));
    }
  };
  for (const geometric::RobotInstance& robot : scene.robots) {
    for (int link = 0; link < robot.model->link_count(); ++link) {
      for (const geometric::LinkGeometry& geometry : shown_geometry(robot.model->link(link))) {
        shade(geometry.shape);
      }
    }
  }
  for (const geometric::SceneObject& object : scene.objects) {
    shade(object.shape);
  }
}

}  // namespace handway::gui
