#include "app/snapshot.h"

#include "features/workbench.h"
#include "view3d/scene_view.h"

#include <QPixmap>

#include <optional>

namespace handway::gui {
namespace {

constexpr int kUnreadable = 3;
constexpr double kMoment = 0.4;  // of the path

}  // namespace

Snapshot::Snapshot(MainWindow& window, const Options& options, QObject* parent)
    : QObject(parent),
      window_(window),
      file_(QString::fromStdString(options.screenshot.string())),
      view_only_(options.view_only),
      glove_time_(options.glove.empty() && options.tracker.empty() ? 0.0 : options.glove_time) {
  poll_.setInterval(60);
  connect(&poll_, &QTimer::timeout, this, &Snapshot::wait_until_settled);
  connect(&window_, &MainWindow::ready, &poll_, qOverload<>(&QTimer::start));
  connect(&window_, &MainWindow::failed, this,
          [this](const QString& message) { emit done(kUnreadable, message); });
  const auto show_moment = [this] {
    window_.player().pause();
    window_.player().seek(kMoment);
  };
  connect(&window_.session(), &PlanningSession::path_opened, this, show_moment);
  connect(&window_.session(), &PlanningSession::ended, this, [show_moment](bool solved) {
    if (solved) {
      show_moment();
    }
  });
}

void Snapshot::wait_until_settled() {
  const Workbench& workbench = window_.workbench();
  const std::optional<double> listening =
      glove_time_ > 0.0 ? workbench.listening_time() : std::nullopt;
  if (listening) {  // the collision checks of a hand that moves never end
    if (*listening >= glove_time_) {
      poll_.stop();
      save();
    }
    return;
  }
  const bool busy = workbench.is_busy();
  calm_polls_ = busy ? 0 : calm_polls_ + 1;
  if (calm_polls_ >= 3) {
    poll_.stop();
    save();
  }
}

void Snapshot::save() {
  window_.view().settle();
  const QPixmap picture = view_only_ ? window_.view().picture() : window_.grab();
  const bool saved = picture.save(file_);
  emit done(saved ? 0 : 1, saved ? QString() : tr("%1 can't be written").arg(file_));
}

}  // namespace handway::gui
