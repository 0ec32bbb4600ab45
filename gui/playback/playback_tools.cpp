#include "playback/playback_tools.h"

#include "playback/plots_panel.h"

namespace handway::gui {

PlaybackTools::PlaybackTools(Document& document, PathPlayer& player, SceneView& view, QMenu& menu,
                             QObject* parent)
    : QObject(parent),
      analysis_(document, player),
      traces_(document, player, view, menu),
      plots_(new PlotsPanel(document, player, analysis_)) {
  connect(plots_, &PlotsPanel::exported, this, &PlaybackTools::exported);
  connect(plots_, &PlotsPanel::failed, this, &PlaybackTools::failed);
}

}  // namespace handway::gui
