#pragma once

#include "features/export/film_recorder.h"
#include "model/jobs/background.h"

#include <QDialog>
#include <QImage>
#include <QObject>
#include <QString>

#include <vector>

class QComboBox;
class QFormLayout;
class QLabel;
class QLineEdit;
class QProgressBar;
class QPushButton;
class QSpinBox;

namespace handway::gui {

/// Draws the pictures of a film strip into one file, by its ending PNG or SVG, in the background.
class StripWriter : public QObject {
  Q_OBJECT

 public:
  explicit StripWriter(QObject* parent = nullptr);

  /// written() or failed() follows.
  void start(const QString& file, const QString& title, const std::vector<QImage>& pictures);
  /// Cancels while pictures are drawn; nothing is written.
  void cancel();
  [[nodiscard]] bool is_busy() const { return busy_; }

 signals:
  /// Emitted when all is drawn, and the export can't be cancelled any more.
  void writing();
  void written();
  void failed(const QString& message);

 private:
  void write(const QString& file, const QByteArray& bytes);

  bool busy_ = false;
  bool writing_ = false;
  LatestJob job_;
};

/// Exports pictures of a film as the view's camera sees it: a film strip, numbered frames, a film
/// or an animation.
class PicturesDialog : public QDialog {
  Q_OBJECT

 public:
  enum class Kind { kStrip, kFrames, kFilm, kAnimation };

  PicturesDialog(Film film, const OrbitCamera& camera, QWidget* parent = nullptr);

  void choose(Kind kind);
  void set_file(const QString& file);

 signals:
  void exported(const QString& file);

 private:
  [[nodiscard]] QFormLayout* make_settings();
  [[nodiscard]] QWidget* make_destination();
  [[nodiscard]] Kind kind() const;
  /// Returns the suffix of the chosen file; empty for a folder.
  [[nodiscard]] QString suffix() const;
  [[nodiscard]] QSize size() const;
  [[nodiscard]] FilmShot shot() const;
  [[nodiscard]] bool is_busy() const { return recorder_.is_busy() || strip_.is_busy(); }
  void take_kind();
  void show_count();
  void browse();
  void begin();
  void connect_workers();
  void cancel();
  void show_busy(bool busy);
  void show_problem(const QString& message);

  Film film_;
  OrbitCamera camera_;
  FilmRecorder recorder_;
  StripWriter strip_;
  QComboBox* kinds_;
  QSpinBox* pictures_;
  QComboBox* sizes_;
  QComboBox* rates_;
  QComboBox* speeds_;
  QLabel* count_;
  QLineEdit* file_;
  QProgressBar* progress_;
  QPushButton* export_button_;
  QPushButton* close_button_;
  QLabel* note_;
};

}  // namespace handway::gui
