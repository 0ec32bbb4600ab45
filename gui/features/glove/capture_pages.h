#pragma once

#include "features/glove/captured_postures.h"
#include "handway/sampling/postures/pmd_basis.h"
#include "model/devices/glove_session.h"
#include "model/jobs/background.h"

#include <QObject>
#include <QTimer>

#include <memory>

namespace handway::gui {

class CaptureCoach;
class PmdExplorer;

/// Collects the postures that a glove makes the hand take, and keeps coach and explorer, which
/// show them, up to date.
class CapturePages : public QObject {
  Q_OBJECT

 public:
  explicit CapturePages(GloveSession& session, QObject* parent = nullptr);
  ~CapturePages() override;

  [[nodiscard]] CaptureCoach& coach() { return *coach_; }
  [[nodiscard]] PmdExplorer& explorer() { return *explorer_; }
  [[nodiscard]] const CapturedPostures& postures() const { return live_; }

  /// @param basis of the scene; may be null.
  void set_hand(std::shared_ptr<const geometric::RobotModel> model,
                std::shared_ptr<const sampling::PmdBasis> basis);
  void set_configuration(const geometric::Configuration& q);
  /// Shows a recording's postures in the explorer instead of the live ones.
  void show_recording(const QString& file);

 signals:
  void failed(const QString& message);

 private:
  void restart();
  void take(const std::vector<GloveSample>& samples);
  void show_live();
  void choose_recording();
  [[nodiscard]] CapturedPostures no_postures() const;

  GloveSession& session_;
  CaptureCoach* coach_;
  PmdExplorer* explorer_;
  std::shared_ptr<const sampling::PmdBasis> basis_;
  CapturedPostures live_;
  bool shows_live_ = true;
  bool is_new_ = false;  ///< Postures came since they were shown.
  int ticks_ = 0;
  int load_ = 0;  ///< Number of the recording asked for last.
  QTimer ticker_;
  BackgroundThreads threads_;
};

/// A recording through calibration and mapping, as postures normalised to [0, 1].
/// @param left_out as for CapturedPostures.
/// @throws geometric::InputError if it can't be read or lacks a sensor.
[[nodiscard]] CapturedPostures read_postures(const std::filesystem::path& file,
                                             const device::GloveCalibration& calibration,
                                             const device::HandMapper& mapper,
                                             const std::vector<int>& left_out);

}  // namespace handway::gui
