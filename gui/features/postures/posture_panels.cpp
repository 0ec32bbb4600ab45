#include "features/postures/posture_panels.h"

#include "features/postures/joint_panel.h"
#include "features/postures/pmd_panel.h"
#include "model/document/document.h"
#include "model/document/selection.h"
#include "model/playback/posing.h"
#include "model/settings/view_colors.h"
#include "widgets/panels/dock_layout.h"
#include "widgets/style/icons.h"

#include <QHBoxLayout>
#include <QMenu>
#include <QPushButton>

#include <algorithm>

namespace handway::gui {
namespace {

QColor to_qcolor(const geometric::Color& color) {
  return QColor::fromRgbF(color.red, color.green, color.blue);
}

}  // namespace

PostureBar::PostureBar(QWidget* parent)
    : QWidget(parent),
      start_(new QPushButton(icon("start", to_qcolor(kStartColor)), tr("Start"))),
      goal_(new QPushButton(icon("goal", to_qcolor(kGoalColor)), tr("Goal"))),
      postures_(new QPushButton(tr("Postures"))),
      menu_(new QMenu(this)) {
  start_->setToolTip(tr("Go to start"));
  goal_->setToolTip(tr("Go to goal"));
  postures_->setToolTip(tr("Go to a posture that has a name, or keep this one under a name"));
  start_->setObjectName(QStringLiteral("go_to_start"));
  goal_->setObjectName(QStringLiteral("go_to_goal"));
  postures_->setObjectName(QStringLiteral("postures"));
  postures_->setMenu(menu_);
  auto* layout = new QHBoxLayout(this);
  layout->setContentsMargins(12, 10, 12, 2);
  layout->setSpacing(8);
  for (QPushButton* button : {start_, goal_, postures_}) {
    layout->addWidget(button, 1);
  }
  connect(start_, &QPushButton::clicked, this, &PostureBar::start_requested);
  connect(goal_, &QPushButton::clicked, this, &PostureBar::goal_requested);
  set_scene(nullptr);
}

void PostureBar::set_scene(const std::shared_ptr<const geometric::Scene>& scene) {
  menu_->clear();
  start_->setEnabled(scene && scene->start);
  goal_->setEnabled(scene && scene->goal);
  const bool has_robot = scene && !scene->robots.empty();
  if (has_robot) {
    list_postures(*scene);
  }
  postures_->setEnabled(has_robot);
}

void PostureBar::list_postures(const geometric::Scene& scene) {
  const auto add = [this](const geometric::NamedPosture& posture) {
    const QString name = QString::fromStdString(posture.name);
    const QString group = QString::fromStdString(posture.group);
    menu_->addAction(group.isEmpty() ? name : QStringLiteral("%1: %2").arg(group, name), this,
                     [this, posture] { emit posture_requested(posture); });
  };
  std::ranges::for_each(scene.postures, add);
  menu_->addSeparator();
  std::ranges::for_each(scene.robots.front().model->description().postures, add);
  menu_->addSeparator();
  menu_->addAction(tr("Keep this posture…"), this, &PostureBar::keep_requested);
  if (!scene.postures.empty()) {
    QMenu* forget = menu_->addMenu(tr("Forget"));
    forget->setObjectName(QStringLiteral("forget_posture"));
    for (const geometric::NamedPosture& posture : scene.postures) {
      const QString name = QString::fromStdString(posture.name);
      forget->addAction(name, this, [this, name] { emit forget_requested(name); });
    }
  }
}

PosturePanels::PosturePanels(Document& document, Posing& posing, QObject* parent)
    : QObject(parent),
      document_(document),
      postures_(new PostureBar),
      joints_(new JointPanel),
      hand_(new PmdPanel(document.recorded_hand())) {
  connect(joints_, &JointPanel::configuration_edited, &posing, &Posing::set);
  connect(hand_, &PmdPanel::configuration_edited, &posing, &Posing::set);
  connect(postures_, &PostureBar::posture_requested, &posing, &Posing::apply);
  connect(postures_, &PostureBar::start_requested, &posing,
          [this, &posing] { posing.set(*document_.scene()->start); });
  connect(postures_, &PostureBar::goal_requested, &posing,
          [this, &posing] { posing.set(*document_.scene()->goal); });
  connect(&document_, &Document::configuration_changed, this, [this](const Eigen::VectorXd& q) {
    joints_->set_configuration(q);
    hand_->set_configuration(q);
  });
  connect(&document_, &Document::edited, this, [this](const SceneState& before) {
    if (before.scene != document_.scene()) {
      postures_->set_scene(document_.scene());
    }
  });
}

void PosturePanels::show_robot() {
  const geometric::RobotInstance* robot = document_.robot();
  const auto model = robot ? robot->model : nullptr;
  postures_->set_scene(document_.scene());
  joints_->set_robot(model, document_.groups());
  hand_->set_hand(model, document_.loaded().basis, document_.groups().hand);
}

void PosturePanels::show_item(const SceneItem& item) const {
  const geometric::RobotInstance* robot = document_.robot();
  if (robot && item.kind == SceneItem::Kind::kLink && item.robot == robot->name) {
    bring_to_front(*joints_);
    joints_->show_link(item.name);
  }
}

}  // namespace handway::gui
