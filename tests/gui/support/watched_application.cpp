#include "watched_application.h"

#include "handway_test/resource_use.h"

#include <QEvent>
#include <QMetaEnum>

#include <gtest/gtest.h>

#include <string>

namespace handway::test {
bool WatchedApplication::notify(QObject* receiver, QEvent* event) {
  if (event->type() == QEvent::UpdateRequest || event->type() == QEvent::Paint) {
    return paint(receiver, event);
  }
  if (depth_ > 0) {
    return QApplication::notify(receiver, event);
  }
  // Receiver and event may be gone afterwards.
  const QString name =
      QStringLiteral("%1 at %2")
          .arg(QLatin1String(QMetaEnum::fromType<QEvent::Type>().valueToKey(event->type())),
               QLatin1String(receiver->metaObject()->className()));
  ++depth_;
  painting_ms_ = 0.0;
  const double begin = cpu_seconds();
  const bool taken = QApplication::notify(receiver, event);
  const double ms = 1e3 * (cpu_seconds() - begin) - painting_ms_;
  --depth_;
  if (ms > longest_.ms) {
    longest_ = {ms, name};
  }
  return taken;
}

// The time to paint depends on the graphics card, also if a press paints at once.
bool WatchedApplication::paint(QObject* receiver, QEvent* event) {
  if (is_painting_) {
    return QApplication::notify(receiver, event);
  }
  is_painting_ = true;
  const double begin = cpu_seconds();
  const bool taken = QApplication::notify(receiver, event);
  painting_ms_ += 1e3 * (cpu_seconds() - begin);
  is_painting_ = false;
  return taken;
}

void expect_no_stall(double most_ms) {
  const Stall& stall = WatchedApplication::longest();
  ::testing::Test::RecordProperty("longest_stall_ms", std::to_string(stall.ms));
  ::testing::Test::RecordProperty("longest_stall", stall.event.toStdString());
  EXPECT_LT(stall.ms, most_ms) << stall.event.toStdString();
}

}  // namespace handway::test
