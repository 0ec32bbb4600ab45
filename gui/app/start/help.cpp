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
         "to zoom, double click to centre.</p><p>A click selects, with Ctrl or Shift several. "
         "Arrows move what is selected "
         "along an axis, plates in a plane, rings turn it; Ctrl snaps to 10 mm and 15°, Esc puts "
         "it back. <b>S</b> puts handles on the sides of an object, to resize it. <b>L</b> "
         "switches "
         "between the world's axes and its local ones. <b>M</b> puts handles "
         "on the palm: the arm follows. So it does from start or goal, if you click on their "
         "ghosts.</p><p>While a path is "
         "shown it follows what you drag.</p>")},
    {"scene",
     QT_TRANSLATE_NOOP(
         "Help",
         "<b>Scene</b><p>Robots with their links, objects and their groups, start "
         "and goal. Ctrl and Shift select several objects. The boxes "
         "show and hide; F2 renames an object or group; a double click on start or goal moves "
         "the robot there.</p>")},
    {"properties",
     QT_TRANSLATE_NOOP("Help",
                       "<b>Properties</b><p>The selected object in numbers. Type a number of "
                       "millimetres or degrees, or one with its unit: <i>0.2 m</i>, <i>3.5 cm</i>, "
                       "<i>1.57 rad</i>. <b>Attached to</b> lets a link carry the object.</p>")},
    {"messages", QT_TRANSLATE_NOOP("Help",
                                   "<b>Messages</b><p>What was opened, saved and planned, with the "
                                   "warnings of readers and plugins.</p>")},
    {"history", QT_TRANSLATE_NOOP("Help",
                                  "<b>History</b><p>All edits since the scene was opened. A click "
                                  "goes back, or forward again, to how it was then.</p>")},
    {"plan",
     QT_TRANSLATE_NOOP(
         "Help",
         "<b>Plan</b><p>Choose a planner and a preset of its parameters, press Plan. Every "
         "parameter says in its tool tip what it does; those that differ from the preset are "
         "bold. <b>⋯</b> saves them as a preset of your own.</p><p>Same settings and seed: same "
         "path. <b>Seeds</b> plans with several and shows the best path; <b>All runs</b> lists "
         "what was planned.</p><p><b>Show the sampling region</b> draws where palm and fingertips "
         "may be in the planner's samples.</p>")},
    {"runs",
     QT_TRANSLATE_NOOP(
         "Help",
         "<b>Runs</b><p>What was planned in this scene, the latest first; the run that is shown "
         "is bold. <b>Restore</b>, or a double click, puts back a run's planner, parameters, "
         "seed, scene, start and goal, and shows its path: planning again gives the identical "
         "one.</p><p>A click on a heading sorts. <b>Hand</b> is the mean distance of the hand "
         "from a person's postures: less is more human.</p>")},
    {"projection",
     QT_TRANSLATE_NOOP("Help",
                       "<b>Projection</b><p>The planner's roadmap along two of its coordinates. A "
                       "dot is a node, coloured by the number of principal motion directions "
                       "(PMDs) it used; rings are start and goal, the line is the path, the cross "
                       "is the robot.</p><p>A click on a node moves the robot there. The wheel "
                       "zooms, the right button moves, a double click shows all.</p>")},
    {"joints",
     QT_TRANSLATE_NOOP("Help",
                       "<b>Joints</b><p>A slider for every joint. <i>Plan > Set start here</i> and "
                       "<i>Set goal here</i> take the posture that is shown.</p>")},
    {"hand", QT_TRANSLATE_NOOP("Help",
                               "<b>Hand</b><p>Moves the fingers together, along the "
                               "principal motion directions of the hand's basis.</p>")},
    {"glove", QT_TRANSLATE_NOOP("Help",
                                "<b>Glove</b><p>Connects a sensor glove or an emulated one, shows "
                                "what its sensors say, records it and lets the hand on screen "
                                "follow.</p>")},
    {"devices", QT_TRANSLATE_NOOP(
                    "Help",
                    "<b>Devices</b><p>Connects an arm and a hand, or emulated ones, and runs the "
                    "path on them. A motion is cleared before: limits, collisions, and where "
                    "the robot stands. Nothing moves unless <i>Let the robot move</i> is "
                    "ticked. <b>STOP</b> (Ctrl+Space, Pause or F12) stops all joints.</p>")},
    {"plots",
     QT_TRANSLATE_NOOP(
         "Help",
         "<b>Plots</b><p>The path over the time that the robot takes for it: its joints with their "
         "limits (dotted), the clearance, and how human the hand looks. Ticks along the upper "
         "edge are waypoints.</p><p>A click or a drag moves the robot there. The wheel zooms in "
         "time, with Ctrl in values; the right button moves; a double click shows all.</p>")},
    {"microscope",
     QT_TRANSLATE_NOOP(
         "Help",
         "<b>Microscope</b><p>Records a run of the paper's planner and goes through it line by "
         "line: on the left the main algorithm, on the right the one that it calls, with the "
         "current line marked. The robot shows the sample in question, the view the roadmap as "
         "it was, a green line an edge that is free and a red one an edge that is not.</p>")},
    {"campaigns",
     QT_TRANSLATE_NOOP("Help",
                       "<b>Campaigns</b><p>Carries out a campaign in the background, or opens the "
                       "runs of one. The curves show which share of runs had found a path after "
                       "which time. A click on a run opens its scene and plans it again with its "
                       "parameters and seed.</p>")},
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
