#pragma once

#include "handway/sampling/postures/basis_study.h"
#include "handway/sampling/postures/pmd_basis.h"
#include "handway/sampling/postures/principal_components.h"
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
#include <stop_token>
#include <string>
#include <vector>

namespace handway::gui {

/// The postures that a hand took while it was captured, normalised to [0, 1] per joint, and
/// whether the subspace of their principal motion directions still turns.
class CapturedPostures {
 public:
  static constexpr double kWindow = 10.0;                ///< s, between the subspaces compared.
  static constexpr double kSettledAngle = 0.0872664626;  ///< rad, 5°.
  static constexpr double kLeastTime = 30.0;             ///< s, before it can have settled.

  CapturedPostures() = default;
  /// @param joints names, in the postures' order.
  /// @param left_out joints that take no part in the principal components.
  CapturedPostures(std::vector<std::string> joints, std::vector<int> left_out);

  /// @param time s, never falling.
  /// @param posture shape [joints].
  void add(double time, const Eigen::VectorXd& posture);

  [[nodiscard]] const std::vector<std::string>& joints() const { return joints_; }
  [[nodiscard]] const std::vector<int>& left_out() const { return left_out_; }
  [[nodiscard]] Eigen::Index count() const { return count_; }
  /// Returns the time from the first posture to the last, s.
  [[nodiscard]] double duration() const { return last_time_ - first_time_; }
  /// Evenly chosen ones of all that were added, at most some thousand.
  [[nodiscard]] const std::vector<Eigen::VectorXd>& samples() const { return samples_; }
  /// The samples as rows, shape [samples, joints].
  [[nodiscard]] Eigen::MatrixXd table() const;

  /// Returns the components of all postures. @throws geometric::InputError if there are fewer than
  /// two.
  [[nodiscard]] sampling::PrincipalComponents components() const { return components(left_out_); }
  /// Returns the components with other joints left out.
  [[nodiscard]] sampling::PrincipalComponents components(const std::vector<int>& left_out) const;
  /// Correlation of every pair of joints; 0 where one does not vary. Shape [joints, joints].
  /// @throws as components().
  [[nodiscard]] Eigen::MatrixXd correlations() const;

  /// Largest angle by which the subspace of the directions that hold three quarters of the
  /// variance has turned within the last kWindow, rad; nothing if it is too early to tell.
  [[nodiscard]] std::optional<double> turn() const { return turn_; }
  [[nodiscard]] bool has_settled() const;

 private:
  struct Subspace {
    double time;
    Eigen::MatrixXd directions;
  };

  void keep(const Eigen::VectorXd& posture);
  void compare(double time);

  std::vector<std::string> joints_;
  std::vector<int> left_out_;
  std::optional<sampling::IncrementalComponents> components_;
  Eigen::Index count_ = 0;
  double first_time_ = 0.0;
  double last_time_ = 0.0;
  std::vector<Eigen::VectorXd> samples_;
  Eigen::Index stride_ = 1;  ///< One of so many postures is kept.
  std::deque<Subspace> subspaces_;
  std::optional<double> turn_;
};

class CaptureCoach;
class PmdExplorer;
struct HandBasis;

/// Recordings, of one person or of several, as postures of a hand.
struct PostureRecordings {
  CapturedPostures postures;                       ///< Postures of all recordings, joined.
  std::vector<sampling::RecordedHand> each;        ///< Postures of each recording.
  std::vector<device::GloveAngles> measured = {};  ///< Evenly chosen rows of all, in their order.
  std::vector<std::string> warnings = {};          ///< Warnings about interpretations in reading.
};

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

/// Reads recordings as postures normalised to [0, 1]: those of a glove through calibration and
/// mapping or retargeting, those of the robot hand's own joints as they are.
/// @param left_out as for CapturedPostures.
/// @param hand that has the joints.
/// @param stop requested if the result is not needed any more.
/// @throws geometric::InputError if one can't be read or lacks a sensor.
[[nodiscard]] PostureRecordings read_postures(const std::vector<std::filesystem::path>& files,
                                              const device::GloveCalibration& calibration,
                                              const device::PostureSource& source,
                                              const std::vector<int>& left_out,
                                              const geometric::RobotModel& hand,
                                              const std::stop_token& stop = {});

}  // namespace handway::gui
