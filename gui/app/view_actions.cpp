#include "app/view_actions.h"

#include "app/window_actions.h"
#include "model/document/document.h"
#include "model/settings/preferences.h"
#include "view3d/body_meshes.h"
#include "view3d/scene_view.h"
#include "widgets/style/icons.h"

#include <QActionGroup>
#include <QMainWindow>
#include <QMenu>
#include <QToolBar>
#include <QToolButton>

namespace handway::gui {

BodyDisplayTool::BodyDisplayTool(Document& document, SceneView& view, QObject* parent)
    : QObject(parent), document_(document), view_(view) {
  const auto refresh_unless_visual = [this] {
    if (display_ != BodyDisplay::kVisual) {
      refresh();
    }
  };
  connect(&document_, &Document::opened, this, refresh_unless_visual);
  connect(&document_, &Document::edited, this, refresh_unless_visual);
}

void BodyDisplayTool::show(BodyDisplay display) {
  if (display != display_) {
    display_ = display;
    refresh();
  }
}

void BodyDisplayTool::refresh() {
  if (display_ == BodyDisplay::kVisual || !document_.scene()) {
    job_.cancel();
    view_.stand_in({});
    return;
  }
  job_.run([this, scene = document_.scene(),
            display = display_](const std::stop_token& stop) -> LatestJob::Answer {
    return [this, meshes = body_meshes(*scene, display, stop)] { view_.stand_in(meshes); };
  });
}

ViewActions::ViewActions(QMainWindow& window, WindowActions& others, SceneView& view,
                         BodyDisplayTool& bodies, Preferences& preferences)
    : QObject(&window),
      window_(window),
      view_(view),
      bodies_(bodies),
      preferences_(preferences),
      displays_(new QActionGroup(this)),
      display_button_(new QToolButton) {
  fit_ = make("fit", tr("&Fit"), "F", tr("Show the whole scene"));
  connect(fit_, &QAction::triggered, &view_, &SceneView::fit);
  on_bar_ << fit_;
  QMenu* standard = make_standard_views();
  orthographic_ = make_switch("orthographic", tr("O&rthographic"), "5",
                              tr("Lines that are parallel stay parallel in the picture"), false);
  connect(orthographic_, &QAction::toggled, this, [this](bool on) {
    preferences_.set(&PreferenceValues::projection,
                     on ? Projection::kOrthographic : Projection::kPerspective);
  });
  QMenu* displays = make_displays();
  floor_ = make_switch("grid", tr("Floor &grid"), "G", tr("Show the floor grid"), true);
  connect(floor_, &QAction::toggled, this,
          [this](bool on) { preferences_.set(&PreferenceValues::floor, on); });
  cube_ = make_switch("cube", tr("Orientation &cube"), "",
                      tr("Show the cube with the direction of view"), true);
  connect(cube_, &QAction::toggled, this,
          [this](bool on) { preferences_.set(&PreferenceValues::cube, on); });

  QMenu& menu = *others.view_menu();
  menu.insertAction(others.samples, fit_);
  menu.insertMenu(others.samples, standard);
  menu.insertAction(others.samples, orthographic_);
  menu.insertMenu(others.samples, displays);
  menu.insertSeparator(others.samples);
  menu.insertActions(others.samples, {floor_, cube_});
  QToolBar& bar = *others.bar();
  bar.insertActions(others.samples, on_bar_);
  bar.insertAction(others.samples, orthographic_);
  bar.insertSeparator(others.samples);
  bar.insertWidget(others.samples, display_button_);
  bar.insertAction(others.samples, floor_);
  refresh_icons();
  follow_preferences();
  connect(&preferences_, &Preferences::changed, this, &ViewActions::follow_preferences);
}

QMenu* ViewActions::make_standard_views() {
  auto* menu = new QMenu(tr("&Look from"), &window_);
  const auto add = [&](StandardView from, QAction* action) {
    connect(action, &QAction::triggered, &view_, [this, from] { view_.look_from(from); });
    menu->addAction(action);
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
  return menu;
}

QMenu* ViewActions::make_displays() {
  auto* menu = new QMenu(tr("&Bodies as"), &window_);
  const auto add = [&](BodyDisplay display, QAction* action) {
    action->setCheckable(true);
    action->setChecked(display == bodies_.display());
    displays_->addAction(action);
    menu->addAction(action);
    connect(action, &QAction::triggered, this, [this, display, action] {
      bodies_.show(display);
      display_button_->setIcon(action->icon());
    });
  };
  using enum BodyDisplay;
  add(kVisual, make("bodies_visual", tr("&Visual"), "Alt+1", tr("Bodies as they look")));
  add(kCollision, make("bodies_collision", tr("&Collision meshes"), "Alt+2",
                       tr("The triangles that collisions are checked with")));
  add(kHulls, make("bodies_hulls", tr("Convex &hulls"), "Alt+3",
                   tr("The hulls that part bodies before triangles are compared")));
  add(kSpheres, make("bodies_spheres", tr("Bounding &spheres"), "Alt+4",
                     tr("The spheres that cover bodies before triangles are compared")));
  display_button_->setObjectName(QStringLiteral("display"));
  display_button_->setToolTip(tr("What bodies are drawn as"));
  display_button_->setPopupMode(QToolButton::InstantPopup);
  display_button_->setMenu(menu);
  return menu;
}

void ViewActions::follow_preferences() {
  const PreferenceValues& values = preferences_.values();
  orthographic_->setChecked(values.projection == Projection::kOrthographic);
  floor_->setChecked(values.floor);
  cube_->setChecked(values.cube);
}

QAction* ViewActions::make(const char* name, const QString& text, const char* keys,
                           const QString& tip) {
  QAction* action =
      make_action(window_, QLatin1String(name), text, QKeySequence(QLatin1String(keys)), tip);
  with_icon_ << action;
  return action;
}

QAction* ViewActions::make_switch(const char* name, const QString& text, const char* keys,
                                  const QString& tip, bool on) {
  QAction* action = make(name, text, keys, tip);
  action->setCheckable(true);
  action->setChecked(on);
  return action;
}

void ViewActions::refresh_icons() {
  for (QAction* action : with_icon_) {
    action->setIcon(icon(action->objectName()));
  }
  display_button_->setIcon(displays_->checkedAction()->icon());
}

}  // namespace handway::gui
