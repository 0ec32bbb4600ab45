#pragma once

#include <Eigen/Core>

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace handway::geometric {

/// Display settings of an object.
struct ObjectDisplay {
  bool hidden = false;     ///< Not drawn; it still counts in planning.
  bool locked = false;     ///< The user can't change it.
  std::string group = {};  ///< Objects with the same word are moved together; empty: none.

  friend bool operator==(const ObjectDisplay&, const ObjectDisplay&) = default;
};

/// Camera position, under a name that no other view of the scene has.
struct SavedView {
  std::string name;
  Eigen::Vector3d target = Eigen::Vector3d::Zero();  ///< Centre of the picture (world, m).
  double distance = 1.0;                             ///< Distance to the camera, m; above 0.
  double azimuth = 0.0;    ///< Direction to the camera about +z from +x, rad.
  double elevation = 0.0;  ///< Above the horizon, rad.

  friend bool operator==(const SavedView&, const SavedView&) = default;
};

/// Settings of a scene file for the window alone: planning and collision checking ignore them.
class SceneDisplay {
 public:
  std::vector<SavedView> views;

  /// Settings of the object of that name: as set, or ObjectDisplay{}.
  [[nodiscard]] const ObjectDisplay& of(std::string_view object) const {
    static const ObjectDisplay kUsual;
    const auto found = objects_.find(object);
    return found == objects_.end() ? kUsual : found->second;
  }

  void set(const std::string& object, ObjectDisplay display) {
    if (display == ObjectDisplay{}) {
      objects_.erase(object);
    } else {
      objects_[object] = std::move(display);
    }
  }

  void remove(const std::string& object) { objects_.erase(object); }

 private:
  std::map<std::string, ObjectDisplay, std::less<>> objects_;  ///< By name.
};

}  // namespace handway::geometric
