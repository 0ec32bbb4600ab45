#include "features/tracker/follow_form.h"

#include "handway/geometric/math/units.h"
#include "widgets/forms/quantity_field.h"

#include <QCheckBox>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QGridLayout>
#include <QLabel>
#include <QSpinBox>
#include <QVBoxLayout>

#include <numbers>

namespace handway::gui {
namespace {

using geometric::kDegree;

constexpr double kFarthest = 10.0;  // m
constexpr double kBoxHalf = 0.3;    // m
constexpr double kDefaultReach = 1.0;
constexpr int kAnySensor = -1;
constexpr double kMilli = 1e-3;

QuantityField* length_field(const QString& name) {
  auto* field = new QuantityField(QuantityField::Kind::kLength, -kFarthest, kFarthest);
  field->setButtonSymbols(QAbstractSpinBox::NoButtons);
  field->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
  field->setMinimumWidth(60);
  field->setObjectName(name);
  return field;
}

QLabel* note(const QString& text) {
  auto* label = new QLabel(text);
  label->setProperty("role", "note");
  return label;
}

QLabel* heading(const QString& text) {
  auto* label = new QLabel(text);
  label->setProperty("role", "heading");
  return label;
}

}  // namespace

FollowForm::FollowForm(QWidget* parent)
    : QWidget(parent),
      sensor_(new QSpinBox),
      button_(new QCheckBox(tr("Lead while its button is pressed"))),
      scale_(new QDoubleSpinBox),
      turn_(new QCheckBox(tr("Turn with the wrist"))),
      source_yaw_(
          new QuantityField(QuantityField::Kind::kAngle, -std::numbers::pi, std::numbers::pi)),
      smoothing_(new QSpinBox),
      speed_(
          new QuantityField(QuantityField::Kind::kAngularSpeed, kDegree, 2.0 * std::numbers::pi)),
      box_(new QCheckBox(tr("Keep the tool within a box"))),
      box_fields_(new QWidget),
      limits_reach_(new QCheckBox(tr("Keep it within a reach"))),
      reach_(length_field(QStringLiteral("tracker_reach"))) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(8);
  layout->addWidget(heading(tr("Motion")));
  layout->addWidget(build_motion());
  layout->addWidget(heading(tr("Workspace")));
  layout->addWidget(build_workspace());
}

QWidget* FollowForm::build_motion() {
  sensor_->setRange(kAnySensor, 255);
  sensor_->setValue(kAnySensor);
  sensor_->setSpecialValueText(tr("first"));
  sensor_->setToolTip(tr("Polhemus stations count from 1, senders of datagrams from 0"));
  scale_->setObjectName(QStringLiteral("tracker_scale"));
  scale_->setRange(0.05, 10.0);
  scale_->setSingleStep(0.05);
  scale_->setValue(1.0);
  scale_->setPrefix(QStringLiteral("× "));
  scale_->setToolTip(tr("How far the tool moves for a motion of the wrist"));
  turn_->setObjectName(QStringLiteral("tracker_turn"));
  turn_->setChecked(true);
  source_yaw_->setToolTip(
      tr("How the tracker's source is turned about the vertical, seen from the robot's base"));
  smoothing_->setRange(0, 2000);
  smoothing_->setValue(50);
  smoothing_->setSuffix(tr(" ms"));
  smoothing_->setToolTip(tr("Time constant of the low-pass that calms a trembling hand"));
  speed_->show_quantity(60.0 * kDegree);
  speed_->setToolTip(tr("No joint turns faster, whatever the wrist does"));
  auto* part = new QWidget;
  auto* form = new QFormLayout(part);
  form->setContentsMargins(0, 0, 0, 0);
  form->setHorizontalSpacing(12);
  form->addRow(tr("Sensor"), sensor_);
  form->addRow(button_);
  form->addRow(tr("Scale"), scale_);
  form->addRow(turn_);
  form->addRow(tr("Source turned"), source_yaw_);
  form->addRow(tr("Smoothing"), smoothing_);
  form->addRow(tr("Top speed"), speed_);
  const auto tell = [this] { emit settings_edited(); };
  connect(scale_, qOverload<double>(&QDoubleSpinBox::valueChanged), this, tell);
  connect(turn_, &QCheckBox::toggled, this, tell);
  connect(source_yaw_, &QuantityField::quantity_edited, this, tell);
  connect(smoothing_, qOverload<int>(&QSpinBox::valueChanged), this, tell);
  connect(speed_, &QuantityField::quantity_edited, this, tell);
  return part;
}

