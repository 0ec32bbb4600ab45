#include "features/glove/pmd_explorer.h"

#include "features/glove/capture_coach.h"
#include "features/glove/device_field.h"
#include "handway/geometric/robot/composed_robot.h"
#include "handway/geometric/robot/normalised_joints.h"
#include "widgets/forms/arrangement.h"
#include "widgets/forms/labels.h"
#include "widgets/forms/named.h"
#include "widgets/style/theme.h"

#include <QComboBox>
#include <QFileDialog>
#include <QGridLayout>
#include <QHelpEvent>
#include <QLabel>
#include <QMenu>
#include <QMouseEvent>
#include <QPainter>
#include <QPolygonF>
#include <QPushButton>
#include <QSignalBlocker>
#include <QSpinBox>
#include <QTabBar>
#include <QToolTip>
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
  set_text_size(painter, 11);
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
    const auto variable = model_ ? geometric::find_variable_of_part(*model_, joint) : std::nullopt;
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
    set_text_size(painter, 10);
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
  set_text_size(painter, 10);
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
constexpr int kOwnBasis = 1;
constexpr int kFirstOther = 2;
constexpr int kOpenBasis = -1;  // data of the entry that asks for a file
constexpr int kDirections = 4;
constexpr std::size_t kMostDots = 1200;
constexpr Eigen::Index kLeastPostures = 50;

QComboBox* choice(const char* name) {
  auto* box = new QComboBox;
  box->setObjectName(QLatin1String(name));
  box->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  box->setMinimumContentsLength(3);
  return box;
}

}  // namespace

BasisOptions::BasisOptions(QWidget* parent)
    : QWidget(parent),
      directions_(named("basis_directions", new QSpinBox)),
      free_(named("basis_free", new QPushButton)) {
  directions_->setToolTip(tr("Principal motion directions that the basis takes"));
  free_->setProperty("role", "compact");
  free_->setMenu(new QMenu(free_));
  free_->setToolTip(
      tr("Joints with an axis of their own over their whole range, as the thumb's base in the "
         "paper; they take no part in the directions"));
  auto* label = new QLabel(tr("PMDs"));
  label->setBuddy(directions_);
  lay_out(*this, in_row({label, directions_, {free_, 1}}, 8));
  connect(directions_, qOverload<int>(&QSpinBox::valueChanged), this, &BasisOptions::changed);
  take_joints();
}

void BasisOptions::set_joints(const std::vector<std::string>& joints,
                              const std::vector<int>& free) {
  if (joints == joints_) {
    return;
  }
  joints_ = joints;
  free_->menu()->clear();
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    QAction* action = free_->menu()->addAction(joint_label(joints_[j]));
    action->setCheckable(true);
    action->setChecked(std::ranges::count(free, static_cast<int>(j)) > 0);
    connect(action, &QAction::toggled, this, [this] {
      take_joints();
      emit changed();
    });
  }
  take_joints();
  const QSignalBlocker quiet(directions_);
  directions_->setValue(kDirections);
}

sampling::PmdBasisOptions BasisOptions::options() const {
  sampling::PmdBasisOptions options;
  options.directions = directions_->value();
  const QList<QAction*> actions = free_->menu()->actions();
  for (int j = 0; j < actions.size(); ++j) {
    if (actions[j]->isChecked()) {
      options.free_joints.push_back(j);
    }
  }
  return options;
}

// One joint at least is left for the directions, and the pad has two axes.
void BasisOptions::take_joints() {
  const QList<QAction*> actions = free_->menu()->actions();
  QStringList chosen;
  for (const QAction* action : actions) {
    if (action->isChecked()) {
      chosen << action->text();
    }
  }
  for (QAction* action : actions) {
    action->setEnabled(action->isChecked() || chosen.size() + 1 < actions.size());
  }
  free_->setText(chosen.isEmpty()     ? tr("No free joint")
                 : chosen.size() == 1 ? tr("Free: %1").arg(chosen.front())
                                      : tr("%1 free joints").arg(chosen.size()));
  const QSignalBlocker quiet(directions_);
  const int most = std::max(1, static_cast<int>(actions.size()) - static_cast<int>(chosen.size()));
  directions_->setRange(chosen.isEmpty() ? std::min(2, most) : 1, most);
}

