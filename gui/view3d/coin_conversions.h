#pragma once

#include "handway/geometric/math/pose.h"
#include "handway/geometric/mesh/shape.h"

#include <Inventor/SbColor.h>
#include <Inventor/SbMatrix.h>
#include <Inventor/SbRotation.h>
#include <Inventor/SbVec3f.h>
#include <Inventor/SbViewportRegion.h>
#include <QSize>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace handway::gui {

/// Shared ownership of a Coin node through its own reference count.
template <typename Node>
class CoinRef {
 public:
  CoinRef() = default;
  explicit CoinRef(Node* node) : node_(node) {
    if (node_) {
      node_->ref();
    }
  }
  CoinRef(const CoinRef& other) : CoinRef(other.node_) {}
  CoinRef(CoinRef&& other) noexcept : node_(std::exchange(other.node_, nullptr)) {}
  CoinRef& operator=(CoinRef other) noexcept {
    std::swap(node_, other.node_);
    return *this;
  }
  ~CoinRef() {
    if (node_) {
      node_->unref();
    }
  }

  [[nodiscard]] Node* get() const { return node_; }
  Node* operator->() const { return node_; }
  explicit operator bool() const { return node_ != nullptr; }

 private:
  Node* node_ = nullptr;
};

template <typename Node, typename... Arguments>
[[nodiscard]] CoinRef<Node> make_coin(Arguments&&... arguments) {
  return CoinRef<Node>(new Node(std::forward<Arguments>(arguments)...));
}

[[nodiscard]] inline SbVec3f to_coin(const Eigen::Vector3d& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

[[nodiscard]] inline SbColor to_coin(const geometric::Color& color) {
  return {color.red, color.green, color.blue};
}

/// Coin multiplies row vectors from the left: the transpose of X.
[[nodiscard]] inline SbMatrix to_coin(const geometric::Pose& X) {
  const Eigen::Matrix4f m = X.matrix().cast<float>();
  SbMatrix result;
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) {
      result[row][column] = m(column, row);
    }
  }
  return result;
}

[[nodiscard]] inline SbRotation to_coin_rotation(const Eigen::Matrix3d& R) {
  SbMatrix turned = SbMatrix::identity();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      turned[row][column] = static_cast<float>(R(column, row));
    }
  }
  return SbRotation(turned);
}

/// 0xRRGGBBAA, as SoVertexProperty::orderedRGBA wants it.
[[nodiscard]] inline std::uint32_t packed_rgba(const geometric::Color& color) {
  const auto byte = [](float value) {
    return static_cast<std::uint32_t>(std::lround(std::clamp(value, 0.0F, 1.0F) * 255.0F));
  };
  return byte(color.red) << 24 | byte(color.green) << 16 | byte(color.blue) << 8 |
         byte(color.alpha);
}

/// Returns a viewport over a picture of that size, px.
[[nodiscard]] inline SbViewportRegion viewport_of(const QSize& pixels) {
  return {static_cast<short>(pixels.width()), static_cast<short>(pixels.height())};
}

}  // namespace handway::gui
