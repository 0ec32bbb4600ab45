#pragma once

#include "features/export/film_sink.h"

#include <QImage>
#include <QProcess>
#include <QSize>
#include <QString>
#include <QTemporaryDir>

#include <memory>

namespace handway::gui {

/// Writes a film or an animation with the program ffmpeg.
class FfmpegFilm : public FilmSink {
  Q_OBJECT

 public:
  /// Returns the path of ffmpeg, or an empty text if it is not installed.
  [[nodiscard]] static QString program();

  /// @param file ends in .mp4 or .gif. @param size of all pictures; both even.
  /// @throws geometric::InputError if the file's folder can't be written to.
  FfmpegFilm(const QString& file, const QSize& size, double rate);
  ~FfmpegFilm() override;

  [[nodiscard]] bool has_room() const override;
  void add(const QImage& picture) override;
  void finish() override;

 private:
  void take_end(int code, QProcess::ExitStatus status);

  QString file_;
  std::unique_ptr<QTemporaryDir> parts_;
  QString part_;
  QProcess process_;
  bool ended_ = false;
};

}  // namespace handway::gui
