#pragma once

#include "features/glove/captured_postures.h"
#include "features/glove/posture_recordings.h"
#include "handway/sampling/postures/pmd_basis.h"
#include "model/devices/glove_session.h"
#include "model/jobs/background.h"

#include <QObject>
#include <QStringList>
#include <QTimer>

#include <Eigen/Core>

#include <deque>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace handway::gui {

class CaptureCoach;
class PmdExplorer;
struct HandBasis;

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

  /// Sets the hand of another scene. @param basis that it names; its basis may be null.
  void set_hand(std::shared_ptr<const geometric::RobotModel> model, const HandBasis& basis);
  /// The scene names another basis; what has been captured stays.
  void set_basis(const HandBasis& basis);
  void set_configuration(const geometric::Configuration& q);
  /// Shows the postures of recordings in the explorer instead of the live ones.
  void show_recordings(const QStringList& files);

 signals:
  void failed(const QString& message);

 private:
  void restart();
  void take(const std::vector<GloveSample>& samples);
  void show_live();
  void choose_recordings();
  [[nodiscard]] CapturedPostures no_postures() const;
  /// Other postures are to be shown: of the same recordings by another source, or live ones.
  void show_again();
  void take_recordings(const std::shared_ptr<PostureRecordings>& recordings);
  /// Returns whether recordings of the robot hand's own joints, without a person, are shown.
  [[nodiscard]] bool shows_own_joints() const;
  [[nodiscard]] QString reading_notes() const;
  void compare_methods(std::vector<device::GloveAngles> measured);
  void update_report();

  GloveSession& session_;
  CaptureCoach* coach_;
  PmdExplorer* explorer_;
  std::shared_ptr<const sampling::PmdBasis> basis_;
  CapturedPostures live_;
  std::deque<device::GloveAngles> recent_;  ///< Latest measurements.
  QStringList files_;                       ///< Recordings shown; empty: live postures are shown.
  std::shared_ptr<const PostureRecordings> recordings_;  ///< Null until they have been read.
  bool is_new_ = false;                                  ///< Postures came since they were shown.
  int ticks_ = 0;
  QTimer ticker_;
  LatestJob reading_;
  LatestJob comparing_;
};

}  // namespace handway::gui