PmdExplorer::PmdExplorer(QWidget* parent)
    : QWidget(parent),
      source_(choice("explorer_source")),
      method_(choice("explorer_method")),
      errors_(named("explorer_errors", note({}))),
      basis_(choice("explorer_basis")),
      options_(new BasisOptions),
      save_(named("basis_save", new QPushButton(tr("Save as basis…")))),
      use_(named("basis_use", new QPushButton(tr("Use for planning")))),
      across_(choice("explorer_across")),
      up_(choice("explorer_up")),
      pad_(new PmdPad),
      variance_(new VarianceChart),
      correlation_(new CorrelationMap),
      comparison_(new BasisComparisonView),
      report_(new BasisReportView),
      views_(named("explorer_views", new QTabBar)),
      note_(note({})) {
  source_->addItems({tr("Live"), tr("A recording…")});
  source_->setToolTip(
      tr("Postures that the glove makes now, or those of one or several recordings together"));
  source_->setItemData(kLive, tr("All that the glove has made since it was connected"),
                       Qt::ToolTipRole);
  source_->setItemData(
      kFromFile,
      tr("Reads files, makes postures of this hand of them as 'Hand by' says, and shows them and "
         "their principal motion directions. Several files count together, each as a person of "
         "its own in Report. The scene changes with 'Use for planning' only.") +
          QStringLiteral("\n\n") + recording_kinds(),
      Qt::ToolTipRole);
  method_->addItems({tr("Joint mapping"), tr("Fingertip retargeting")});
  method_->setToolTip(
      tr("What makes postures of this hand from a person's: sensor by sensor, as Mapping says, or "
         "by where the person's fingertips are"));
  errors_->setWordWrap(true);
  errors_->setTextFormat(Qt::RichText);
  errors_->hide();
  note_->setWordWrap(true);
  auto* form = new QGridLayout;
  form->setHorizontalSpacing(8);
  form->setVerticalSpacing(6);
  form->addWidget(new QLabel(tr("Postures")), 0, 0);
  form->addWidget(source_, 0, 1, 1, 3);
  form->addWidget(new QLabel(tr("Hand by")), 1, 0);
  form->addWidget(method_, 1, 1, 1, 3);
  form->addWidget(errors_, 2, 0, 1, 4);
  form->addWidget(new QLabel(tr("Basis")), 3, 0);
  form->addWidget(basis_, 3, 1, 1, 3);
  form->addWidget(options_, 4, 0, 1, 4);
  form->addWidget(build_buttons(), 5, 0, 1, 4);
  form->setColumnStretch(1, 1);
  form->setColumnStretch(3, 1);
  lay_out(*this, in_column({form, {build_views(), 1}}, 8), {12, 10, 12, 6});
  connect(source_, qOverload<int>(&QComboBox::activated), this, [this](int index) {
    if (index == kLive) {
      emit live_requested();
    } else {
      emit recording_requested();
    }
  });
  connect(method_, qOverload<int>(&QComboBox::activated), this,
          [this](int method) { emit method_chosen(static_cast<PostureMethod>(method)); });
  connect(basis_, qOverload<int>(&QComboBox::activated), this, &PmdExplorer::take_choice);
  connect(options_, &BasisOptions::changed, this, [this] {
    rebuild_axes();
    emit options_changed();
  });
  connect(across_, qOverload<int>(&QComboBox::activated), this, &PmdExplorer::choose_axes);
  connect(up_, qOverload<int>(&QComboBox::activated), this, &PmdExplorer::choose_axes);
  connect(pad_, &PmdPad::moved, this, &PmdExplorer::move_hand);
  list_bases();
  rebuild_axes();
}

// What the postures show, and how good a basis of them is.
QWidget* PmdExplorer::build_views() {
  auto* axes = new QGridLayout;
  axes->setHorizontalSpacing(8);
  axes->addWidget(new QLabel(tr("Axes")), 0, 0);
  axes->addWidget(across_, 0, 1);
  axes->addWidget(new QLabel(QStringLiteral("×")), 0, 2);
  axes->addWidget(up_, 0, 3);
  axes->setColumnStretch(1, 1);
  axes->setColumnStretch(3, 1);
  auto* charts = new QGridLayout;
  charts->setHorizontalSpacing(12);
  charts->setVerticalSpacing(2);
  charts->addWidget(note(tr("Variance held")), 0, 0);
  charts->addWidget(note(tr("Joints together")), 0, 1);
  charts->addWidget(variance_, 1, 0);
  charts->addWidget(correlation_, 1, 1);
  auto* directions = boxed(in_column({axes, {pad_, 1}, note_, charts, comparison_}, 8));
  views_->setDrawBase(false);
  views_->setExpanding(true);
  views_->setProperty("role", "pages");
  views_->addTab(tr("Directions"));
  views_->addTab(tr("Report"));
  report_->hide();
  connect(views_, &QTabBar::currentChanged, this, [this, directions](int view) {
    directions->setVisible(view == 0);
    report_->setVisible(view == 1);
  });
  return boxed(in_column({views_, {directions, 1}, {report_, 1}}, 8));
}

