#include "features/comparison/locked_views.h"

#include "view3d/scene_view.h"
#include "widgets/style/theme.h"

#include <QEvent>
#include <QHBoxLayout>

namespace handway::gui {
namespace {

bool same(const OrbitCamera::Placement& a, const OrbitCamera::Placement& b) {
  return a.target == b.target && a.distance == b.distance && a.azimuth == b.azimuth &&
         a.elevation == b.elevation;
}

}  // namespace

LockedViews::LockedViews(QWidget* parent) : QWidget(parent), views_{new SceneView, new SceneView} {
  auto* layout = new QHBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(2);
  for (std::size_t i = 0; i < views_.size(); ++i) {
    SceneView* const view = views_.at(i);
    view->set_colors(colors_of(current_theme()).view);
    view->setMinimumSize(240, 200);
    layout->addWidget(view, 1);
    connect(view, &SceneView::frameSwapped, this, [this, i] { follow(i); });
  }
}

void LockedViews::changeEvent(QEvent* event) {
  QWidget::changeEvent(event);
  if (event->type() == QEvent::PaletteChange) {
    for (SceneView* const view : views_) {
      view->set_colors(colors_of(current_theme()).view);
    }
  }
}

void LockedViews::follow(std::size_t index) {
  const OrbitCamera::Placement& wanted = views_.at(index)->camera().placement();
  SceneView& other = *views_.at(1 - index);
  if (!same(other.camera().placement(), wanted)) {
    other.set_camera(wanted);
  }
}

}  // namespace handway::gui
