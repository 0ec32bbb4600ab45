#include "replanning/scene_changes.h"

namespace handway::planning {

int SceneChanges::last_change(const std::string& object) const {
  const auto found = last_change_.find(object);
  return found == last_change_.end() ? 0 : found->second;
}

std::vector<int> SceneChanges::pairs_changed_since(int revision,
                                                   const geometric::CollisionWorld& world) const {
  std::vector<int> pairs;
  for (const auto& [object, change] : last_change_) {
    if (change > revision) {
      const std::vector<int> own = world.pairs_with(object);
      pairs.insert(pairs.end(), own.begin(), own.end());
    }
  }
  return pairs;
}

}  // namespace handway::planning