void PmdExplorer::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  emit shown();
}

void PmdExplorer::show_method(PostureMethod method) {
  method_->setCurrentIndex(static_cast<int>(method));
}

void PmdExplorer::show_errors(const QString& text) {
  errors_->setText(text);
  errors_->setVisible(!text.isEmpty());
}

QWidget* PmdExplorer::build_buttons() {
  save_->setToolTip(tr("Write the basis that is shown, and the postures it is made of, to files"));
  use_->setToolTip(
      tr("The scene names this basis: the planner samples in it, and human-likeness is measured "
         "against it. Undo takes the one before"));
  connect(save_, &QPushButton::clicked, this, [this] { (void)choose_to_save(); });
  connect(use_, &QPushButton::clicked, this, &PmdExplorer::use_shown);
  return boxed(in_row({{save_, 1}, {use_, 1}}, 8));
}

bool PmdExplorer::shows_own_basis() const { return basis_->currentIndex() == kOwnBasis; }

const HandBasis* PmdExplorer::shown_basis() const {
  const int row = basis_->currentIndex();
  const HandBasis* shown = row == kSceneBasis ? &scene_basis_
                           : row == kOwnBasis ? &made_
                           : row < kFirstOther + static_cast<int>(bases_.size())
                               ? &bases_[static_cast<std::size_t>(row - kFirstOther)]
                               : nullptr;
  return shown && shown->basis ? shown : nullptr;
}

void PmdExplorer::list_bases() {
  const QSignalBlocker quiet(basis_);
  const int row = std::max(0, basis_->currentIndex());
  basis_->clear();
  basis_->addItem(scene_basis_.basis ? tr("Of the scene: %1").arg(scene_basis_.name)
                                     : tr("Of the scene"));
  basis_->addItem(tr("Of these postures"));
  for (const HandBasis& basis : bases_) {
    basis_->addItem(basis.name);
  }
  basis_->insertSeparator(basis_->count());
  basis_->addItem(tr("Open a basis…"), kOpenBasis);
  basis_->setCurrentIndex(row);
}

void PmdExplorer::take_choice(int row) {
  if (basis_->itemData(row) == QVariant(kOpenBasis)) {
    basis_->setCurrentIndex(kSceneBasis);
    rebuild_axes();
    choose_to_open();
    return;
  }
  rebuild_axes();
}

void PmdExplorer::set_hand(std::shared_ptr<const geometric::RobotModel> model,
                           const HandBasis& basis) {
  model_ = std::move(model);
  scene_basis_ = basis;
  bases_.clear();
  if (model_) {
    try {
      bases_ = shipped_bases(*model_);
    } catch (const std::exception& error) {
      emit failed(QString::fromUtf8(error.what()));
    }
  }
  q_ = model_ ? model_->neutral() : geometric::Configuration();
  basis_->setCurrentIndex(model_ && !basis.basis ? kOwnBasis : kSceneBasis);
  list_bases();
  rebuild_axes();
}

void PmdExplorer::set_scene_basis(const HandBasis& basis) {
  scene_basis_ = basis;
  if (basis.basis) {
    basis_->setCurrentIndex(kSceneBasis);
  }
  list_bases();
  rebuild_axes();
}

void PmdExplorer::add_basis(HandBasis basis) {
  const auto same = std::ranges::find(bases_, basis.file, &HandBasis::file);
  const auto row = kFirstOther + static_cast<int>(same - bases_.begin());
  if (same == bases_.end()) {
    bases_.push_back(std::move(basis));
  } else {
    *same = std::move(basis);
  }
  list_bases();
  basis_->setCurrentIndex(row);
  rebuild_axes();
}

void PmdExplorer::open(const std::filesystem::path& file) {
  if (model_) {
    add_basis(open_basis(file, *model_));
  }
}

void PmdExplorer::save(const std::filesystem::path& file) {
  if (const HandBasis* shown = shown_basis()) {
    add_basis(save_basis(*shown, file));
  }
}

