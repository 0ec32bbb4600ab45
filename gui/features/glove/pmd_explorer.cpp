#include "features/glove/pmd_explorer.h"

#include "features/glove/capture_coach.h"
#include "handway/geometric/robot/normalised_joints.h"
#include "widgets/style/theme.h"

#include <QComboBox>
#include <QGridLayout>
#include <QHelpEvent>
#include <QLabel>
#include <QMouseEvent>
#include <QPainter>
#include <QPolygonF>
#include <QSignalBlocker>
#include <QToolTip>
#include <QVBoxLayout>
#include <QVariant>

#include <algorithm>
#include <cmath>
#include <exception>

namespace handway::gui {
namespace {

constexpr int kSide = 1;         // px, left and right of the plane
constexpr int kAbove = 2;        // px
constexpr int kBelow = 2;        // px
constexpr double kRoom = 1.18;   // plane over box
constexpr double kHandle = 7.0;  // px, radius
constexpr double kDot = 1.6;     // px, radius

}  // namespace

PmdPad::PmdPad(QWidget* parent) : QWidget(parent) {
  setObjectName(QStringLiteral("pmd_pad"));
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
  setCursor(Qt::CrossCursor);
  setToolTip(tr("Drag to move the hand along both axes; the box is where the planner samples"));
}

void PmdPad::clear(const QString& reason) {
  reason_ = reason;
  x_ = y_ = {};
  dots_.clear();
  update();
}

void PmdPad::set_axes(const Axis& x, const Axis& y) {
  reason_.clear();
  x_ = x;
  y_ = y;
  dots_.clear();
  fit_extent();
}

void PmdPad::set_dots(std::vector<QPointF> dots) {
  dots_ = std::move(dots);
  fit_extent();
}

void PmdPad::set_posture(const QPointF& coordinates) {
  posture_ = coordinates;
  update();
}

void PmdPad::fit_extent() {
  extent_x_ = x_.half_side;
  extent_y_ = y_.half_side;
  for (const QPointF& dot : dots_) {
    extent_x_ = std::max(extent_x_, std::abs(dot.x()));
    extent_y_ = std::max(extent_y_, std::abs(dot.y()));
  }
  extent_x_ = std::max(extent_x_, 1e-6) * kRoom;
  extent_y_ = std::max(extent_y_, 1e-6) * kRoom;
  update();
}

QRectF PmdPad::plane() const { return QRectF(rect()).adjusted(kSide, kAbove, -kSide, -kBelow); }

QPointF PmdPad::to_pixel(const QPointF& coordinates) const {
  const QRectF area = plane();
  return {area.center().x() + coordinates.x() / extent_x_ * area.width() / 2.0,
          area.center().y() - coordinates.y() / extent_y_ * area.height() / 2.0};
}

QPointF PmdPad::from_pixel(const QPointF& pixel) const {
  const QRectF area = plane();
  return {(pixel.x() - area.center().x()) / area.width() * 2.0 * extent_x_,
          -(pixel.y() - area.center().y()) / area.height() * 2.0 * extent_y_};
}

void PmdPad::mousePressEvent(QMouseEvent* event) {
  if (event->button() == Qt::LeftButton) {
    drag_to(event->localPos());
  }
}

void PmdPad::mouseMoveEvent(QMouseEvent* event) {
  if (event->buttons() & Qt::LeftButton) {
    drag_to(event->localPos());
  }
}

void PmdPad::drag_to(const QPointF& pixel) {
  if (!reason_.isEmpty()) {
    return;
  }
  const QPointF point = from_pixel(pixel);
  posture_ = {std::clamp(point.x(), -x_.half_side, x_.half_side),
              std::clamp(point.y(), -y_.half_side, y_.half_side)};
  update();
  emit moved(posture_);
}

void PmdPad::paint_frame(QPainter& painter) const {
  const ThemeColors colors = colors_of(current_theme());
  const QRectF area = plane();
  painter.setPen(QPen(colors.border, 1.0));
  painter.setBrush(faded(colors.window, 0.6));
  painter.drawRoundedRect(area, 5.0, 5.0);
  const QPointF middle = to_pixel({0.0, 0.0});
  painter.setPen(QPen(faded(colors.muted, 0.45), 1.0, Qt::DashLine));
  painter.drawLine(QPointF(area.left(), middle.y()), QPointF(area.right(), middle.y()));
  painter.drawLine(QPointF(middle.x(), area.top()), QPointF(middle.x(), area.bottom()));
}

void PmdPad::paintEvent(QPaintEvent*) {
  const ThemeColors colors = colors_of(current_theme());
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  if (!reason_.isEmpty()) {
    const QRectF area = plane();
    painter.setPen(QPen(colors.border, 1.0, Qt::DashLine));
    painter.drawRoundedRect(area, 5.0, 5.0);
    painter.setPen(colors.muted);
    painter.drawText(area.adjusted(20, 20, -20, -20), Qt::AlignCenter | Qt::TextWordWrap, reason_);
    return;
  }
  paint_frame(painter);
  painter.setClipRect(plane());
  const QRectF box(to_pixel({-x_.half_side, y_.half_side}),
                   to_pixel({x_.half_side, -y_.half_side}));
  painter.setPen(QPen(colors.accent, 1.4));
  painter.setBrush(faded(colors.accent, 0.07));
  painter.drawRect(box);
  painter.setPen(Qt::NoPen);
  painter.setBrush(faded(colors.muted, 0.5));
  for (const QPointF& dot : dots_) {
    painter.drawEllipse(to_pixel(dot), kDot, kDot);
  }
  QFont font = painter.font();
  font.setPixelSize(scaled(11));
  painter.setFont(font);
  painter.setPen(colors.muted);
  const QRectF area = plane().adjusted(6, 3, -6, -3);
  const QPointF middle = to_pixel({0.0, 0.0});
  painter.drawText(QRectF(area.left(), middle.y() - scaled(16), area.width(), scaled(15)),
                   Qt::AlignRight | Qt::AlignVCenter, x_.name);
  painter.drawText(QRectF(middle.x() + 5, area.top(), area.width() / 2, scaled(15)),
                   Qt::AlignLeft | Qt::AlignVCenter, y_.name);
  painter.setPen(colors.accent);
  painter.drawText(
      QRectF(box.left() + 5, box.bottom() - scaled(18), box.width() - 10, scaled(16)),
      Qt::AlignLeft | Qt::AlignVCenter,
      QStringLiteral("±%1 × ±%2").arg(x_.half_side, 0, 'f', 2).arg(y_.half_side, 0, 'f', 2));
  painter.setPen(QPen(colors.surface, 2.0));
  painter.setBrush(colors.accent);
  painter.drawEllipse(to_pixel(posture_), kHandle, kHandle);
}

HandAxes::HandAxes(std::shared_ptr<const geometric::RobotModel> model, sampling::PmdBasis basis)
    : model_(std::move(model)), basis_(std::move(basis)) {
  for (const std::string& joint : basis_.joints) {
    const auto variable = model_ ? model_->find_variable(joint) : std::nullopt;
    if (!variable) {
      variables_.clear();
      return;
    }
    variables_.push_back(*variable);
  }
}

QString HandAxes::name(int axis) const {
  const auto index = static_cast<std::size_t>(axis);
  const std::size_t free = basis_.free_joints.size();
  return index < free
             ? joint_label(basis_.joints[static_cast<std::size_t>(basis_.free_joints[index].joint)])
             : QString::fromStdString(basis_.directions[index - free].name);
}

double HandAxes::half_side(int axis) const {
  const auto index = static_cast<std::size_t>(axis);
  const std::size_t free = basis_.free_joints.size();
  return index < free ? basis_.free_joints[index].half_side
                      : basis_.directions[index - free].half_side;
}

Eigen::VectorXd HandAxes::coordinates(const geometric::Configuration& q) const {
  const geometric::Configuration p = geometric::normalised(*model_, q);
  Eigen::VectorXd posture(static_cast<Eigen::Index>(variables_.size()));
  for (std::size_t i = 0; i < variables_.size(); ++i) {
    posture[static_cast<Eigen::Index>(i)] = p[variables_[i]];
  }
  return sampling::project(basis_, posture);
}

Eigen::VectorXd HandAxes::coordinates(const std::vector<std::string>& joints,
                                      const Eigen::VectorXd& posture) const {
  Eigen::VectorXd ordered(static_cast<Eigen::Index>(basis_.joints.size()));
  for (std::size_t i = 0; i < basis_.joints.size(); ++i) {
    const auto found = std::ranges::find(joints, basis_.joints[i]);
    if (found == joints.end()) {
      return {};
    }
    ordered[static_cast<Eigen::Index>(i)] = posture[found - joints.begin()];
  }
  return sampling::project(basis_, ordered);
}

geometric::NamedPosture HandAxes::posture(const Eigen::VectorXd& coordinates) const {
  Eigen::VectorXd u(dimension());
  for (int axis = 0; axis < dimension(); ++axis) {
    const double side = half_side(axis);
    u[axis] = side > 0.0 ? std::clamp(0.5 * (coordinates[axis] / side + 1.0), 0.0, 1.0) : 0.5;
  }
  const Eigen::VectorXd p = sampling::map_to_posture(basis_, u);
  geometric::NamedPosture posture;
  for (std::size_t i = 0; i < variables_.size(); ++i) {
    const double lower = model_->lower()[variables_[i]];
    const double upper = model_->upper()[variables_[i]];
    posture.values[basis_.joints[i]] = lower + p[static_cast<Eigen::Index>(i)] * (upper - lower);
  }
  return posture;
}

namespace {

QColor mixed(const QColor& a, const QColor& b, double share) {
  const auto mix = [share](double from, double to) { return from + share * (to - from); };
  return QColor::fromRgbF(mix(a.redF(), b.redF()), mix(a.greenF(), b.greenF()),
                          mix(a.blueF(), b.blueF()));
}

}  // namespace

CorrelationMap::CorrelationMap(QWidget* parent) : QWidget(parent) {
  setObjectName(QStringLiteral("correlation_map"));
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
}

void CorrelationMap::set_correlations(const std::vector<std::string>& joints,
                                      const Eigen::MatrixXd& correlations) {
  joints_ = joints;
  correlations_ = correlations;
  update();
}

QRectF CorrelationMap::square() const {
  const double side = std::min(width() - 4, height() - 8 - 8);
  return {(width() - side) / 2.0, 8.0, side, side};
}

void CorrelationMap::paintEvent(QPaintEvent*) {
  const ThemeColors colors = colors_of(current_theme());
  QPainter painter(this);
  const QRectF area = square();
  const auto count = static_cast<double>(correlations_.rows());
  for (Eigen::Index i = 0; i < correlations_.rows(); ++i) {
    for (Eigen::Index j = 0; j < correlations_.cols(); ++j) {
      const double value = correlations_(i, j);
      const double side = area.width() / count;
      const QRectF cell(area.left() + static_cast<double>(j) * side,
                        area.top() + static_cast<double>(i) * side, side, side);
      painter.fillRect(
          cell.adjusted(0.0, 0.0, -0.5, -0.5),
          mixed(colors.window, value >= 0.0 ? colors.accent : colors.bad, std::abs(value)));
    }
  }
  painter.setPen(QPen(colors.border, 1.0));
  painter.drawRect(area);
  if (correlations_.size() == 0) {
    QFont font = painter.font();
    font.setPixelSize(scaled(10));
    painter.setFont(font);
    painter.setPen(colors.muted);
    painter.drawText(area, Qt::AlignCenter, tr("no postures"));
  }
}

bool CorrelationMap::event(QEvent* event) {
  if (event->type() == QEvent::ToolTip && correlations_.size() > 0) {
    const auto* help = static_cast<QHelpEvent*>(event);
    const QPointF inside = help->pos() - square().topLeft();
    const double side = square().width() / static_cast<double>(correlations_.rows());
    const auto column = static_cast<Eigen::Index>(std::floor(inside.x() / side));
    const auto row = static_cast<Eigen::Index>(std::floor(inside.y() / side));
    if (row >= 0 && column >= 0 && row < correlations_.rows() && column < correlations_.cols()) {
      QToolTip::showText(help->globalPos(),
                         tr("%1 and %2: %3")
                             .arg(joint_label(joints_[static_cast<std::size_t>(row)]),
                                  joint_label(joints_[static_cast<std::size_t>(column)]))
                             .arg(correlations_(row, column), 0, 'f', 2),
                         this);
      return true;
    }
    QToolTip::hideText();
  }
  return QWidget::event(event);
}

namespace {

constexpr double kPercentOfAll = 100.0;
constexpr int kLabelled = 3;
constexpr Eigen::Index kMost = 12;
constexpr int kLabelHeight = 13;  // px
constexpr double kBarShare = 0.62;

}  // namespace

VarianceChart::VarianceChart(QWidget* parent) : QWidget(parent) {
  setObjectName(QStringLiteral("variance_chart"));
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
}

void VarianceChart::set_shares(const Eigen::VectorXd& shares) {
  shares_ = shares.head(std::min<Eigen::Index>(shares.size(), kMost));
  QStringList lines;
  double sum = 0.0;
  for (Eigen::Index k = 0; k < shares_.size(); ++k) {
    sum += shares_[k];
    lines << tr("%1 directions: %2 %").arg(k + 1).arg(sum * kPercentOfAll, 0, 'f', 2);
  }
  setToolTip(lines.join(QLatin1Char('\n')));
  update();
}

void VarianceChart::paintEvent(QPaintEvent*) {
  const ThemeColors colors = colors_of(current_theme());
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  QFont font = painter.font();
  font.setPixelSize(scaled(10));
  painter.setFont(font);
  const QRectF area = QRectF(rect()).adjusted(2, 8, -4, -scaled(16));
  painter.setPen(QPen(faded(colors.border, 0.9), 1.0));
  for (const double level : {0.0, 0.5, 1.0}) {
    const double y = area.bottom() - level * area.height();
    painter.drawLine(QPointF(area.left(), y), QPointF(area.right(), y));
  }
  if (shares_.size() == 0) {
    painter.setPen(colors.muted);
    painter.drawText(area, Qt::AlignCenter, tr("no postures"));
    return;
  }
  const double step = area.width() / static_cast<double>(shares_.size());
  QPolygonF sums;
  double sum = 0.0;
  for (Eigen::Index k = 0; k < shares_.size(); ++k) {
    sum += shares_[k];
    const double middle = area.left() + (static_cast<double>(k) + 0.5) * step;
    sums << QPointF(middle, area.bottom() - sum * area.height());
    const double height = shares_[k] * area.height();
    painter.fillRect(
        QRectF(middle - kBarShare * step / 2, area.bottom() - height, kBarShare * step, height),
        faded(colors.accent, 0.35));
    if (k == 0 || (k + 1) % 4 == 0) {
      painter.setPen(colors.muted);
      painter.drawText(QRectF(middle - scaled(10), area.bottom() + 2, scaled(20), scaled(13)),
                       Qt::AlignCenter, QString::number(k + 1));
    }
  }
  painter.setPen(QPen(colors.accent, 1.6));
  painter.drawPolyline(sums);
  painter.setBrush(colors.surface);
  for (const QPointF& point : sums) {
    painter.drawEllipse(point, 2.2, 2.2);
  }
  sum = 0.0;
  painter.setPen(colors.text);
  for (int k = 0; k < std::min<int>(kLabelled, static_cast<int>(shares_.size())); ++k) {
    sum += shares_[k];
    if (k == 0 || sums[k - 1].y() - sums[k].y() > scaled(kLabelHeight)) {
      painter.drawText(QRectF(sums[k].x() + 5, sums[k].y(), scaled(60), scaled(kLabelHeight)),
                       Qt::AlignLeft, QStringLiteral("%1 %").arg(sum * kPercentOfAll, 0, 'f', 0));
    }
  }
}

namespace {

constexpr int kLive = 0;
constexpr int kFromFile = 1;
constexpr int kSceneBasis = 0;
constexpr std::size_t kMostDots = 1200;
constexpr Eigen::Index kLeastPostures = 50;

QComboBox* choice(const char* name) {
  auto* box = new QComboBox;
  box->setObjectName(QLatin1String(name));
  box->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  box->setMinimumContentsLength(3);
  return box;
}

QLabel* heading(const QString& text) {
  auto* label = new QLabel(text);
  label->setProperty("role", "note");
  return label;
}

}  // namespace

PmdExplorer::PmdExplorer(QWidget* parent)
    : QWidget(parent),
      source_(choice("explorer_source")),
      basis_(choice("explorer_basis")),
      across_(choice("explorer_across")),
      up_(choice("explorer_up")),
      pad_(new PmdPad),
      variance_(new VarianceChart),
      correlation_(new CorrelationMap),
      note_(heading({})) {
  source_->addItems({tr("Live"), tr("A recording…")});
  basis_->addItems({tr("Of the scene"), tr("Of these postures")});
  auto* form = new QGridLayout;
  form->setHorizontalSpacing(8);
  form->setVerticalSpacing(6);
  form->addWidget(new QLabel(tr("Postures")), 0, 0);
  form->addWidget(source_, 0, 1, 1, 3);
  form->addWidget(new QLabel(tr("Basis")), 1, 0);
  form->addWidget(basis_, 1, 1, 1, 3);
  form->addWidget(new QLabel(tr("Axes")), 2, 0);
  form->addWidget(across_, 2, 1);
  form->addWidget(new QLabel(QStringLiteral("×")), 2, 2);
  form->addWidget(up_, 2, 3);
  form->setColumnStretch(1, 1);
  form->setColumnStretch(3, 1);
  auto* charts = new QGridLayout;
  charts->setHorizontalSpacing(12);
  charts->setVerticalSpacing(2);
  charts->addWidget(heading(tr("Variance held")), 0, 0);
  charts->addWidget(heading(tr("Joints together")), 0, 1);
  charts->addWidget(variance_, 1, 0);
  charts->addWidget(correlation_, 1, 1);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(12, 10, 12, 6);
  layout->setSpacing(8);
  layout->addLayout(form);
  layout->addWidget(pad_, 1);
  layout->addWidget(note_);
  layout->addLayout(charts);
  connect(source_, qOverload<int>(&QComboBox::activated), this, [this](int index) {
    if (index == kLive) {
      emit live_requested();
    } else {
      emit recording_requested();
    }
  });
  connect(basis_, qOverload<int>(&QComboBox::activated), this, &PmdExplorer::rebuild_axes);
  connect(across_, qOverload<int>(&QComboBox::activated), this, &PmdExplorer::choose_axes);
  connect(up_, qOverload<int>(&QComboBox::activated), this, &PmdExplorer::choose_axes);
  connect(pad_, &PmdPad::moved, this, &PmdExplorer::move_hand);
  rebuild_axes();
}

bool PmdExplorer::uses_scene_basis() const { return basis_->currentIndex() == kSceneBasis; }

void PmdExplorer::set_hand(std::shared_ptr<const geometric::RobotModel> model,
                           std::shared_ptr<const sampling::PmdBasis> basis) {
  model_ = std::move(model);
  scene_basis_ = std::move(basis);
  q_ = model_ ? model_->neutral() : geometric::Configuration();
  if (!scene_basis_ && model_) {
    basis_->setCurrentIndex(kSceneBasis + 1);
  }
  rebuild_axes();
}

void PmdExplorer::set_configuration(const geometric::Configuration& q) {
  q_ = q;
  if (moving_ || axes_.dimension() < 2 || !isVisible()) {
    return;
  }
  const Eigen::VectorXd e = axes_.coordinates(q_);
  pad_->set_posture({e[across_->currentIndex()], e[up_->currentIndex()]});
}

void PmdExplorer::show_postures(const CapturedPostures& postures, const QString& source) {
  postures_ = postures;
  const QSignalBlocker quiet(source_);
  source_->setItemText(kFromFile, source.isEmpty() ? tr("A recording…") : source);
  source_->setCurrentIndex(source.isEmpty() ? kLive : kFromFile);
  if (uses_scene_basis()) {
    show_dots();
  } else {
    rebuild_axes();
  }
  show_statistics();
}

void PmdExplorer::rebuild_axes() {
  axes_ = {};
  QString reason;
  if (!model_) {
    reason = tr("Open a scene with a robot first");
  } else if (uses_scene_basis()) {
    if (scene_basis_) {
      axes_ = HandAxes(model_, *scene_basis_);
    } else {
      reason =
          tr("The scene names no hand basis. Capture postures, or choose a recording, and "
             "take the basis of these postures");
    }
  } else if (postures_.count() < kLeastPostures) {
    reason = tr("No postures yet: connect a glove, or choose a recording");
  } else {
    sampling::PmdBasisOptions options;
    options.free_joints = postures_.left_out();
    axes_ = HandAxes(model_, sampling::make_pmd_basis("", "captured postures", postures_.joints(),
                                                      postures_.components(), options));
  }
  if (axes_.dimension() < 2) {
    pad_->clear(reason.isEmpty() ? tr("The basis does not fit the hand of the scene") : reason);
  }
  const QSignalBlocker quiet_across(across_), quiet_up(up_);
  const bool same = across_->count() == axes_.dimension();
  const int free = static_cast<int>(axes_.basis().free_joints.size());
  const int across = same ? across_->currentIndex() : free;
  const int up = same ? up_->currentIndex() : free + 1;
  across_->clear();
  up_->clear();
  for (int axis = 0; axis < axes_.dimension(); ++axis) {
    across_->addItem(axes_.name(axis));
    up_->addItem(axes_.name(axis));
  }
  across_->setCurrentIndex(std::min(across, axes_.dimension() - 1));
  up_->setCurrentIndex(std::min(up, axes_.dimension() - 1));
  choose_axes();
}

void PmdExplorer::choose_axes() {
  if (axes_.dimension() < 2) {
    note_->setText({});
    return;
  }
  const auto axis = [this](int index) {
    return PmdPad::Axis{axes_.name(index), axes_.half_side(index)};
  };
  pad_->set_axes(axis(across_->currentIndex()), axis(up_->currentIndex()));
  const Eigen::VectorXd e = axes_.coordinates(q_);
  pad_->set_posture({e[across_->currentIndex()], e[up_->currentIndex()]});
  show_dots();
}

void PmdExplorer::show_dots() {
  if (axes_.dimension() < 2) {
    return;
  }
  std::vector<QPointF> dots;
  const auto& samples = postures_.samples();
  const std::size_t stride = samples.size() / kMostDots + 1;
  for (std::size_t i = 0; i < samples.size(); i += stride) {
    const Eigen::VectorXd e = axes_.coordinates(postures_.joints(), samples[i]);
    if (e.size() == 0) {
      break;
    }
    dots.emplace_back(e[across_->currentIndex()], e[up_->currentIndex()]);
  }
  pad_->set_dots(std::move(dots));
  note_->setText(postures_.count() > 0
                     ? tr("%L1 postures; drag within the planner's box").arg(postures_.count())
                     : tr("Drag within the box, where the planner samples"));
}

void PmdExplorer::show_statistics() {
  if (postures_.count() < kLeastPostures) {
    variance_->set_shares({});
    correlation_->set_correlations({}, {});
    return;
  }
  variance_->set_shares(postures_.components().shares);
  correlation_->set_correlations(postures_.joints(), postures_.correlations());
}

void PmdExplorer::move_hand(const QPointF& coordinates) {
  Eigen::VectorXd e = axes_.coordinates(q_);
  e[across_->currentIndex()] = coordinates.x();
  e[up_->currentIndex()] = coordinates.y();
  moving_ = true;
  emit posture_changed(axes_.posture(e));
  moving_ = false;
}

}  // namespace handway::gui
