#include "view3d/orientation_cube.h"

#include <QApplication>
#include <QMouseEvent>
#include <QPainter>
#include <QPainterPath>
#include <QStringList>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace handway::gui {
ViewOverlay::ViewOverlay(QWidget* view) : QWidget(view) {
  setAttribute(Qt::WA_TransparentForMouseEvents);
  setAttribute(Qt::WA_NoSystemBackground);
}

void ViewOverlay::set_color(const geometric::Color& color) {
  color_ = QColor::fromRgbF(color.red, color.green, color.blue, color.alpha);
  update();
}

void ViewOverlay::set_note(const QString& note, const QPoint& place) {
  note_ = note;
  note_place_ = place;
  update();
}

void ViewOverlay::set_axes(const Eigen::Matrix3d& R_WC) {
  if (R_WC != R_WC_) {
    R_WC_ = R_WC;
    update();
  }
}

void ViewOverlay::paintEvent(QPaintEvent* /*event*/) {
  QPainter painter(this);
  painter.setPen(color_);
  QFont font = painter.font();
  font.setPixelSize(11);
  font.setBold(true);
  painter.setFont(font);
  const QPointF middle(kAxesSize / 2.0, height() - kAxesSize / 2.0);
  constexpr double kReach = 1.24 * kAxesSize / kAxesHeight;
  constexpr std::array kNames{"X", "Y", "Z"};
  for (int axis = 0; axis < 3; ++axis) {
    const QPointF place = middle + kReach * QPointF(R_WC_(axis, 0), -R_WC_(axis, 1));
    painter.drawText(QRectF(place - QPointF(8.0, 8.0), QSizeF(16.0, 16.0)), Qt::AlignCenter,
                     QLatin1String(kNames.at(static_cast<std::size_t>(axis))));
  }
  if (!note_.isEmpty()) {
    font.setPixelSize(13);
    font.setBold(false);
    painter.setFont(font);
    painter.setRenderHint(QPainter::Antialiasing);
    QRectF card = painter.fontMetrics().boundingRect(note_).adjusted(-9, -6, 9, 6);
    card.moveTopLeft(note_place_ + QPoint(18, 18));
    card.moveRight(std::min(card.right(), width() - 6.0));
    card.moveBottom(std::min(card.bottom(), height() - 6.0));
    painter.setPen(Qt::NoPen);
    painter.setBrush(QColor(24, 28, 34, 215));
    painter.drawRoundedRect(card, 5.0, 5.0);
    painter.setPen(Qt::white);
    painter.drawText(card, Qt::AlignCenter, note_);
    painter.setPen(color_);
  }
}

using Eigen::Vector3d;

const std::array<CubeFace, 6>& cube_faces() {
  static const std::array<CubeFace, 6> kFaces{{
      {"Front", {1, 0, 0}, Vector3d::UnitY(), Vector3d::UnitZ()},
      {"Back", {-1, 0, 0}, -Vector3d::UnitY(), Vector3d::UnitZ()},
      {"Left", {0, 1, 0}, -Vector3d::UnitX(), Vector3d::UnitZ()},
      {"Right", {0, -1, 0}, Vector3d::UnitX(), Vector3d::UnitZ()},
      {"Top", {0, 0, 1}, Vector3d::UnitX(), Vector3d::UnitY()},
      {"Bottom", {0, 0, -1}, Vector3d::UnitX(), -Vector3d::UnitY()},
  }};
  return kFaces;
}

CubePart part_of_field(const CubeFace& face, int column, int row) {
  return face.normal + (column - 1) * face.right.cast<int>() + (row - 1) * face.up.cast<int>();
}

