#include "app/view_actions.h"

#include "app/window_actions.h"
#include "style/icons.h"
#include "view3d/scene_view.h"

#include <QMainWindow>
#include <QMenu>
#include <QToolBar>

namespace handway::gui {

ViewActions::ViewActions(QMainWindow& window, WindowActions& others, SceneView& view)
    : QObject(&window), window_(window), view_(view) {
  fit = make("fit", tr("&Fit"), "F", tr("Show the whole scene"));
  connect(fit, &QAction::triggered, &view_, &SceneView::fit);
  on_bar_ << fit;
  auto* standard = new QMenu(tr("&Look from"), &window_);
  add_standard_views(*standard);
  floor = make("grid", tr("Floor &grid"), "G", tr("Show the floor grid"));
  floor->setCheckable(true);
  floor->setChecked(true);
  connect(floor, &QAction::toggled, &view_, &SceneView::set_floor_visible);

  QMenu& menu = *others.view_menu();
  menu.insertAction(others.samples, fit);
  menu.insertMenu(others.samples, standard);
  menu.insertSeparator(others.samples);
  menu.insertAction(others.samples, floor);
  QToolBar& bar = *others.bar();
  bar.insertActions(others.samples, on_bar_);
  bar.insertSeparator(others.samples);
  bar.insertAction(others.samples, floor);
  refresh_icons();
}

void ViewActions::add_standard_views(QMenu& menu) {
  const auto add = [&](StandardView from, QAction* action) {
    connect(action, &QAction::triggered, &view_, [this, from] { view_.look_from(from); });
    menu.addAction(action);
    return action;
  };
  using enum StandardView;
  on_bar_ << add(kOblique, make("view_oblique", tr("&Oblique"), "0", tr("Look across the task")))
          << add(kFront, make("view_front", tr("&Front"), "1", tr("Look against the x axis")))
          << add(kLeft, make("view_left", tr("&Left"), "2", tr("Look against the y axis")))
          << add(kTop, make("view_top", tr("&Top"), "3", tr("Look down")));
  add(kBack, make("view_back", tr("&Back"), "Ctrl+1", tr("Look along the x axis")));
  add(kRight, make("view_right", tr("&Right"), "Ctrl+2", tr("Look along the y axis")));
  add(kBottom, make("view_bottom", tr("Botto&m"), "Ctrl+3", tr("Look up from below")));
}

QAction* ViewActions::make(const char* name, const QString& text, const char* keys,
                           const QString& tip) {
  auto* action = new QAction(text, &window_);
  action->setObjectName(QLatin1String(name));
  action->setShortcut(QKeySequence(QLatin1String(keys)));
  action->setStatusTip(tip);
  action->setToolTip(
      QStringLiteral("%1 (%2)").arg(tip, action->shortcut().toString(QKeySequence::NativeText)));
  with_icon_ << action;
  return action;
}

void ViewActions::refresh_icons() {
  for (QAction* action : with_icon_) {
    action->setIcon(icon(action->objectName()));
  }
}

}  // namespace handway::gui
