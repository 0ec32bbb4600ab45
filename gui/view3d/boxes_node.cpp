#include "view3d/boxes_node.h"

#include "view3d/edges_node.h"

#include <Inventor/nodes/SoSeparator.h>

#include <array>

namespace handway::gui {
namespace {

constexpr float kLineWidth = 1.5F;
constexpr double kRounding = 0.005;  // of the way

// Corners are numbered by their bits: 1 for x, 2 for y, 4 for z.
constexpr std::array<std::pair<int, int>, 12> kEdges{{{0, 1},
                                                      {2, 3},
                                                      {4, 5},
                                                      {6, 7},
                                                      {0, 2},
                                                      {1, 3},
                                                      {4, 6},
                                                      {5, 7},
                                                      {0, 4},
                                                      {1, 5},
                                                      {2, 6},
                                                      {3, 7}}};

Eigen::Vector3d corner(const planning::PalmBox& box, int number) {
  const auto side = [number](int bit) { return (number & bit) != 0 ? 1.0 : -1.0; };
  return box.X_WC * box.half_size.cwiseProduct(Eigen::Vector3d(side(1), side(2), side(4)));
}

}  // namespace

CoinRef<SoSeparator> make_boxes_node(const std::vector<planning::PalmBox>& boxes,
                                     std::pair<double, double> range) {
  std::vector<Eigen::Vector3d> corners;
  std::vector<std::pair<int, int>> searched;
  std::vector<std::pair<int, int>> given_up;
  const bool is_joined = range.second - range.first < kRounding;  // nothing is left to search
  for (const planning::PalmBox& box : boxes) {
    const bool is_within =
        is_joined || (box.step >= range.first - kRounding && box.step <= range.second + kRounding);
    const auto first = static_cast<int>(corners.size());
    for (int number = 0; number < 8; ++number) {
      corners.push_back(corner(box, number));
    }
    for (const auto& [from, to] : kEdges) {
      (is_within ? searched : given_up).emplace_back(first + from, first + to);
    }
  }
  auto separator = make_coin<SoSeparator>();
  for (const auto& [edges, color] :
       {std::pair(&given_up, kGivenUpColor), std::pair(&searched, kSearchedColor)}) {
    if (!edges->empty()) {
      separator->addChild(make_edges_node(corners, *edges, color, kLineWidth));
    }
  }
  return separator;
}

}  // namespace handway::gui
