#include "app/view_actions.h"

#include "features/workbench.h"
#include "model/document/document.h"
#include "model/settings/preferences.h"
#include "view3d/body_meshes.h"
#include "view3d/scene_view.h"
#include "widgets/forms/arrangement.h"
#include "widgets/forms/quantity_field.h"
#include "widgets/style/desktop_theme.h"
#include "widgets/style/icons.h"

#include <QAbstractButton>
#include <QAbstractSpinBox>
#include <QActionGroup>
#include <QApplication>
#include <QKeyEvent>
#include <QLineEdit>
#include <QMainWindow>
#include <QMenu>
#include <QToolButton>

#include <cmath>
#include <utility>

namespace handway::gui {
namespace {

constexpr int kTickMs = 500;
constexpr int kFewFrames = 3;  // one or two are no motion

}  // namespace

FrameRateLabel::FrameRateLabel(SceneView& view, QWidget* parent) : QLabel(parent), view_(view) {
  setObjectName(QStringLiteral("frame_rate"));
  setProperty("role", "note");
  setAlignment(Qt::AlignRight | Qt::AlignVCenter);
  setMinimumWidth(fontMetrics().horizontalAdvance(tr("%1 frames/s").arg(8888)));
  setToolTip(tr("Frame rate of the view during motions"));
  tick_.setInterval(kTickMs);
  connect(&tick_, &QTimer::timeout, this, &FrameRateLabel::show_rate);
  connect(&view_, &QOpenGLWidget::frameSwapped, this, &FrameRateLabel::count_frame);
}

void FrameRateLabel::count_frame() {
  ++frames_;
  if (!tick_.isActive()) {
    since_.start();
    tick_.start();
  }
}

void FrameRateLabel::show_rate() {
  if (frames_ < kFewFrames) {
    tick_.stop();
    clear();
  } else {
    const double rate = 1e3 * frames_ / static_cast<double>(since_.restart());
    setText(tr("%1 frames/s").arg(std::lround(rate)));
    setToolTip(tr("The last picture took %1 ms").arg(view_.frame_time_ms(), 0, 'f', 1));
  }
  frames_ = 0;
}

PreferenceEffects::PreferenceEffects(Workbench& workbench)
    : QObject(&workbench),
      preferences_(workbench.preferences),
      view_(workbench.view),
      planning_(workbench.plan_settings),
      applied_(workbench.preferences.values()) {
  apply_at_once(applied_);
  planning_.set_usual_planner(applied_.planner.toStdString());
  planning_.set_usual_threads(applied_.threads);
  planning_.set_usual_time_limit(applied_.time_limit);
  connect(&preferences_, &Preferences::changed, this, &PreferenceEffects::follow);
}

void PreferenceEffects::apply_at_once(const PreferenceValues& values) {
  view_.set_projection(values.projection);
  view_.set_navigation(values.navigation);
  view_.set_floor_visible(values.floor);
  view_.set_cube_visible(values.cube);
  view_.set_samples(values.samples);
  view_.set_shadows(values.shadows);
  view_.set_always_fine(values.always_fine);
  view_.set_frame_limit(values.frame_limit);
  QuantityField::show_units(values.units);
}

// The panel's fields are for one run each: only a preference that has changed is put there.
void PreferenceEffects::apply_to_planning(const PreferenceValues& values) {
  if (values.planner != applied_.planner) {
    planning_.set_usual_planner(values.planner.toStdString());
  }
  if (values.threads != applied_.threads) {
    planning_.set_usual_threads(values.threads);
  }
  if (values.time_limit != applied_.time_limit) {
    planning_.set_usual_time_limit(values.time_limit);
  }
}

void PreferenceEffects::follow() {
  const PreferenceValues& values = preferences_.values();
  apply_at_once(values);
  apply_to_planning(values);
  const bool recolor = values.theme != std::exchange(applied_, values).theme;
  if (recolor) {
    emit theme_changed(values.theme ? *values.theme : desktop_theme());
  }
}

EnterKey::EnterKey(QWidget& window, QWidget& view)
    : QObject(&window), window_(window), view_(view) {
  qApp->installEventFilter(this);
}

bool EnterKey::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() != QEvent::KeyPress || watched != window_.focusWidget()) {
    return QObject::eventFilter(watched, event);
  }
  const auto* pressed = static_cast<QKeyEvent*>(event);
  if (pressed->key() != Qt::Key_Return && pressed->key() != Qt::Key_Enter) {
    return QObject::eventFilter(watched, event);
  }
  if (qobject_cast<QAbstractButton*>(watched)) {
    for (const QEvent::Type half : {QEvent::KeyPress, QEvent::KeyRelease}) {
      QCoreApplication::postEvent(
          watched, new QKeyEvent(half, Qt::Key_Space, pressed->modifiers(), QStringLiteral(" ")));
    }
    return true;
  }
  if (qobject_cast<QLineEdit*>(watched) || qobject_cast<QAbstractSpinBox*>(watched)) {
    QMetaObject::invokeMethod(
        &view_, [this] { view_.setFocus(); }, Qt::QueuedConnection);
  }
  return QObject::eventFilter(watched, event);
}

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

