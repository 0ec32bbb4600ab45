#pragma once

#include <QDir>
#include <QImage>
#include <QObject>
#include <QProcess>
#include <QString>
#include <QTemporaryDir>

#include <memory>

namespace handway::gui {

/// Where the pictures of a film go. Until it is complete nothing stands under its name.
class FilmSink : public QObject {
  Q_OBJECT

 public:
  /// May another picture be added, or would it have to wait?
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

/// A film or an animation, by the program ffmpeg.
class FfmpegFilm : public FilmSink {
  Q_OBJECT

 public:
  /// Where ffmpeg is; empty: it is not installed.
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
