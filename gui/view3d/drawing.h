#pragma once

#include "view3d/coin_conversions.h"

#include <cstddef>
#include <utility>

class SoNode;

namespace handway::gui {

/// Something to draw, in an interface without Coin.
class Drawing {
 public:
  // A drawing can be made of nothing, or of a node of a known kind.
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

  /// Returns the node, or null.
  [[nodiscard]] SoNode* node() const { return node_; }

 private:
  SoNode* node_ = nullptr;
};

}  // namespace handway::gui
