#pragma once

#include <QImage>
#include <QObject>
#include <QString>

namespace handway::gui {

/// Receives the pictures of a film. No file has its final name before the film is complete.
class FilmSink : public QObject {
  Q_OBJECT

 public:
  /// Returns whether another picture can be added without waiting.
  [[nodiscard]] virtual bool has_room() const { return true; }
  virtual void add(const QImage& picture) = 0;
  /// All pictures are there; done() or failed() follows.
  virtual void finish() = 0;

 signals:
  /// Ready for more.
  void drained();
  void done();
  void failed(const QString& message);
};

}  // namespace handway::gui
