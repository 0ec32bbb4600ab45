#include "features/glove/hand_picture.h"

#include "widgets/style/color_math.h"
#include "widgets/style/theme.h"

#include <QPainter>
#include <QPolygonF>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <utility>

namespace handway::gui {
namespace {

constexpr int kPictureHeight = 116;      // px
constexpr double kBone = 7.0;            // px, of a finger's width
constexpr double kPictureMargin = 12.0;  // px

/// Returns the view of a person's palm frame: fingers up, a little from the thumb's side and from
/// above, so that bent fingers show.
Eigen::Matrix3d view_of_hand() {
  const Eigen::AngleAxisd up(M_PI / 2.0, Eigen::Vector3d::UnitZ());
  const Eigen::AngleAxisd aside(0.5, Eigen::Vector3d::UnitY());
  const Eigen::AngleAxisd tilted(-0.35, Eigen::Vector3d::UnitX());
  return (tilted * aside * up).toRotationMatrix();
}

using Bone = std::pair<int, int>;
constexpr std::array<Bone, 20> kBones{{{0, 1},   {1, 2},   {2, 3},   {3, 4},   {0, 5},
                                       {5, 6},   {6, 7},   {7, 8},   {0, 9},   {9, 10},
                                       {10, 11}, {11, 12}, {0, 13},  {13, 14}, {14, 15},
                                       {15, 16}, {0, 17},  {17, 18}, {18, 19}, {19, 20}}};
constexpr std::array<int, 5> kPalm{1, 5, 9, 13, 17};
constexpr double kWrist = 0.32;  // breadth of the wrist on each side, of that of the knuckles

}  // namespace

HandPicture::HandPicture(QWidget* parent) : QWidget(parent) {
  setObjectName(QStringLiteral("calibration_picture"));
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
}

QSize HandPicture::sizeHint() const { return {scaled(160), scaled(kPictureHeight)}; }

void HandPicture::show_hand(const device::GloveAngles& angles, bool left) {
  angles_ = angles;
  left_ = left;
  update();
}

void HandPicture::paintEvent(QPaintEvent*) {
  const ThemeColors colors = colors_of(current_theme());
  const device::HandLandmarks seen =
      view_of_hand() * device::hand_landmarks(angles_, device::typical_bones(1.0));
  const double scale = (height() - 2.0 * kPictureMargin) / 1.05;
  const auto place = [&](int landmark) {
    const double side = (left_ ? -1.0 : 1.0) * (seen(0, landmark) - seen(0, 9) * 0.5);
    return QPointF(width() / 2.0 + scale * side,
                   height() - kPictureMargin - scale * seen(1, landmark));
  };
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  QPolygonF palm;
  for (const int landmark : kPalm) {
    palm << place(landmark);
  }
  const auto pen = [&](const QColor& color, double width) {
    return QPen(color, scaled(1) * width, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin);
  };
  const QPointF breadth = kWrist * (place(kPalm.back()) - place(kPalm[1]));
  palm << place(0) + breadth << place(0) - breadth;
  painter.setPen(pen(faded(colors.accent, 0.35), kBone));
  painter.setBrush(faded(colors.accent, 0.35));
  painter.drawPolygon(palm);
  std::array<Bone, kBones.size()> bones = kBones;
  std::ranges::sort(bones, {},
                    [&](const Bone& bone) { return seen(2, bone.first) + seen(2, bone.second); });
  for (const auto& [from, to] : bones) {
    if (from == 0) {
      continue;
    }
    painter.setPen(pen(colors.surface, kBone + 3.0));
    painter.drawLine(place(from), place(to));
    painter.setPen(pen(colors.accent, kBone));
    painter.drawLine(place(from), place(to));
  }
}

}  // namespace handway::gui
