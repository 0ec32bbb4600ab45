#pragma once

#include "handway/geometric/scene/scene.h"
#include "model/playback/path_player.h"
#include "model/settings/orbit_camera.h"

#include <QDir>
#include <QImage>
#include <QObject>
#include <QProcess>
#include <QSize>
#include <QString>
#include <QTemporaryDir>
#include <QTimer>

#include <functional>
#include <memory>
#include <vector>

namespace handway::gui {

class ScenePictures;

/// Returns the folder for parts of a file or folder: beside it, on the same disk, under a hidden
/// name that contains the name of the program.
[[nodiscard]] QString parts_beside(const QString& file);

/// @throws geometric::InputError unless the parts' folder could be made.
void need_writable(const QTemporaryDir& parts, const QString& file);

/// Removes parts beside a file that programs have left which were killed on this machine, in the
/// background.
void remove_leftovers_beside(const QString& file);

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

/// A film or an animation, by the program ffmpeg.
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

/// Numbered PNG files in a new folder. They are made in the background, in a folder beside that
/// takes the new name when all are there; if they are not wanted any more, or one can't be
/// written, nothing of them stays.
class FrameFolder : public FilmSink {
  Q_OBJECT

 public:
  static constexpr int kMostWaiting = 4;  ///< Pictures.

  /// @throws geometric::InputError if the folder is there already, or can't be made.
  explicit FrameFolder(const QString& folder);
  ~FrameFolder() override;

  [[nodiscard]] bool has_room() const override { return waiting_ < kMostWaiting; }
  void add(const QImage& picture) override;
  void finish() override;

 private:
  class Parts;

  void take_written(const QString& fault);
  void end();

  QString folder_;
  std::shared_ptr<Parts> parts_;  ///< Shared with those that write to it.
  int count_ = 0;
  int waiting_ = 0;
  bool complete_ = false;  ///< No more are to come.
  bool failed_ = false;
};

/// Content and settings of the pictures of a path.
struct FilmShot {
  std::shared_ptr<const geometric::Scene> scene;
  PathTimeline timeline;
  OrbitCamera camera;
  QSize size;            ///< Pixels.
  int pictures = 0;      ///< Evenly spread over the path, the ends included; ≥ 2.
  int oversampling = 1;  ///< See ScenePictures.
};

/// Takes pictures of a path one by one while the window stays responsive: between two events it
/// only requests one picture, or takes a finished one.
class FilmRecorder : public QObject {
  Q_OBJECT

 public:
  explicit FilmRecorder(QObject* parent = nullptr);
  ~FilmRecorder() override;

  /// Begins a film; finished() or failed() follows.
  void start(const FilmShot& shot, std::unique_ptr<FilmSink> sink);
  /// Begins a strip; taken() or failed() follows.
  void start(const FilmShot& shot);
  /// Cancels the recording; nothing is written.
  void cancel();
  [[nodiscard]] bool is_busy() const { return pictures_ != nullptr; }

 signals:
  void progressed(int done, int all);
  /// The pictures of a strip.
  void taken(const std::vector<QImage>& pictures);
  /// The film is written.
  void finished();
  void failed(const QString& message);

 private:
  void step();
  void begin_picture();
  void take_picture();
  void end();

  FilmShot shot_;
  std::unique_ptr<ScenePictures> pictures_;
  std::unique_ptr<FilmSink> sink_;
  std::vector<QImage> strip_;
  int count_ = 0;
  bool drawing_ = false;  ///< A picture is begun.
  QTimer next_;
};

}  // namespace handway::gui