QWidget* FollowForm::build_workspace() {
  box_->setObjectName(QStringLiteral("tracker_box"));
  limits_reach_->setObjectName(QStringLiteral("tracker_limits_reach"));
  reach_->setMinimum(1.0);
  reach_->show_quantity(kDefaultReach);
  const auto tell = [this] { emit settings_edited(); };
  auto* grid = new QGridLayout(box_fields_);
  grid->setContentsMargins(22, 0, 0, 0);
  grid->setHorizontalSpacing(6);
  grid->setVerticalSpacing(5);
  grid->addWidget(note(tr("from")), 0, 1);
  grid->addWidget(note(tr("to")), 0, 2);
  constexpr std::array kAxes{"X", "Y", "Z"};
  for (std::size_t i = 0; i < 3; ++i) {
    const int row = static_cast<int>(i) + 1;
    const QString axis = QString::fromLatin1(kAxes.at(i));
    least_.at(i) = length_field(QStringLiteral("tracker_least_") + axis);
    most_.at(i) = length_field(QStringLiteral("tracker_most_") + axis);
    grid->addWidget(note(axis), row, 0);
    grid->addWidget(least_.at(i), row, 1);
    grid->addWidget(most_.at(i), row, 2);
    connect(least_.at(i), &QuantityField::quantity_edited, this, tell);
    connect(most_.at(i), &QuantityField::quantity_edited, this, tell);
  }
  centre_box(Eigen::Vector3d(0.5, 0.0, 0.5));
  auto* part = new QWidget;
  auto* layout = new QVBoxLayout(part);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(6);
  layout->addWidget(box_);
  layout->addWidget(box_fields_);
  limits_reach_->setToolTip(tr("Distance of the tool from the origin of the robot's base"));
  reach_->setMaximumWidth(90);
  auto* reach = new QHBoxLayout;
  reach->addWidget(limits_reach_, 1);
  reach->addWidget(reach_);
  layout->addLayout(reach);
  box_fields_->hide();
  reach_->setEnabled(false);
  connect(box_, &QCheckBox::toggled, box_fields_, &QWidget::setVisible);
  connect(limits_reach_, &QCheckBox::toggled, reach_, &QWidget::setEnabled);
  connect(box_, &QCheckBox::toggled, this, tell);
  connect(limits_reach_, &QCheckBox::toggled, this, tell);
  connect(reach_, &QuantityField::quantity_edited, this, tell);
  return part;
}

void FollowForm::centre_box(const Eigen::Vector3d& p_B) {
  if (box_->isChecked()) {
    return;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const double centre = p_B[static_cast<Eigen::Index>(i)];
    least_.at(i)->show_quantity(centre - kBoxHalf);
    most_.at(i)->show_quantity(centre + kBoxHalf);
  }
}

device::ToolFollowerSettings FollowForm::settings() const {
  device::ToolFollowerSettings settings;
  settings.R_BS = Eigen::AngleAxisd(source_yaw_->quantity(), Eigen::Vector3d::UnitZ()).matrix();
  settings.translation_scale = scale_->value();
  settings.rotate = turn_->isChecked();
  settings.smoothing = smoothing_->value() * kMilli;
  settings.top_speed = speed_->quantity();
  if (box_->isChecked()) {
    for (std::size_t i = 0; i < 3; ++i) {
      const auto axis = static_cast<Eigen::Index>(i);
      settings.workspace.box.min()[axis] = least_.at(i)->quantity();
      settings.workspace.box.max()[axis] = most_.at(i)->quantity();
    }
  }
  if (limits_reach_->isChecked()) {
    settings.workspace.reach = reach_->quantity();
  }
  return settings;
}

std::optional<int> FollowForm::sensor() const {
  return sensor_->value() == kAnySensor ? std::nullopt : std::optional(sensor_->value());
}

bool FollowForm::button_closes() const { return button_->isChecked(); }

}  // namespace handway::gui