std::optional<CubePart> cube_part_at(const Eigen::Matrix3d& R_WC, double right, double up) {
  const Vector3d backwards = R_WC.col(2);
  const Vector3d p = right * R_WC.col(0) + up * R_WC.col(1);
  for (const CubeFace& face : cube_faces()) {
    const Vector3d normal = face.normal.cast<double>();
    const double slope = normal.dot(backwards);
    if (slope < 1e-6) {
      continue;  // seen from behind
    }
    const Vector3d hit = p + (1.0 - normal.dot(p)) / slope * backwards;
    const double u = face.right.dot(hit), v = face.up.dot(hit);
    if (std::abs(u) <= 1.0 && std::abs(v) <= 1.0) {
      const auto field = [](double x) {
        return x < kCubeFields[1] ? 0 : x > kCubeFields[2] ? 2 : 1;
      };
      return part_of_field(face, field(u), field(v));
    }
  }
  return std::nullopt;
}

CubeDirection direction_of(const CubePart& part, double azimuth) {
  constexpr double kQuarter = 0.5 * std::numbers::pi;
  const double level = std::hypot(part.x(), part.y());
  if (level == 0.0) {
    return {kQuarter * std::round(azimuth / kQuarter), kQuarter * part.z()};
  }
  return {std::atan2(part.y(), part.x()), std::atan2(part.z(), level)};
}

std::vector<const char*> face_names(const CubePart& part) {
  std::vector<const char*> names;
  for (const std::size_t face : {4U, 5U, 0U, 1U, 2U, 3U}) {  // top and bottom first
    if (cube_faces().at(face).normal.dot(part) > 0) {
      names.push_back(cube_faces().at(face).name);
    }
  }
  return names;
}

namespace {

constexpr double kUnit = 27.0;         // pixels of half an edge
constexpr double kLetterHeight = 0.4;  // of half an edge
constexpr double kWordWidth = 1.55;
constexpr double kFaceWithin = 0.86;  // the lighter part of a face
constexpr double kFaceEdgeOn = 0.03;

QString translated(const char* name) { return OrientationCube::tr(name); }

// Every name's outline, its middle in the origin, y downwards.
QPainterPath word(const QString& text) {
  QFont font = QApplication::font();
  font.setPixelSize(40);
  font.setWeight(QFont::DemiBold);
  QPainterPath path;
  path.addText(0, 0, font, text.toUpper());
  const QRectF box = path.boundingRect();
  const double scale = std::min(kLetterHeight / box.height(), kWordWidth / box.width());
  return QTransform::fromScale(scale, scale).map(path.translated(-box.center()));
}

QColor mix(const QColor& a, const QColor& b, double share) {
  return QColor::fromRgbF(a.redF() + share * (b.redF() - a.redF()),
                          a.greenF() + share * (b.greenF() - a.greenF()),
                          a.blueF() + share * (b.blueF() - a.blueF()));
}

}  // namespace

OrientationCube::OrientationCube(QWidget* view) : QWidget(view) {
  setObjectName(QStringLiteral("orientation_cube"));
  setAccessibleName(tr("Orientation cube"));
  setFixedSize(kSize, kSize);
  setMouseTracking(true);
  setCursor(Qt::PointingHandCursor);
  setAttribute(Qt::WA_NoSystemBackground);
}

void OrientationCube::set_orientation(const Eigen::Matrix3d& R_WC) {
  if (R_WC != R_WC_) {
    R_WC_ = R_WC;
    update();
  }
}

QPointF OrientationCube::screen(const Vector3d& p) const {
  const Vector3d p_C = R_WC_.transpose() * p;
  return {0.5 * width() + kUnit * p_C.x(), 0.5 * height() - kUnit * p_C.y()};
}

std::optional<QPointF> OrientationCube::place_of(const CubePart& part) const {
  const QPointF place = screen(0.85 * part.cast<double>());
  return part_at(place) == part ? std::optional(place) : std::nullopt;
}

std::optional<CubePart> OrientationCube::part_at(const QPointF& place) const {
  return cube_part_at(R_WC_, (place.x() - 0.5 * width()) / kUnit,
                      (0.5 * height() - place.y()) / kUnit);
}

void OrientationCube::paintEvent(QPaintEvent* /*event*/) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  for (const CubeFace& face : cube_faces()) {
    if (face.normal.cast<double>().dot(R_WC_.col(2)) > kFaceEdgeOn) {
      paint_face(painter, face);
    }
  }
}

