#include "app/start/help.h"

#include "view3d/scene_view.h"
#include "widgets/forms/arrangement.h"
#include "widgets/style/theme.h"

#include <QApplication>
#include <QCursor>
#include <QDockWidget>
#include <QFrame>
#include <QLabel>
#include <QMainWindow>
#include <QMessageBox>
#include <QTabWidget>

#include <algorithm>

namespace handway::gui {

void show_about(QWidget& window) {
  auto* box = new QMessageBox(
      QMessageBox::NoIcon, QObject::tr("About Handway"),
      QObject::tr("<h3>Handway %1</h3><p>Simulator and planning workbench for hand-arm "
                  "robots.</p><p>Qt %2, Coin %3</p>")
          .arg(QApplication::applicationVersion(), QLatin1String(qVersion()),
               SceneView::coin_version()),
      QMessageBox::Close, &window);
  box->setTextFormat(Qt::RichText);
  box->setAttribute(Qt::WA_DeleteOnClose);
  box->open();
}

namespace {

constexpr int kHelpWidth = 360;

struct Help {
  const char* panel;
  const char* text;
};

// Docks and tabs by object name; the first for what is neither.
constexpr Help kHelp[] = {
    {"view",
     QT_TRANSLATE_NOOP(
         "Help",
         "<b>3-D view</b><p>Drag to turn, drag with the middle button or with Shift to move, wheel "
         "to zoom, double click to centre.</p><p>Click to select; with Ctrl or Shift, select "
         "several objects. Drag the arrows, plates and rings to move and turn the selection; Ctrl "
         "snaps to 10 mm and 15°, Esc cancels. <b>S</b> shows handles to resize an object. "
         "<b>L</b> switches between world axes and local axes. <b>M</b> shows handles on the palm; "
         "the arm follows. Click on the ghost of start or goal to drag its palm.</p><p>A path that "
         "is shown is planned again while you drag.</p>")},
    {"scene",
     QT_TRANSLATE_NOOP(
         "Help",
         "<b>Scene</b><p>Lists robots with their links, objects and their groups, start and goal. "
         "Ctrl and Shift select several objects. The check boxes show and hide. F2 renames an "
         "object or group. Double-click on start or goal to move the robot there.</p>")},
    {"properties",
     QT_TRANSLATE_NOOP(
         "Help",
         "<b>Properties</b><p>Shows the numbers of the selected object. Type millimetres or "
         "degrees, or a number with its unit: <i>0.2 m</i>, <i>3.5 cm</i>, "
         "<i>1.57 rad</i>. <b>Attached to</b> lets a link carry the object.</p>")},
    {"messages", QT_TRANSLATE_NOOP("Help",
                                   "<b>Messages</b><p>Lists opened and saved files, planned paths, "
                                   "and the warnings of readers and plugins.</p>")},
    {"history", QT_TRANSLATE_NOOP("Help",
                                  "<b>History</b><p>Lists all edits since the scene was opened. "
                                  "Click on an entry to go back or forward to it.</p>")},
    {"plan", QT_TRANSLATE_NOOP(
                 "Help",
                 "<b>Plan</b><p>Choose a planner and a preset of its parameters, press Plan. The "
                 "tool tip of a parameter explains it; parameters that differ from the preset are "
                 "bold. <b>⋯</b> saves them as your own preset.</p><p>The same settings and seed "
                 "give the same path. <b>Seeds</b> plans with several seeds and shows the best "
                 "path; <b>All runs</b> lists all runs.</p><p><b>Show the sampling region</b> "
                 "draws the positions of palm and fingertips in the planner's samples.</p>")},
    {"runs",
     QT_TRANSLATE_NOOP(
         "Help",
         "<b>Runs</b><p>Lists the runs in this scene, the latest first; the run that is shown is "
         "bold. <b>Restore</b>, or a double click, restores a run's planner, parameters, seed, "
         "scene, start and goal, and shows its path. Planning again gives the identical "
         "path.</p><p>Click on a heading to sort. <b>Hand</b> is the mean distance of the hand "
         "from recorded postures of a person: smaller is more human-like.</p>")},
    {"projection",
     QT_TRANSLATE_NOOP(
         "Help",
         "<b>Projection</b><p>The planner's roadmap along two of its coordinates. A "
         "dot is a node, coloured by the number of principal motion directions "
         "(PMDs) of its sample; rings are start and goal, the line is the path, the cross "
         "is the robot.</p><p>Click on a node to move the robot there. The wheel zooms, the right "
         "button pans, a double click shows all.</p>")},
    {"joints",
     QT_TRANSLATE_NOOP("Help",
                       "<b>Joints</b><p>A slider for every joint. <i>Plan > Set start here</i> and "
                       "<i>Set goal here</i> use the posture that is shown.</p>")},
    {"hand", QT_TRANSLATE_NOOP("Help",
                               "<b>Hand</b><p>Moves the fingers together, along the "
                               "principal motion directions of the hand's basis.</p>")},
    {"glove", QT_TRANSLATE_NOOP("Help",
                                "<b>Glove</b><p>Connects a sensor glove or an emulated one, shows "
                                "and records its sensors, and moves the hand in the view.</p>")},
    {"devices", QT_TRANSLATE_NOOP(
                    "Help",
                    "<b>Devices</b><p>Connects an arm and a hand, or emulated ones, and runs the "
                    "path on them. Before, limits, collisions and the measured start are checked. "
                    "The robot moves only if <i>Let the robot move</i> is ticked. <b>STOP</b> "
                    "(Ctrl+Space, Pause or F12) stops all joints.</p>")},
    {"plots",
     QT_TRANSLATE_NOOP(
         "Help",
         "<b>Plots</b><p>Shows the path over time: its joints with their limits (dotted), the "
         "clearance, and the human-likeness of the hand. Ticks along the upper edge are "
         "waypoints.</p><p>Click or drag to move the robot there. The wheel zooms in time, with "
         "Ctrl in values; the right button pans; a double click shows all.</p>")},
    {"microscope",
     QT_TRANSLATE_NOOP(
         "Help",
         "<b>Microscope</b><p>Records a run of the paper's planner and steps through it line by "
         "line. On the left is the main algorithm, on the right the algorithm that it calls; the "
         "current line is marked. The robot shows the current sample, the view the roadmap at that "
         "step. A green line is a free edge, a red line an edge in collision.</p>")},
    {"campaigns",
     QT_TRANSLATE_NOOP(
         "Help",
         "<b>Campaigns</b><p>Executes a campaign in the background, or opens its runs. The curves "
         "show the share of runs that found a path within a time. Click on a run to open its scene "
         "and plan again with its parameters and seed.</p>")},
};

// The panel that a widget is in.
QString panel_of(const QWidget* widget) {
  for (; widget; widget = widget->parentWidget()) {
    if (const auto* tabs = qobject_cast<const QTabWidget*>(widget)) {
      return tabs->currentWidget()->objectName();
    }
    if (qobject_cast<const QDockWidget*>(widget)) {
      return widget->objectName();
    }
  }
  return {};
}

}  // namespace

void show_panel_help(QMainWindow& window) {
  const QWidget* under = QApplication::widgetAt(QCursor::pos());
  QString panel = panel_of(under && window.isAncestorOf(under) ? under : window.focusWidget());
  const auto known = [&](const Help& help) { return panel == QLatin1String(help.panel); };
  const auto* help = std::find_if(std::begin(kHelp), std::end(kHelp), known);
  if (help == std::end(kHelp)) {
    help = std::begin(kHelp);
  }
  auto* card = named("help_card", new QFrame(&window, Qt::Popup));
  card->setAttribute(Qt::WA_DeleteOnClose);
  card->setAttribute(Qt::WA_StyledBackground);
  card->setProperty("role", "help");
  auto* text = new QLabel(QCoreApplication::translate("Help", help->text));
  text->setTextFormat(Qt::RichText);
  text->setWordWrap(true);
  text->setFixedWidth(scaled(kHelpWidth));
  lay_out(*card, in_column({text}), {16, 12, 16, 12});
  card->adjustSize();
  const QPoint corner =
      window.mapToGlobal(QPoint(window.width() - scaled(kHelpWidth) - 60, window.height()));
  const QPoint place = QCursor::pos() + QPoint(12, 12);
  card->move(std::min(place.x(), corner.x()),
             std::min(place.y(), corner.y() - card->height() - 20));
  card->show();
}

}  // namespace handway::gui
