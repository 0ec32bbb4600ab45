#include "app/frame_rate_label.h"

#include "view3d/scene_view.h"

#include <cmath>

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
  setToolTip(tr("How fast the view draws while something moves"));
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

}  // namespace handway::gui
