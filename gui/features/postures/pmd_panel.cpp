#include "features/postures/pmd_panel.h"

#include "features/postures/likeness_meter.h"
#include "handway/geometric/robot/normalised_joints.h"
#include "widgets/forms/slider_row.h"

#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>
#include <QVariant>

#include <cmath>

namespace handway::gui {

PmdPanel::PmdPanel(RecordedHand& recorded, QWidget* parent)
    : QWidget(parent),
      axes_(new QWidget),
      axes_layout_(new QVBoxLayout(axes_)),
      note_(new QLabel),
      likeness_(new LikenessMeter(recorded)) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(12, 10, 12, 10);
  layout->setSpacing(8);
  axes_layout_->setContentsMargins(0, 0, 0, 0);
  axes_layout_->setSpacing(3);
  note_->setWordWrap(true);
  note_->setProperty("role", "note");
  note_->setText(
      tr("This scene names no PMD basis for its hand. Set <b>hand_basis</b> in the "
         "scene file to move the hand along its principal motion directions."));
  layout->addWidget(axes_);
  layout->addWidget(note_);
  layout->addWidget(likeness_);
  layout->addStretch();
  connect(likeness_, &LikenessMeter::configuration_edited, this, &PmdPanel::configuration_edited);
}

void PmdPanel::set_hand(std::shared_ptr<const geometric::RobotModel> model,
                        std::shared_ptr<const sampling::PmdBasis> basis,
                        const std::vector<int>& hand) {
  model_ = std::move(model);
  basis_ = std::move(basis);
  hand_ = hand;
  rows_.clear();
  while (QLayoutItem* item = axes_layout_->takeAt(0)) {
    delete item->widget();
    delete item;
  }
  if (!model_ || !basis_ || hand_.size() != basis_->joints.size()) {
    basis_.reset();
  }
  note_->setVisible(!basis_);
  likeness_->set_hand(model_, basis_, hand_);
  if (!basis_) {
    return;
  }
  q_ = model_->neutral();
  auto* heading = new QLabel(tr("Free joints and principal motion directions"));
  heading->setProperty("role", "heading");
  axes_layout_->addWidget(heading);
  for (const sampling::FreeJoint& free : basis_->free_joints) {
    add_axis(QString::fromStdString(basis_->joints[static_cast<std::size_t>(free.joint)]),
             free.half_side, 0.0);
  }
  for (const sampling::PrincipalDirection& direction : basis_->directions) {
    add_axis(QString::fromStdString(direction.name), direction.half_side, direction.variance);
  }
  auto* centre = new QPushButton(tr("Mean posture"));
  centre->setObjectName(QStringLiteral("mean_posture"));
  centre->setToolTip(tr("All coordinates to zero: the mean of the recorded human postures"));
  connect(centre, &QPushButton::clicked, this, [this] {
    for (SliderRow* row : rows_) {
      row->set_value(0.0);
    }
    move_hand();
  });
  axes_layout_->addSpacing(6);
  axes_layout_->addWidget(centre, 0, Qt::AlignLeft);
}

void PmdPanel::add_axis(const QString& name, double half_side, double variance) {
  auto* row = new SliderRow(name, {-half_side, half_side, 1.0, QString(), 3});
  row->set_label_width(128);
  row->setObjectName(name);
  if (variance > 0.0) {
    row->setToolTip(tr("%1: standard deviation %2 of the normalised joints, half side %3")
                        .arg(name)
                        .arg(std::sqrt(variance), 0, 'f', 3)
                        .arg(half_side, 0, 'f', 3));
  }
  connect(row, &SliderRow::value_edited, this, [this] { move_hand(); });
  axes_layout_->addWidget(row);
  rows_.push_back(row);
}

Eigen::VectorXd PmdPanel::hand_posture() const {
  const geometric::Configuration p = geometric::normalised(*model_, q_);
  Eigen::VectorXd posture(static_cast<Eigen::Index>(hand_.size()));
  for (std::size_t i = 0; i < hand_.size(); ++i) {
    posture[static_cast<Eigen::Index>(i)] = p[hand_[i]];
  }
  return posture;
}

void PmdPanel::move_hand() {
  Eigen::VectorXd u(static_cast<Eigen::Index>(rows_.size()));
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const std::size_t free_count = basis_->free_joints.size();
    const double half_side = i < free_count ? basis_->free_joints[i].half_side
                                            : basis_->directions[i - free_count].half_side;
    const double e = half_side > 0.0 ? rows_[i]->value() / half_side : 0.0;
    u[static_cast<Eigen::Index>(i)] = 0.5 * (e + 1.0);
  }
  const Eigen::VectorXd posture = sampling::map_to_posture(*basis_, u);
  geometric::Configuration p = geometric::normalised(*model_, q_);
  for (std::size_t i = 0; i < hand_.size(); ++i) {
    p[hand_[i]] = posture[static_cast<Eigen::Index>(i)];
  }
  q_ = geometric::denormalised(*model_, p);
  likeness_->set_configuration(q_);
  moving_ = true;
  emit configuration_edited(q_);
  moving_ = false;
}

void PmdPanel::set_configuration(const geometric::Configuration& q) {
  q_ = q;
  if (!basis_ || moving_) {
    return;
  }
  const Eigen::VectorXd e = sampling::project(*basis_, hand_posture());
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    rows_[i]->set_value(e[static_cast<Eigen::Index>(i)]);
  }
  likeness_->set_configuration(q_);
}

}  // namespace handway::gui
