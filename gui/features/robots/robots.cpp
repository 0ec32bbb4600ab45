#include "features/robots/robots.h"

#include "features/robots/add_robot_dialog.h"
#include "features/robots/setup_dialog.h"
#include "features/workbench.h"
#include "handway/geometric/formats/urdf.h"
#include "handway/geometric/mesh/triangle_mesh.h"
#include "view3d/scene_view.h"
#include "view3d/viewpoints.h"
#include "widgets/panels/log_panel.h"
#include "widgets/style/actions.h"

#include <QFileDialog>
#include <QFileInfo>
#include <QMainWindow>

#include <vector>

namespace handway::gui {
namespace {

using geometric::RobotInstance;

// Beside what is there, as what is added otherwise.
geometric::Pose free_place(Workbench& workbench, const RobotInstance& robot) {
  geometric::Scene alone;
  alone.robots = {robot};
  const std::vector<Eigen::Vector3d> points = all_points(alone);
  geometric::Pose X_WB = geometric::Pose::Identity();
  if (!points.empty()) {
    geometric::Aabb box{points.front(), points.front()};
    for (const Eigen::Vector3d& point : points) {
      box.lower = box.lower.cwiseMin(point);
      box.upper = box.upper.cwiseMax(point);
    }
    const Eigen::Vector3d underside(box.centre().x(), box.centre().y(), box.lower.z());
    X_WB.translation() =
        workbench.editor.place_for(box.size(), workbench.view.place_for_new()) - underside;
  }
  return X_WB;
}

void open_robot(Workbench& workbench) {
  const QString file = choose_robot_file(&workbench.window);
  if (!file.isEmpty()) {
    workbench.open(file.toStdString());
  }
}

void add_robot(Workbench& workbench) {
  auto* dialog = new AddRobotDialog(
      workbench.plugins, workbench.editor,
      [&workbench](const RobotInstance& robot) { return free_place(workbench, robot); },
      &workbench.window);
  QObject::connect(
      dialog, &AddRobotDialog::added, &workbench,
      [&workbench](const QString& name, const QString& warnings) {
        workbench.log.add(LogPanel::Level::kNote, QObject::tr("Added %1").arg(name));
        for (const QString& warning : warnings.split(QLatin1Char('\n'), Qt::SkipEmptyParts)) {
          workbench.log.add(LogPanel::Level::kWarning, warning);
        }
        workbench.show_panel("properties");
        workbench.view.keep_selection_in_view();
      });
  dialog->show();
}

// The robot that is selected, or whose link or part is; else the first.
const RobotInstance* chosen_robot(const Workbench& workbench) {
  const auto& scene = workbench.document.scene();
  const RobotInstance* selected =
      scene ? geometric::find_robot_with_part(*scene, workbench.editor.selection().robot) : nullptr;
  return selected ? selected : workbench.document.robot();
}

void export_robot(Workbench& workbench) {
  const RobotInstance* robot = chosen_robot(workbench);
  if (!robot) {
    return;
  }
  QFileDialog dialog(
      &workbench.window,
      QObject::tr("Export %1 as one robot").arg(QString::fromStdString(robot->name)));
  dialog.setObjectName(QStringLiteral("export_robot_dialog"));
  dialog.setOption(QFileDialog::DontUseNativeDialog);
  dialog.setAcceptMode(QFileDialog::AcceptSave);
  dialog.setNameFilter(QObject::tr("Robots, URDF with SRDF (*.urdf)"));
  dialog.setDefaultSuffix(QStringLiteral("urdf"));
  dialog.selectFile(QString::fromStdString(robot->name + ".urdf"));
  if (dialog.exec() != QDialog::Accepted || dialog.selectedFiles().isEmpty()) {
    return;
  }
  const QString file = dialog.selectedFiles().front();
  try {
    geometric::write_urdf(*robot->model, file.toStdString());
    workbench.log.add(
        LogPanel::Level::kNote,
        QObject::tr("Exported %1 with %2.srdf").arg(file, QFileInfo(file).completeBaseName()));
  } catch (const std::exception& error) {
    workbench.show_error(QObject::tr("The robot was not exported"),
                         QString::fromUtf8(error.what()));
  }
}

void set_up_robot(Workbench& workbench) {
  const std::string& selected = workbench.editor.selection().robot;
  auto* dialog =
      new SetupDialog(workbench.editor, selected.empty() ? chosen_robot(workbench)->name : selected,
                      &workbench.window);
  QObject::connect(dialog, &SetupDialog::written, &workbench, [&workbench](const QString& file) {
    workbench.log.add(LogPanel::Level::kNote, QObject::tr("Wrote %1").arg(file));
  });
  dialog->open();
}

}  // namespace

void add_robots(Workbench& workbench) {
  use_package_path();
  QAction* add = workbench.make_action("robot", QObject::tr("&Robot…"), {},
                                       QObject::tr("Add a robot, a hand, a tool or a fixture, on "
                                                   "its own or mounted on a link"));
  QAction* write = workbench.make_action("", QObject::tr("Export ro&bot…"), {},
                                         QObject::tr("Write the robot with all that is mounted on "
                                                     "it as one URDF with its SRDF"));
  QAction* first =
      workbench.make_action("", QObject::tr("Plan &for this robot"), {},
                            QObject::tr("Use the selected robot for start, goal and joints"));
  QAction* setup = workbench.make_action(
      "", QObject::tr("Robot set&up…"), {},
      QObject::tr("Find mistakes of the robot file, sample self-collisions, and write the SRDF"));
  QAction* open = workbench.make_action("", QObject::tr("Open a robot…"), {},
                                        QObject::tr("Begin a scene with a robot file"));
  open->setObjectName(QStringLiteral("open_robot"));
  setup->setObjectName(QStringLiteral("robot_setup"));
  write->setObjectName(QStringLiteral("export_robot"));
  first->setObjectName(QStringLiteral("plan_for_robot"));
  workbench.add_to_menu(MainMenu::kAdd, {0, 0}, add);
  workbench.add_to_menu(MainMenu::kFile, {1, 12}, write);
  workbench.add_to_menu(MainMenu::kPlan, {3, 10}, first);
  workbench.add_to_menu(MainMenu::kEdit, {3, 11}, setup);
  workbench.add_to_menu(MainMenu::kContext, {3, 11}, setup);
  workbench.add_to_menu(MainMenu::kContext, {3, 10}, first);
  const auto update_enabled = [&workbench, write, first, setup] {
    const RobotInstance* robot = chosen_robot(workbench);
    const QString no_robot =
        robot ? QString() : QObject::tr("The scene has no robot: add one with Add > Robot.");
    allow(*write, no_robot);
    allow(*setup, no_robot);
    allow(*first, robot != workbench.document.robot() ? no_robot
                                                      : QObject::tr("Select another robot first."));
  };
  QObject::connect(add, &QAction::triggered, &workbench, [&] {
    if (workbench.document.scene()) {
      add_robot(workbench);
    } else {
      open_robot(workbench);  // there is nothing to add it to
    }
  });
  QObject::connect(open, &QAction::triggered, &workbench, [&] { open_robot(workbench); });
  QObject::connect(write, &QAction::triggered, &workbench, [&] { export_robot(workbench); });
  QObject::connect(setup, &QAction::triggered, &workbench, [&] { set_up_robot(workbench); });
  QObject::connect(first, &QAction::triggered, &workbench,
                   [&] { workbench.editor.put_first(chosen_robot(workbench)->name); });
  QObject::connect(&workbench.document, &Document::opened, add, update_enabled);
  QObject::connect(&workbench.editor, &SceneEditor::selection_changed, add, update_enabled);
  workbench.add_work([&workbench] { return workbench.editor.is_composing(); });
  update_enabled();
}

}  // namespace handway::gui
