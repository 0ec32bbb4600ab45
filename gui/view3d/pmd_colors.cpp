#include "view3d/pmd_colors.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace handway::gui {
namespace {

constexpr std::array<geometric::Color, 6> kScale{{{0.16F, 0.40F, 0.78F, 1.0F},
                                                  {0.05F, 0.60F, 0.62F, 1.0F},
                                                  {0.36F, 0.63F, 0.15F, 1.0F},
                                                  {0.88F, 0.63F, 0.05F, 1.0F},
                                                  {0.86F, 0.31F, 0.13F, 1.0F},
                                                  {0.70F, 0.17F, 0.50F, 1.0F}}};

}  // namespace

geometric::Color pmd_color(int count, int most) {
  if (count <= 0) {
    return {0.47F, 0.50F, 0.55F, 1.0F};
  }
  const int steps = std::max(most, static_cast<int>(kScale.size())) - 1;
  const float place = static_cast<float>(std::min(count - 1, steps) * (kScale.size() - 1)) /
                      static_cast<float>(steps);
  const auto below = static_cast<std::size_t>(place);
  const geometric::Color& a = kScale.at(below);
  const geometric::Color& b = kScale.at(std::min(below + 1, kScale.size() - 1));
  const float t = place - static_cast<float>(below);
  return {a.red + t * (b.red - a.red), a.green + t * (b.green - a.green),
          a.blue + t * (b.blue - a.blue), 1.0F};
}

}  // namespace handway::gui
