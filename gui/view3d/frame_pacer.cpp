#include "view3d/frame_pacer.h"

namespace handway::gui {

FramePacer::FramePacer(QWidget& widget) : widget_(widget) {
  next_.setSingleShot(true);
  next_.setTimerType(Qt::PreciseTimer);
  QObject::connect(&next_, &QTimer::timeout, &widget_, qOverload<>(&QWidget::update));
}

void FramePacer::request() {
  const qint64 pause = limit_ > 0 ? 1000 / limit_ : 0;
  if (!since_last_.isValid() || since_last_.elapsed() >= pause) {
    widget_.update();
  } else if (!next_.isActive()) {
    next_.start(static_cast<int>(pause - since_last_.elapsed()));
  }
}

void FramePacer::note_painted() {
  next_.stop();
  since_last_.start();
}

}  // namespace handway::gui
