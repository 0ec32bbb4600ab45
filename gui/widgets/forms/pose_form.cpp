#include "widgets/forms/pose_form.h"

#include "widgets/forms/arrangement.h"
#include "widgets/style/theme.h"

#include <QAbstractSpinBox>
#include <QGridLayout>
#include <QLabel>
#include <QString>

#include <algorithm>
#include <cstddef>
#include <numbers>

namespace handway::gui {
namespace {

constexpr double kFarthest = 100.0;                   // m
constexpr double kFullTurn = 2.0 * std::numbers::pi;  // rad

constexpr int kAroundText = 18;  // px

QString longest_text(QuantityField::Kind kind) {
  return kind == QuantityField::Kind::kLength ? QStringLiteral("−1000.000 mm")
                                              : QStringLiteral("−180.000°");
}

QuantityField* make_field(QuantityField::Kind kind, double most, const char* name) {
  auto* field = new QuantityField(kind, -most, most);
  field->setButtonSymbols(QAbstractSpinBox::NoButtons);
  field->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
  field->setObjectName(QLatin1String(name));
  field->setMinimumWidth(field->fontMetrics().horizontalAdvance(longest_text(kind)) + kAroundText);
  return field;
}

}  // namespace

PoseForm::PoseForm(QWidget* parent) : QWidget(parent) {
  constexpr std::array kPositions{"X", "Y", "Z"};
  constexpr std::array kPositionNames{"position_x", "position_y", "position_z"};
  constexpr std::array kRotationNames{"roll", "pitch", "yaw"};
  const std::array<QString, 3> rotations{tr("Roll"), tr("Pitch"), tr("Yaw")};
  auto* layout = new QGridLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setHorizontalSpacing(6);
  layout->setVerticalSpacing(5);
  for (std::size_t i = 0; i < 3; ++i) {
    const int row = static_cast<int>(i);
    position_.at(i) = make_field(QuantityField::Kind::kLength, kFarthest, kPositionNames.at(i));
    rotation_.at(i) = make_field(QuantityField::Kind::kAngle, kFullTurn, kRotationNames.at(i));
    labels_.at(i) = note(QLatin1String(kPositions.at(i)));
    labels_.at(i + 3) = note(rotations.at(i));
    connect(position_.at(i), &QuantityField::quantity_edited, this, [this, row](double value) {
      geometric::Pose X = X_;
      X.translation()[row] = value;
      emit pose_edited(X);
    });
    connect(rotation_.at(i), &QuantityField::quantity_edited, this, [this] {
      const geometric::Pose turned =
          geometric::pose_from_rpy(X_.translation(), rotation_[0]->quantity(),
                                   rotation_[1]->quantity(), rotation_[2]->quantity());
      emit pose_edited(turned);
    });
  }
  for (const auto& fields : {position_, rotation_}) {  // in the order of the Tab key
    std::ranges::for_each(fields, [this](QWidget* field) { field->setParent(this); });
  }
  arrange(true);
}

void PoseForm::arrange(bool narrow) {
  auto* grid = qobject_cast<QGridLayout*>(layout());
  for (std::size_t i = 0; i < 3; ++i) {
    const int row = static_cast<int>(i);
    const int below = narrow ? row + 3 : row;
    const int beside = narrow ? 0 : 2;
    grid->addWidget(labels_.at(i), row, 0);
    grid->addWidget(position_.at(i), row, 1);
    grid->addWidget(labels_.at(i + 3), below, beside);
    grid->addWidget(rotation_.at(i), below, beside + 1);
  }
  grid->setColumnStretch(1, 5);
  grid->setColumnStretch(3, narrow ? 0 : 4);
  is_narrow_ = narrow;
  // The layout around may be at work just now.
  QMetaObject::invokeMethod(this, &QWidget::updateGeometry, Qt::QueuedConnection);
}

int PoseForm::width_of_columns() const {
  const int space = layout()->contentsMargins().left() +
                    3 * qobject_cast<QGridLayout*>(layout())->horizontalSpacing();
  return labels_[0]->sizeHint().width() + position_[0]->minimumWidth() +
         labels_[4]->sizeHint().width() + rotation_[0]->minimumWidth() + space;
}

// With all fields below each other.
QSize PoseForm::minimumSizeHint() const {
  const int label = labels_[4]->sizeHint().width();
  const int space = qobject_cast<QGridLayout*>(layout())->horizontalSpacing();
  return {label + space + position_[0]->minimumWidth(), layout()->minimumSize().height()};
}

void PoseForm::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  const bool narrow = width() < width_of_columns();
  if (narrow != is_narrow_) {
    arrange(narrow);
  }
}

void PoseForm::show_pose(const geometric::Pose& X) {
  X_ = X;
  const Eigen::Vector3d rpy = geometric::rpy_from_rotation(X.linear());
  for (std::size_t i = 0; i < 3; ++i) {
    position_.at(i)->show_quantity(X.translation()[static_cast<Eigen::Index>(i)]);
    rotation_.at(i)->show_quantity(rpy[static_cast<Eigen::Index>(i)]);
  }
}

void PoseForm::set_editable(bool editable) {
  for (QuantityField* field :
       {position_[0], position_[1], position_[2], rotation_[0], rotation_[1], rotation_[2]}) {
    if (field->isReadOnly() == editable) {
      field->setReadOnly(!editable);
      field->setFocusPolicy(editable ? Qt::StrongFocus : Qt::ClickFocus);
      set_role(*field, editable ? QString() : QStringLiteral("shown"));
    }
  }
}

}  // namespace handway::gui
