#include "features/viewing/saved_views.h"

#include "features/viewing/measure_tool.h"
#include "features/viewing/section_tool.h"
#include "features/workbench.h"
#include "view3d/scene_view.h"
#include "widgets/forms/arrangement.h"
#include "widgets/style/menu_text.h"

#include <QInputDialog>
#include <QMainWindow>
#include <QMenu>

#include <algorithm>

namespace handway::gui {

SavedViews::SavedViews(Workbench& workbench)
    : workbench_(workbench),
      menu_(named("saved_views", new QMenu(tr("Saved v&iews"), &workbench.window))) {
  workbench_.add_to_menu(MainMenu::kView, {0, 10}, menu_->menuAction());
  connect(menu_, &QMenu::aboutToShow, this, &SavedViews::fill);
  const auto follow_scene = [this] {
    menu_->menuAction()->setEnabled(workbench_.document.scene() != nullptr);
  };
  connect(&workbench_.document, &Document::opened, this, follow_scene);
  follow_scene();
}

void SavedViews::fill() {
  menu_->clear();
  connect(menu_->addAction(tr("&Save this view…")), &QAction::triggered, this,
          &SavedViews::ask_for_name);
  const auto& views = workbench_.document.scene()->display.views;
  if (views.empty()) {
    return;
  }
  auto* forget = named("forget_view", new QMenu(tr("&Delete"), menu_));
  menu_->addMenu(forget);
  menu_->addSeparator();
  for (const geometric::SavedView& view : views) {
    const QString name = menu_text(view.name);
    connect(menu_->addAction(name), &QAction::triggered, this, [this, view] {
      workbench_.view.set_camera({view.target, view.distance, view.azimuth, view.elevation});
    });
    connect(forget->addAction(name), &QAction::triggered, this,
            [this, name = view.name] { workbench_.editor.forget_view(name); });
  }
}

void SavedViews::ask_for_name() {
  const auto& views = workbench_.document.scene()->display.views;
  QString suggestion;
  for (int number = 1; suggestion.isEmpty(); ++number) {
    const QString name = tr("View %1").arg(number);
    if (std::ranges::count(views, name.toStdString(), &geometric::SavedView::name) == 0) {
      suggestion = name;
    }
  }
  bool wanted = false;
  const QString name = QInputDialog::getText(&workbench_.window, tr("Save this view"),
                                             tr("Name of the view; a known one is replaced:"),
                                             QLineEdit::Normal, suggestion, &wanted);
  if (wanted && !name.trimmed().isEmpty()) {
    save(name.trimmed().toStdString());
  }
}

void SavedViews::save(const std::string& name) {
  const OrbitCamera::Placement& from = workbench_.view.camera().placement();
  workbench_.editor.save_view({name, from.target, from.distance, from.azimuth, from.elevation});
}

void add_viewing(Workbench& workbench) {
  workbench.own<SavedViews>(workbench);
  workbench.own<MeasureTool>(workbench);
  workbench.own<SectionTool>(workbench);
}

}  // namespace handway::gui
