#include "handway/geometric/scene/scene.h"

#include <algorithm>

namespace handway::geometric {
namespace {

template <typename Items>
auto find_named(const Items& items, std::string_view name) -> decltype(items.data()) {
  const auto found = std::ranges::find_if(items, [&](const auto& i) { return i.name == name; });
  return found == items.end() ? nullptr : &*found;
}

}  // namespace

const RobotInstance* find_robot(const Scene& scene, std::string_view name) {
  return find_named(scene.robots, name);
}

const SceneObject* find_object(const Scene& scene, std::string_view name) {
  return find_named(scene.objects, name);
}

}  // namespace handway::geometric
