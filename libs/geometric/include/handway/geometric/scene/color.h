#pragma once

namespace handway::geometric {

/// Linear RGB and opacity, each in [0, 1].
struct Color {
  float red = 0.7F;
  float green = 0.7F;
  float blue = 0.7F;
  float alpha = 1.0F;

  friend bool operator==(const Color&, const Color&) = default;
};

}  // namespace handway::geometric