void OrientationCube::paint_face(QPainter& painter, const CubeFace& face) const {
  const Vector3d normal = face.normal.cast<double>();
  const auto at = [&](double u, double v) { return screen(normal + u * face.right + v * face.up); };
  const auto field = [&](double left, double right, double lower, double upper) {
    return QPolygonF({at(left, lower), at(right, lower), at(right, upper), at(left, upper)});
  };
  const QColor paper = palette().color(QPalette::Base);
  const QColor ink = palette().color(QPalette::Text);
  const QColor accent = palette().color(QPalette::Highlight);
  // The brightest face is the one that looks at the reader, and a little upwards.
  const Vector3d n_C = R_WC_.transpose() * normal;
  const double shade = 0.26 * (1.0 - std::clamp(n_C.dot(Vector3d(-0.2, 0.45, 0.87)), 0.0, 1.0));
  painter.setPen(QPen(mix(paper, ink, 0.55), 1.1, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
  painter.setBrush(mix(paper, ink, shade + 0.10));
  painter.drawPolygon(field(-1.0, 1.0, -1.0, 1.0));
  painter.setPen(Qt::NoPen);
  painter.setBrush(mix(paper, ink, shade));
  painter.drawPolygon(field(-kFaceWithin, kFaceWithin, -kFaceWithin, kFaceWithin));
  bool is_hot = false;
  for (int column = 0; column < 3; ++column) {
    for (int row = 0; row < 3; ++row) {
      if (hot_ == part_of_field(face, column, row)) {
        const auto x = static_cast<std::size_t>(column), y = static_cast<std::size_t>(row);
        is_hot |= column == 1 && row == 1;
        painter.setBrush(mix(paper, accent, 0.85));
        painter.drawPolygon(field(kCubeFields.at(x), kCubeFields.at(x + 1), kCubeFields.at(y),
                                  kCubeFields.at(y + 1)));
      }
    }
  }
  const QPointF middle = at(0.0, 0.0);
  const QPointF right = at(1.0, 0.0) - middle, down = at(0.0, -1.0) - middle;
  painter.setBrush(is_hot ? palette().color(QPalette::HighlightedText) : mix(ink, paper, 0.12));
  painter.drawPath(QTransform(right.x(), right.y(), down.x(), down.y(), middle.x(), middle.y())
                       .map(word(translated(face.name))));
}

void OrientationCube::set_hot(const std::optional<CubePart>& part) {
  if (part != hot_) {
    hot_ = part;
    QStringList names;
    for (const char* name : part ? face_names(*part) : std::vector<const char*>{}) {
      names << translated(name);
    }
    setToolTip(part ? tr("Look from: %1").arg(names.join(QStringLiteral(", ")).toLower())
                    : tr("Drag to turn the view"));
    update();
  }
}

void OrientationCube::mousePressEvent(QMouseEvent* event) {
  pressed_ = event->button() == Qt::LeftButton;
  dragging_ = false;
  last_ = event->pos();
  event->accept();
}

void OrientationCube::mouseMoveEvent(QMouseEvent* event) {
  if (!pressed_) {
    set_hot(part_at(event->localPos()));
    return;
  }
  const QPoint drag = event->pos() - last_;
  if (dragging_ || drag.manhattanLength() >= QApplication::startDragDistance()) {
    dragging_ = true;
    last_ = event->pos();
    set_hot(std::nullopt);
    emit dragged(drag);
  }
}

void OrientationCube::mouseReleaseEvent(QMouseEvent* event) {
  if (pressed_ && !dragging_ && event->button() == Qt::LeftButton) {
    if (const auto part = part_at(event->localPos())) {
      emit chosen(*part);
    }
  }
  pressed_ = dragging_ = false;
}

void OrientationCube::leaveEvent(QEvent* /*event*/) { set_hot(std::nullopt); }

}  // namespace handway::gui
