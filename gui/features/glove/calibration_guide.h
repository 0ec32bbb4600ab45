#pragma once

#include "handway/device/glove/calibration_fit.h"
#include "handway/device/glove/guided_poses.h"
#include "model/devices/glove_session.h"

#include <QString>
#include <QWidget>

#include <filesystem>
#include <vector>

class QLabel;
class QLineEdit;
class QProgressBar;
class QPushButton;

namespace handway::gui {

class BonesForm;
class HandPicture;

/// Guides a person through the postures of a calibration: shows each as a picture, reads the glove
/// while it is held, and fits the calibration, which is saved under the person's name with the
/// ranges of the joints and the lengths of the bones. For a source that measures angles itself it
/// finds only ranges and bones.
class CalibrationGuide : public QWidget {
  Q_OBJECT

 public:
  explicit CalibrationGuide(GloveSession& session, QWidget* parent = nullptr);

  /// Begins with the first posture.
  void begin();
  /// Saves what was found. @throws geometric::InputError if the file can't be written.
  void save(const std::filesystem::path& file);

 signals:
  /// The calibration is in a file. @param file of it.
  void saved(const QString& file);
  /// The person is done with it, or gives up.
  void closed();
  void failed(const QString& message);

 private:
  enum class Step { kWaiting, kReading, kDone };

  [[nodiscard]] QWidget* build_buttons();
  void capture();
  void take(const std::vector<GloveSample>& samples);
  void end_pose();
  void end_motion();
  [[nodiscard]] bool is_motion() const;
  /// Returns the quality of the present reading.
  [[nodiscard]] QString live_quality() const;
  void go_to(int pose);
  void fit();
  void show_step();
  void choose_to_save();

  GloveSession& session_;
  std::vector<device::PoseInstruction> poses_;
  std::vector<device::GuidedPose> held_;    ///< Readings by pose; empty counts: left out.
  std::vector<device::GloveFrame> frames_;  ///< Frames of the posture being read.
  std::vector<device::GloveFrame> moved_;   ///< Frames of the free motion.
  device::CalibrationFit fit_;
  int pose_ = 0;
  Step step_ = Step::kWaiting;
  QString quality_text_;
  QLineEdit* person_;
  QLabel* title_;
  HandPicture* picture_;
  BonesForm* bones_;
  QLabel* instruction_;
  QProgressBar* progress_;
  QLabel* quality_;
  QPushButton* back_;
  QPushButton* skip_;
  QPushButton* capture_;
};

}  // namespace handway::gui
