#pragma once

#include "features/export/film_sink.h"
#include "model/settings/orbit_camera.h"
#include "view3d/film.h"

#include <QImage>
#include <QObject>
#include <QSize>
#include <QString>
#include <QTimer>

#include <memory>
#include <vector>

namespace handway::gui {

class ScenePictures;

/// Content and settings of the pictures of a film.
struct FilmShot {
  Film film;
  OrbitCamera camera;
  QSize size;            ///< Pixels.
  int pictures = 0;      ///< Evenly spread over the time, the ends included; ≥ 2.
  int oversampling = 1;  ///< See ScenePictures.
};

/// Takes pictures of a film one by one while the window stays responsive: between two events it
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
