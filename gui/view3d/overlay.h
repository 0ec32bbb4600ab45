#pragma once

#include "handway/geometric/robot/robot_model.h"
#include "view3d/coin_ref.h"

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

class SoNode;

namespace handway::gui {

/// How far a search that found no path came, in the robot's configurations.
struct Frontier {
  geometric::Configuration from_start;
  geometric::Configuration from_goal;
  /// The bodies that collided most, names as in CollisionWorld.
  std::vector<std::string> colliding;
};

/// Something to draw, for those who need not know Coin.
class Drawing {
 public:
  // Nothing, or a node of a known kind, is a drawing as it is.
  // NOLINTBEGIN(google-explicit-constructor)
  Drawing(std::nullptr_t = nullptr) {}
  template <typename Node>
  Drawing(const CoinRef<Node>& node) : Drawing(node.get()) {}
  // NOLINTEND(google-explicit-constructor)
  explicit Drawing(SoNode* node);
  Drawing(const Drawing& other) : Drawing(other.node_) {}
  Drawing(Drawing&& other) noexcept : node_(std::exchange(other.node_, nullptr)) {}
  Drawing& operator=(Drawing other) noexcept {
    std::swap(node_, other.node_);
    return *this;
  }
  ~Drawing();

  /// Null: nothing.
  [[nodiscard]] SoNode* node() const { return node_; }

 private:
  SoNode* node_ = nullptr;
};

/// What is drawn into the scene without being part of it.
enum class Overlay {
  kPath,
  kRoadmap,
  kRegion,
  kExecuted,
  kOptimized,
  kContacts,
  kClearance,
  kTrails,
  kSteps,
  kHypercubes,
  kConstraints,
};

}  // namespace handway::gui
