#include "app/window_actions.h"

#include "app/file_commands.h"
#include "handway/geometric/io/resources.h"
#include "widgets/style/icons.h"

#include <QMainWindow>
#include <QMenuBar>
#include <QToolBar>
#include <QToolButton>

namespace handway::gui {

WindowActions::WindowActions(QMainWindow& window) : window_(window) {
  const auto tr = [](const char* text) { return QObject::tr(text); };
  open = make("open", tr("&Open…"), QKeySequence::Open, tr("Open a scene or problem file"));
  create = new QMenu(tr("&New with"), &window);
  recent = new RecentFiles(&window);
  save = make("save", tr("&Save"), QKeySequence::Save, tr("Save the scene"));
  save_as = make("", tr("Save &as…"), QKeySequence::SaveAs, tr("Save the scene under a name"));
  picture = make("camera", tr("Save &picture…"), {}, tr("Save a picture of the 3-D view"));
  export_path = make("", tr("&Export the path…"), QKeySequence(QStringLiteral("Ctrl+E")),
                     tr("Time the path and write it for a controller"));
  pictures = make("", tr("Export p&ictures of the path…"), {},
                  tr("Film strip, frames, film or animation of the path"));
  pictures->setObjectName(QStringLiteral("pictures"));
  preferences = make("preferences", tr("Pre&ferences…"), QKeySequence(QStringLiteral("Ctrl+,")),
                     tr("How the workbench looks and behaves"));
  quit = make("", tr("&Quit"), QKeySequence::Quit, {});
  plan = make("route", tr("&Plan"), QKeySequence(QStringLiteral("Ctrl+P")),
              tr("Find a path from start to goal"));
  cancel = make("cancel", tr("&Cancel"), QKeySequence(Qt::Key_Escape), tr("Stop planning"));
  optimize = make("", tr("Keep &optimising"), QKeySequence(QStringLiteral("Ctrl+Alt+P")),
                  tr("Make the path that is shown better for the planner's objective"));
  optimize->setObjectName(QStringLiteral("optimize_action"));
  compare = make("", tr("Compare two &paths…"), {}, tr("Two paths side by side"));
  compare->setObjectName(QStringLiteral("compare"));
  set_start = make("start", tr("Set &start here"), {}, tr("Start from the posture that is shown"));
  set_goal = make("goal", tr("Set &goal here"), {}, tr("End in the posture that is shown"));
  keep_posture =
      make("", tr("&Keep this posture…"), {}, tr("Give the posture a name, in the scene"));
  keep_posture->setObjectName(QStringLiteral("keep_posture"));
  samples = make("samples", tr("&Roadmap"), QKeySequence(Qt::Key_N),
                 tr("Show the planner's nodes, where the palm is in each, and its edges"));
  hypercubes = make("", tr("&Hypercubes"), QKeySequence(QStringLiteral("Shift+N")),
                    tr("Show where the palm goes in the hypercubes that are searched"));
  hypercubes->setObjectName(QStringLiteral("hypercubes"));
  dark = make("theme", tr("&Dark theme"), {}, tr("Light or dark colours"));
  palette = make("", tr("Find a &command…"), QKeySequence(QStringLiteral("Ctrl+Shift+P")),
                 tr("All commands, by a few letters of their names"));
  help = make("", tr("Help on this &panel"), QKeySequence::HelpContents,
              tr("What the panel under the pointer is for"));
  default_layout = make("", tr("&Reset the layout"), {}, tr("Put all panels back"));
  about = make("", tr("&About Handway"), {}, {});
  for (QAction* action : {samples, hypercubes, dark}) {
    action->setCheckable(true);
  }
  samples->setChecked(true);
  cancel->setEnabled(false);
  export_path->setObjectName(QStringLiteral("export_path"));
  export_path->setEnabled(false);
  pictures->setEnabled(false);
  optimize->setEnabled(false);
  compare->setEnabled(false);
  save->setEnabled(false);
  save_as->setEnabled(false);

  QMenu* file_menu = window.menuBar()->addMenu(tr("&File"));
  file_menu->addMenu(create);
  file_menu->addAction(open);
  file_menu->addMenu(recent);
  file_menu->addSeparator();
  file_menu->addActions({save, save_as});
  file_menu->addActions({picture, pictures, export_path});
  file_menu->addSeparator();
  file_menu->addAction(preferences);
  file_menu->addSeparator();
  file_menu->addAction(quit);
  edit_menu_ = window.menuBar()->addMenu(tr("&Edit"));
  add_menu_ = window.menuBar()->addMenu(tr("&Add"));
  QMenu* plan_menu = window.menuBar()->addMenu(tr("&Plan"));
  plan_menu->addActions({plan, cancel, optimize, compare});
  plan_menu->addSeparator();
  plan_menu->addActions({set_start, set_goal, keep_posture});
  view_menu_ = window.menuBar()->addMenu(tr("&View"));
  view_menu_->addActions({samples, hypercubes, dark});
  view_menu_->addSeparator();
  window.menuBar()->addMenu(tr("&Help"))->addActions({help, palette, about});

  bar_ = window.addToolBar(tr("Tools"));
  bar_->setObjectName(QStringLiteral("tools"));
  bar_->setMovable(false);
  bar_->setIconSize({20, 20});
  bar_->addActions({open, save});
  bar_->addSeparator();
  bar_->addActions({plan, cancel});
  bar_->addSeparator();
  bar_->addActions({samples, dark, picture});
  for (const std::string& robot : geometric::resource_names(geometric::ResourceKind::kRobot)) {
    create->addAction(QString::fromStdString(robot))->setData(QString::fromStdString(robot));
  }
  for (QAction* named : {open, save, plan, cancel}) {
    qobject_cast<QToolButton*>(bar_->widgetForAction(named))
        ->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  }
  edit_bar_ = window.addToolBar(tr("Editing"));
  edit_bar_->setObjectName(QStringLiteral("editing"));
  edit_bar_->setMovable(false);
  edit_bar_->setIconSize({20, 20});
  window.setContextMenuPolicy(Qt::NoContextMenu);
  refresh_icons();
}

QAction* WindowActions::make(const QString& name, const QString& text, const QKeySequence& keys,
                             const QString& tip) {
  QAction* action = make_action(window_, name, text, keys, tip);
  if (!name.isEmpty()) {
    with_icon_ << action;
  }
  return action;
}

void WindowActions::refresh_icons() {
  for (QAction* action : with_icon_) {
    action->setIcon(icon(action->objectName()));
  }
}

}  // namespace handway::gui
