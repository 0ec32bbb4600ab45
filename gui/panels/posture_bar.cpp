#include "panels/posture_bar.h"

#include "style/icons.h"
#include "view3d/view_colors.h"

#include <QHBoxLayout>
#include <QMenu>
#include <QPushButton>

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
  postures_->setToolTip(tr("Move to a posture that the robot's files name"));
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
  if (scene && !scene->robots.empty()) {
    for (const auto& posture : scene->robots.front().model->description().postures) {
      const QString name = QString::fromStdString(posture.name);
      const QString group = QString::fromStdString(posture.group);
      menu_->addAction(group.isEmpty() ? name : QStringLiteral("%1: %2").arg(group, name), this,
                       [this, posture] { emit posture_requested(posture); });
    }
  }
  postures_->setEnabled(!menu_->isEmpty());
}

}  // namespace handway::gui