ViewActions::ViewActions(Workbench& workbench, BodyDisplayTool& bodies)
    : QObject(&workbench),
      workbench_(workbench),
      view_(workbench.view),
      bodies_(bodies),
      preferences_(workbench.preferences),
      displays_(new QActionGroup(this)),
      display_button_(named("display", new QToolButton)),
      views_button_(named("views", new QToolButton)) {
  show_all_ = make("", tr("Show &all"), "Shift+F", tr("Show the whole scene"));
  show_all_->setObjectName(QStringLiteral("show_all"));
  connect(show_all_, &QAction::triggered, &view_, &SceneView::show_all);
  show_selection_ = make("fit", tr("Show selec&tion"), "F",
                         tr("Show the selection or, without a selection, the whole scene"));
  connect(show_selection_, &QAction::triggered, &view_, &SceneView::show_selection);
  standard_views_ = make_standard_views();
  views_button_->setToolTip(tr("Standard views"));
  views_button_->setPopupMode(QToolButton::InstantPopup);
  views_button_->setMenu(standard_views_);
  orthographic_ = make_switch("orthographic", tr("O&rthographic"), "5",
                              tr("Orthographic projection: parallel lines stay parallel"), false);
  connect(orthographic_, &QAction::toggled, this, [this](bool on) {
    preferences_.set(&PreferenceValues::projection,
                     on ? Projection::kOrthographic : Projection::kPerspective);
  });
  displays_menu_ = make_displays();
  floor_ = make_switch("grid", tr("Floor &grid"), "G", tr("Show the floor grid"), true);
  connect(floor_, &QAction::toggled, this,
          [this](bool on) { preferences_.set(&PreferenceValues::floor, on); });
  cube_ = make_switch("cube", tr("Orientation &cube"), "",
                      tr("Show the cube with the direction of view"), true);
  connect(cube_, &QAction::toggled, this,
          [this](bool on) { preferences_.set(&PreferenceValues::cube, on); });
  place_actions();
  refresh_icon();
  follow_preferences();
  connect(&workbench_, &Workbench::theme_changed, this, &ViewActions::refresh_icon);
  connect(&preferences_, &Preferences::changed, this, &ViewActions::follow_preferences);
}

void ViewActions::place_actions() {
  workbench_.add_to_menu(MainMenu::kView, {0, 0}, show_selection_);
  workbench_.add_to_menu(MainMenu::kContext, {6, 0}, show_selection_);
  workbench_.add_to_menu(MainMenu::kContext, {6, 1}, show_all_);
  workbench_.add_to_menu(MainMenu::kView, {0, 1}, standard_views_->menuAction());
  workbench_.add_to_menu(MainMenu::kView, {0, 2}, orthographic_);
  workbench_.add_to_menu(MainMenu::kView, {0, 3}, displays_menu_->menuAction());
  workbench_.add_to_menu(MainMenu::kView, {1, 0}, floor_);
  workbench_.add_to_bar(MainBar::kTools, {2, 0}, show_selection_);
  workbench_.add_to_bar(MainBar::kTools, {2, 1}, views_button_);
  workbench_.add_to_bar(MainBar::kTools, {3, 0}, display_button_);
  workbench_.add_to_bar(MainBar::kTools, {3, 1}, floor_);
}

QMenu* ViewActions::make_standard_views() {
  auto* menu = new QMenu(tr("Standard &views"), &workbench_.window);
  menu->addAction(show_all_);
  menu->addSeparator();
  const auto add = [&](StandardView from, QAction* action) {
    connect(action, &QAction::triggered, &view_, [this, from] { view_.look_from(from); });
    menu->addAction(action);
    return action;
  };
  using enum StandardView;
  add(kOblique, make("view_oblique", tr("&Oblique"), "0", tr("Task view")));
  add(kFront, make("view_front", tr("&Front"), "1", tr("Look against the x axis")));
  add(kLeft, make("view_left", tr("&Left"), "2", tr("Look against the y axis")));
  add(kTop, make("view_top", tr("&Top"), "3", tr("Look down")));
  add(kBack, make("view_back", tr("&Back"), "Ctrl+1", tr("Look along the x axis")));
  add(kRight, make("view_right", tr("&Right"), "Ctrl+2", tr("Look along the y axis")));
  add(kBottom, make("view_bottom", tr("Botto&m"), "Ctrl+3", tr("Look up from below")));
  return menu;
}

QMenu* ViewActions::make_displays() {
  auto* menu = new QMenu(tr("&Display style"), &workbench_.window);
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
  add(kVisual, make("bodies_visual", tr("&Visual"), "Alt+1", tr("Visual meshes")));
  add(kCollision, make("bodies_collision", tr("&Collision meshes"), "Alt+2",
                       tr("Triangles of the collision checks")));
  add(kHulls, make("bodies_hulls", tr("Convex &hulls"), "Alt+3",
                   tr("Convex hulls that are tested before triangles")));
  add(kSpheres, make("bodies_spheres", tr("Bounding &spheres"), "Alt+4",
                     tr("Bounding spheres that are tested before triangles")));
  display_button_->setToolTip(tr("Display style"));
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
  return workbench_.make_action(QLatin1String(name), text, QKeySequence(QLatin1String(keys)), tip);
}

QAction* ViewActions::make_switch(const char* name, const QString& text, const char* keys,
                                  const QString& tip, bool on) {
  QAction* action = make(name, text, keys, tip);
  action->setCheckable(true);
  action->setChecked(on);
  return action;
}

void ViewActions::refresh_icon() {
  display_button_->setIcon(displays_->checkedAction()->icon());
  views_button_->setIcon(icon("view_oblique"));
}

}  // namespace handway::gui
