#include "features/postures/elbow_swing.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/math/units.h"
#include "model/document/reach_words.h"
#include "widgets/forms/arrangement.h"
#include "widgets/forms/slider_row.h"

#include <QLabel>

#include <cmath>
#include <numbers>

namespace handway::gui {

ElbowSwing::ElbowSwing(QWidget* parent)
    : QWidget(parent),
      slider_(named(
          "elbow_swing",
          new SliderRow(tr("Elbow swing"), {-std::numbers::pi, std::numbers::pi,
                                            1.0 / geometric::kDegree, QStringLiteral("°"), 1}))),
      figures_(named("reach_figures", note())) {
  slider_->setToolTip(tr(
      "Moves the arm while the palm stays where it is (null space), from the posture that it has "
      "now"));
  slider_->use_two_lines();
  figures_->setWordWrap(true);
  figures_->setToolTip(reach_explanation());
  lay_out(*this, in_column({figures_, slider_}, 2), {12, 4, 12, 0});
  connect(slider_, &SliderRow::value_edited, this, &ElbowSwing::swing);
}

void ElbowSwing::set_arm(const std::shared_ptr<const geometric::RobotModel>& model, int palm,
                         const std::vector<int>& arm) {
  model_ = model;
  palm_ = palm;
  arm_ = arm;
  ik_.reset();
  q_ = model ? model->neutral() : geometric::Configuration();
  if (model && !arm.empty()) {
    try {
      auto ik = std::make_unique<const planning::PalmIk>(model, palm, arm);
      ik_ = ik->is_redundant() ? std::move(ik) : nullptr;
    } catch (const geometric::InputError&) {  // no joint moves the palm
    }
  }
  slider_->setVisible(ik_ != nullptr);
  setVisible(model && planning::reach_figures(*model, palm, arm, q_));
}

void ElbowSwing::set_configuration(const geometric::Configuration& q) {
  q_ = q;
  show_figures();
  if (!swinging_) {
    direction_ = {};
    swung_ = 0.0;
    slider_->set_value(0.0);
  }
}

void ElbowSwing::show_figures() {
  const auto figures = model_ ? planning::reach_figures(*model_, palm_, arm_, q_) : std::nullopt;
  QString words = figures ? reach_words(*figures) : QString();
  if (!words.isEmpty()) {
    words[0] = words[0].toUpper();
  }
  figures_->setText(words);
}

void ElbowSwing::swing(double to) {
  constexpr double kLeast = 1e-6;  // rad
  if (!ik_) {
    return;
  }
  if (direction_.size() == 0) {
    X_BP_ = ik_->pose(q_);
  }
  const double by = to - swung_;
  const geometric::Configuration q = ik_->swung(q_, X_BP_, by, direction_);
  const double moved = (q - q_).norm();
  swung_ = moved + kLeast < 0.5 * std::abs(by) ? swung_ + std::copysign(moved, by) : to;
  swinging_ = true;
  emit configuration_edited(q);
  swinging_ = false;
  slider_->set_value(swung_);  // a limit may have ended it
}

}  // namespace handway::gui