void PmdExplorer::choose_to_open() {
  const QString file =
      QFileDialog::getOpenFileName(this, tr("Open a hand basis"), {}, tr("Hand bases (*.yaml)"));
  try {
    if (!file.isEmpty()) {
      open(file.toStdString());
    }
  } catch (const std::exception& error) {
    emit failed(QString::fromUtf8(error.what()));
  }
}

bool PmdExplorer::choose_to_save() {
  const QString name = QString::fromStdString(hand_.empty() ? "hand" : hand_);
  const QString file =
      QFileDialog::getSaveFileName(this, tr("Save the hand basis"),
                                   name + QStringLiteral("_basis.yaml"), tr("Hand bases (*.yaml)"));
  try {
    if (!file.isEmpty()) {
      save(file.toStdString());
      return true;
    }
  } catch (const std::exception& error) {
    emit failed(QString::fromUtf8(error.what()));
  }
  return false;
}

void PmdExplorer::use_shown() {
  const HandBasis* shown = shown_basis();
  if (!shown || (shown->file.empty() && !choose_to_save())) {
    return;
  }
  shown = shown_basis();
  emit basis_chosen(shown->file, shown->basis);
}

void PmdExplorer::set_configuration(const geometric::Configuration& q) {
  q_ = q;
  if (moving_ || axes_.dimension() < 2 || !isVisible()) {
    return;
  }
  const Eigen::VectorXd e = axes_.coordinates(q_);
  pad_->set_posture({e[across_->currentIndex()], e[up_->currentIndex()]});
}

void PmdExplorer::show_postures(const CapturedPostures& postures, const QString& source,
                                const std::string& hand) {
  postures_ = postures;
  postures_source_ = source;
  hand_ = hand;
  options_->set_joints(postures_.joints(), postures_.left_out());
  const QSignalBlocker quiet(source_);
  source_->setItemText(kFromFile, source.isEmpty() ? tr("A recording…") : source);
  source_->setCurrentIndex(source.isEmpty() ? kLive : kFromFile);
  if (shows_own_basis()) {
    rebuild_axes();
  } else {
    show_dots();
    show_comparison();
  }
  show_statistics();
}

HandBasis PmdExplorer::made_basis() const {
  HandBasis made{tr("this basis"), {}, nullptr};
  if (!model_ || postures_.count() < kLeastPostures) {
    return made;
  }
  const sampling::PmdBasisOptions options = options_->options();
  const std::string source =
      tr("%1 postures, %2")
          .arg(postures_.count())
          .arg(postures_source_.isEmpty() ? tr("captured live") : postures_source_)
          .toStdString();
  made.basis = std::make_shared<const sampling::PmdBasis>(sampling::make_pmd_basis(
      hand_, source, postures_.joints(), postures_.components(options.free_joints), options));
  made.postures = {hand_, source, postures_.joints(), postures_.table()};
  return made;
}

void PmdExplorer::rebuild_axes() {
  axes_ = {};
  made_ = shows_own_basis() ? made_basis() : HandBasis{};
  options_->setVisible(shows_own_basis() && postures_.count() >= kLeastPostures);
  const HandBasis* shown = shown_basis();
  QString reason;
  if (!model_) {
    reason = tr("Open a scene with a robot first");
  } else if (shown) {
    axes_ = HandAxes(model_, *shown->basis);
  } else if (shows_own_basis()) {
    reason = tr("No postures yet: connect a glove, or choose a recording");
  } else {
    reason =
        tr("The scene names no hand basis. Capture postures, or choose a recording, and "
           "take the basis of these postures");
  }
  save_->setEnabled(shown != nullptr);
  use_->setEnabled(shown != nullptr && shown != &scene_basis_);
  if (axes_.dimension() < 2) {
    pad_->clear(reason.isEmpty() ? tr("The basis does not fit the hand of the scene") : reason);
  }
  show_comparison();
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

// The others are all that could be shown.
void PmdExplorer::show_comparison() {
  const HandBasis* shown = shown_basis();
  std::vector<HandBasis> others;
  const auto add = [&](const HandBasis& basis) {
    if (basis.basis && &basis != shown) {
      others.push_back(basis);
    }
  };
  add(scene_basis_);
  if (!shows_own_basis()) {
    add(made_basis());
  }
  std::ranges::for_each(bases_, add);
  comparison_->set_bases(model_, shown ? std::optional(*shown) : std::nullopt, std::move(others));
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
