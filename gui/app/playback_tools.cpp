#include "app/playback_tools.h"

#include "app/window_actions.h"
#include "features/comparison/comparison_window.h"
#include "features/export/pictures_dialog.h"
#include "features/microscope/microscope_panel.h"
#include "features/playback/plots_panel.h"
#include "features/runs/runs_panel.h"
#include "model/document/document.h"
#include "model/planning/plan_settings.h"
#include "model/playback/path_player.h"
#include "view3d/scene_view.h"
#include "widgets/panels/playback_bar.h"

#include <QTime>

namespace handway::gui {

PlaybackTools::PlaybackTools(const PlaybackParts& parts, QObject* parent)
    : QObject(parent),
      parts_(parts),
      analysis_(parts.document, parts.player),
      traces_(parts.document, parts.player, parts.view, parts.bar.traces()),
      runs_(new RunsPanel(history_)),
      plots_(new PlotsPanel(parts.document, parts.player, analysis_)),
      microscope_(new MicroscopePanel(parts.document, parts.planning, parts.view)) {
  connect(plots_, &PlotsPanel::exported, this, &PlaybackTools::exported);
  connect(plots_, &PlotsPanel::failed, this, &PlaybackTools::failed);
  connect(microscope_, &MicroscopePanel::taken, &parts_.player, &PathPlayer::pause);
  connect(&parts_.player, &PathPlayer::timeline_changed, this,
          [this] { parts_.actions.pictures->setEnabled(!parts_.player.timeline().empty()); });
  connect(&analysis_, &MotionAnalysis::changed, this, &PlaybackTools::remember);
  connect(&history_, &PathHistory::changed, this,
          [this] { parts_.actions.compare->setEnabled(!history_.paths().empty()); });
  connect(runs_, &RunsPanel::compare_requested, this, &PlaybackTools::compare);
  connect(parts_.actions.pictures, &QAction::triggered, this, &PlaybackTools::export_pictures);
  connect(parts_.actions.compare, &QAction::triggered, this, &PlaybackTools::compare);
}

std::vector<DockContent> PlaybackTools::docks(const DockContent& last) const {
  return {{"runs", tr("Runs"), runs_},
          {"plots", tr("Plots"), plots_},
          {"microscope", tr("Microscope"), microscope_},
          last};
}

void PlaybackTools::remember() {
  if (!analysis_.curves()) {
    return;
  }
  const QString way = tr("%1, seed %2")
                          .arg(QString::fromStdString(parts_.planning.choice().name))
                          .arg(parts_.planning.request().seed);
  history_.add({label_of(way, *analysis_.motion(), QTime::currentTime()), parts_.document.scene(),
                parts_.document.palm(), analysis_.motion(), analysis_.curves(), nullptr,
                std::nullopt});
}

void PlaybackTools::export_pictures() {
  const std::string& name = parts_.document.scene()->name;
  auto* dialog =
      new PicturesDialog(parts_.document.scene(), parts_.player.timeline(), parts_.view.camera(),
                         name.empty() ? tr("path") : QString::fromStdString(name), &parts_.window);
  connect(dialog, &PicturesDialog::exported, this, &PlaybackTools::exported);
  dialog->open();
}

void PlaybackTools::compare() {
  Document& document = parts_.document;
  auto* dialog =
      new ComparisonWindow(history_,
                           {document.robot() ? document.problem() : nullptr, document.scene(),
                            document.palm(), document.recorded_hand().postures()},
                           &parts_.window);
  dialog->show();
}

}  // namespace handway::gui
