#include "features/planning/group_choice.h"

#include "handway/geometric/setup/moving_group.h"
#include "widgets/forms/arrangement.h"
#include "widgets/style/menu_text.h"

#include <QMenu>
#include <QPushButton>

#include <algorithm>
#include <vector>

namespace handway::gui {

GroupChoice::GroupChoice(SceneEditor& editor, QWidget* parent)
    : QWidget(parent),
      editor_(editor),
      button_(named("moving_group", new QPushButton)),
      menu_(new QMenu(this)) {
  button_->setAccessibleName(tr("What moves"));
  button_->setMenu(menu_);
  button_->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  lay_out(*this, in_row({{button_, 1}}));
  connect(menu_, &QMenu::aboutToShow, this, &GroupChoice::fill_menu);
  connect(&editor_.document(), &Document::opened, this, &GroupChoice::show_scene);
  connect(&editor_.document(), &Document::edited, this, &GroupChoice::show_scene);
  show_scene();
}

void GroupChoice::show_scene() {
  const bool has_robot = editor_.document().robot() != nullptr;
  QStringList names;
  if (has_robot) {
    for (const std::string& name : editor_.state().scene->group) {
      names << QString::fromStdString(name);
    }
  }
  const QString all = tr("All joints");
  const QString list = names.join(QStringLiteral(", "));
  constexpr int kFits = 24;  // letters
  button_->setEnabled(has_robot);
  button_->setText(
      names.isEmpty() ? all
      : list.size() <= kFits
          ? menu_text(list)
          : tr("%1 and %2 more").arg(menu_text(names.front()), QString::number(names.size() - 1)));
  button_->setToolTip(names.isEmpty()
                          ? tr("All joints of the robot may move")
                          : tr("Joints that move: %1. All others stay at the start.").arg(list));
}

void GroupChoice::fill_menu() {
  menu_->clear();
  const geometric::Scene& scene = *editor_.state().scene;
  QAction* all = menu_->addAction(tr("All joints"), this, [this] { editor_.set_group({}); });
  all->setCheckable(true);
  all->setChecked(scene.group.empty());
  menu_->addSeparator();
  const geometric::RobotModel& model = *scene.robots.front().model;
  std::vector<std::string> joints;
  for (const std::string& name : geometric::movable_names(scene)) {
    if (model.find_variable(name)) {
      joints.push_back(name);
    } else {
      add_choice(*menu_, name);
    }
  }
  QMenu* single = menu_->addMenu(tr("Single joints"));
  std::ranges::for_each(joints, [&](const std::string& name) { add_choice(*single, name); });
}

void GroupChoice::add_choice(QMenu& menu, const std::string& name) {
  const std::vector<std::string>& chosen = editor_.state().scene->group;
  QAction* action = menu.addAction(menu_text(name));
  action->setCheckable(true);
  action->setChecked(std::ranges::count(chosen, name) > 0);
  connect(action, &QAction::triggered, this, [this, name](bool on) { toggle(name, on); });
}

void GroupChoice::toggle(const std::string& name, bool on) {
  std::vector<std::string> group = editor_.state().scene->group;
  std::erase(group, name);
  if (on) {
    group.push_back(name);
  }
  editor_.set_group(group);
}

}  // namespace handway::gui
