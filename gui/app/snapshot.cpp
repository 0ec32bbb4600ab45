#include "app/snapshot.h"

#include "view3d/scene_view.h"

#include <QPixmap>

namespace handway::gui {
namespace {

constexpr int kUnreadable = 3;
constexpr double kMoment = 0.4;  // of the path

}  // namespace

Snapshot::Snapshot(MainWindow& window, const Options& options, QObject* parent)
    : QObject(parent), window_(window), file_(QString::fromStdString(options.screenshot.string())) {
  poll_.setInterval(60);
  connect(&poll_, &QTimer::timeout, this, &Snapshot::wait_until_settled);
  connect(&window_, &MainWindow::ready, &poll_, qOverload<>(&QTimer::start));
  connect(&window_, &MainWindow::failed, this,
          [this](const QString& message) { emit done(kUnreadable, message); });
  connect(&window_.session(), &PlanningSession::ended, this, [this](bool solved) {
    if (solved) {
      window_.player().pause();
      window_.player().seek(kMoment);
    }
  });
}

void Snapshot::wait_until_settled() {
  const bool busy = window_.session().is_running() || window_.collisions().is_busy() ||
                    window_.player().is_playing() || window_.view().frame_time_ms() <= 0.0;
  calm_polls_ = busy ? 0 : calm_polls_ + 1;
  if (calm_polls_ >= 3) {
    poll_.stop();
    save();
  }
}

void Snapshot::save() {
  const bool saved = window_.grab().save(file_);
  emit done(saved ? 0 : 1, saved ? QString() : tr("%1 can't be written").arg(file_));
}

}  // namespace handway::gui
