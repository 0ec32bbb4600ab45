#include "features/postures/posing.h"

#include "features/glove/glove_panel.h"
#include "features/postures/joint_panel.h"
#include "features/postures/pmd_panel.h"
#include "features/postures/posture_bar.h"
#include "model/document/document.h"
#include "model/document/scene_item.h"
#include "model/playback/path_player.h"
#include "widgets/panels/front_page.h"

namespace handway::gui {

Posing::Posing(Document& document, PathPlayer& player, QObject* parent)
    : QObject(parent),
      document_(document),
      player_(player),
      postures_(new PostureBar),
      joints_(new JointPanel),
      hand_(new PmdPanel(document.recorded_hand())),
      glove_(new GlovePanel) {
  connect_panels();
  connect(&document_, &Document::configuration_changed, this, [this](const Eigen::VectorXd& q) {
    joints_->set_configuration(q);
    hand_->set_configuration(q);
    glove_->set_configuration(q);
  });
  connect(&document_, &Document::edited, this, [this](const SceneState& before) {
    if (before.scene != document_.scene()) {
      postures_->set_scene(document_.scene());
    }
  });
}

void Posing::connect_panels() {
  connect(joints_, &JointPanel::configuration_edited, this, &Posing::set);
  connect(hand_, &PmdPanel::configuration_edited, this, &Posing::set);
  connect(glove_, &GlovePanel::posture_changed, this, &Posing::apply);
  connect(postures_, &PostureBar::posture_requested, this, &Posing::apply);
  connect(postures_, &PostureBar::start_requested, this,
          [this] { set(*document_.scene()->start); });
  connect(postures_, &PostureBar::goal_requested, this, [this] { set(*document_.scene()->goal); });
}

void Posing::show_robot() {
  const geometric::RobotInstance* robot = document_.robot();
  const auto model = robot ? robot->model : nullptr;
  postures_->set_scene(document_.scene());
  joints_->set_robot(model, document_.groups());
  glove_->set_hand(model, document_.loaded().basis, document_.problem());
  hand_->set_hand(model, document_.loaded().basis, document_.groups().hand);
}

void Posing::set(const Eigen::VectorXd& q) {
  player_.pause();
  document_.set_configuration(q);
}

void Posing::show_item(const SceneItem& item) const {
  const geometric::RobotInstance* robot = document_.robot();
  if (robot && item.kind == SceneItem::Kind::kLink && item.robot == robot->name) {
    bring_to_front(*joints_);
    joints_->show_link(item.name);
  }
}

void Posing::apply(const geometric::NamedPosture& posture) {
  player_.pause();
  document_.apply_posture(posture);
}

}  // namespace handway::gui
