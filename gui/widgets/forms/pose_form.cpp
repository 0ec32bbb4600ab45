#include "widgets/forms/pose_form.h"

#include "widgets/forms/quantity_field.h"

#include <QGridLayout>
#include <QLabel>

#include <numbers>

namespace handway::gui {
namespace {

constexpr double kFarthest = 100.0;                   // m
constexpr double kFullTurn = 2.0 * std::numbers::pi;  // rad

QuantityField* make_field(QuantityField::Kind kind, double most, const char* name) {
  auto* field = new QuantityField(kind, -most, most);
  field->setButtonSymbols(QAbstractSpinBox::NoButtons);
  field->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
  field->setObjectName(QLatin1String(name));
  field->setMinimumWidth(60);
  return field;
}

QLabel* make_label(const QString& text) {
  auto* label = new QLabel(text);
  label->setProperty("role", "note");
  return label;
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
  layout->setColumnStretch(1, 5);
  layout->setColumnStretch(3, 4);
  for (std::size_t i = 0; i < 3; ++i) {
    const int row = static_cast<int>(i);
    position_.at(i) = make_field(QuantityField::Kind::kLength, kFarthest, kPositionNames.at(i));
    rotation_.at(i) = make_field(QuantityField::Kind::kAngle, kFullTurn, kRotationNames.at(i));
    layout->addWidget(make_label(QLatin1String(kPositions.at(i))), row, 0);
    layout->addWidget(position_.at(i), row, 1);
    layout->addWidget(make_label(rotations.at(i)), row, 2);
    layout->addWidget(rotation_.at(i), row, 3);
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
  for (std::size_t i = 0; i < 3; ++i) {
    position_.at(i)->setReadOnly(!editable);
    rotation_.at(i)->setReadOnly(!editable);
  }
}

}  // namespace handway::gui
