#pragma once

#include "model/jobs/latest_job.h"

#include <QImage>
#include <QObject>
#include <QString>

#include <vector>

namespace handway::gui {

/// Draws the pictures of a film strip into one file, by its ending PNG or SVG, in the background.
class StripWriter : public QObject {
  Q_OBJECT

 public:
  explicit StripWriter(QObject* parent = nullptr) : QObject(parent) {}

  /// written() or failed() follows.
  void start(const QString& file, const QString& title, const std::vector<QImage>& pictures);
  /// While it draws: nothing is written.
  void cancel();
  [[nodiscard]] bool is_busy() const { return busy_; }

 signals:
  /// It has drawn, and can't be cancelled any more.
  void writing();
  void written();
  void failed(const QString& message);

 private:
  void write(const QString& file, const QByteArray& bytes);

  bool busy_ = false;
  bool writing_ = false;
  LatestJob job_;
};

}  // namespace handway::gui
