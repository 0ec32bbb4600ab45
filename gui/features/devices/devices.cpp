#include "features/devices/devices.h"

#include "features/devices/device_session.h"
#include "features/devices/devices_panel.h"
#include "features/workbench.h"
#include "view3d/scene_view.h"
#include "widgets/forms/arrangement.h"
#include "widgets/panels/log_panel.h"

#include <QGridLayout>
#include <QLabel>
#include <QMainWindow>
#include <QMenuBar>
#include <QPushButton>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace handway::gui {
namespace {

// The scene with its objects where a task has left them.
planning::SceneState with_objects_of(const planning::SceneState& after,
                                     const planning::SceneState& state) {
  geometric::Scene scene = *state.scene;
  for (geometric::SceneObject& object : scene.objects) {
    if (const geometric::SceneObject* moved = after.find(object.name)) {
      object = *moved;
    }
  }
  planning::SceneState next = state;
  next.scene = std::make_shared<const geometric::Scene>(std::move(scene));
  return next;
}

// The name of the program, in whose place the button is shown: the menus stay where they are.
QWidget* corner_of(QPushButton* stop) {
  auto* corner = new QWidget;
  QLabel* name = heading(QObject::tr("Handway"));
  name->setAlignment(Qt::AlignCenter);
  QSizePolicy keeps_room = stop->sizePolicy();
  keeps_room.setRetainSizeWhenHidden(true);
  stop->setSizePolicy(keeps_room);
  auto* layout = new QGridLayout(corner);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(name, 0, 0);
  layout->addWidget(stop, 0, 0);
  return corner;
}

}  // namespace

void add_devices(Workbench& workbench) {
  auto& devices =
      workbench.own<DeviceSession>(workbench.document, workbench.player, workbench.driver);
  workbench.add_dock(DockArea::kControl, 4, {"devices", QObject::tr("Devices"), devices.panel()});
  // The corner that is on the screen even if the window is larger.
  workbench.window.menuBar()->setCornerWidget(corner_of(devices.stop_button()), Qt::TopLeftCorner);
  workbench.ask_before_leaving([&] { return devices.may_leave(workbench.window); });
  QObject::connect(
      &devices, &DeviceSession::executed_changed, &workbench.view,
      [&](const std::vector<Eigen::Vector3d>& path) { workbench.view.set_executed(path); });
  QObject::connect(
      &devices, &DeviceSession::reported, &workbench, [&](bool good, const QString& message) {
        workbench.log.add(good ? LogPanel::Level::kNote : LogPanel::Level::kError, message);
      });
  QObject::connect(&devices, &DeviceSession::start_here_requested, &workbench,
                   [&](const Eigen::VectorXd& q) {
                     workbench.editor.set_start(q);
                     workbench.session.start();
                   });
  QObject::connect(&devices, &DeviceSession::task_done, &workbench,
                   [&](const planning::SceneState& after) {
                     workbench.editor.apply(QObject::tr("Objects placed by the robot"),
                                            with_objects_of(after, workbench.editor.state()), {});
                   });
  QObject::connect(&devices, &DeviceSession::carried, &workbench,
                   [&](const QString& object, const geometric::Pose& X_WO) {
                     emit workbench.handles_welcome(false);
                     workbench.view.preview(object_item(object.toStdString()), X_WO);
                   });
  QObject::connect(&devices, &DeviceSession::carried_ended, &workbench, [&] {
    for (const geometric::SceneObject& object : workbench.document.scene()->objects) {
      if (!object.attachment) {
        workbench.view.preview(object_item(object.name), object.X_PO);
      }
    }
    emit workbench.handles_welcome(true);
  });
  QObject::connect(&workbench, &Workbench::run_wanted, &devices, [&](const DerivedSource& task) {
    devices.take_task(task);
    workbench.show_panel("devices");
  });
  QObject::connect(&workbench, &Workbench::task_forgotten, &devices, &DeviceSession::forget_task);
  PlanSettings& settings = workbench.plan_settings;
  const auto take_margin = [&] { devices.set_margin(settings.request().margin); };
  QObject::connect(&settings, &PlanSettings::request_changed, &devices, take_margin);
  QObject::connect(&devices, &DeviceSession::margin_requested, &workbench, [&](double margin) {
    settings.set_margin(margin);
    workbench.session.start();
  });
  take_margin();
}

}  // namespace handway::gui
