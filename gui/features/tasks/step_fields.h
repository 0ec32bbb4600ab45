#pragma once

#include "handway/geometric/math/pose.h"
#include "handway/geometric/scene/program.h"

#include <QString>
#include <QStringList>
#include <QWidget>

#include <array>
#include <functional>
#include <map>
#include <string>

class QComboBox;
class QLabel;
class QLineEdit;

namespace handway::gui {

class NumberField;
class PoseForm;
class QuantityField;

/// Names in the scene that steps refer to.
struct StepNames {
  QStringList objects;   ///< Objects to pick.
  QStringList supports;  ///< Objects and frames to place something on, and to give poses in.
  QStringList postures;  ///< Postures to move to, "start" first.
  QStringList links;     ///< Links of the robot that joints move.
  std::map<std::string, geometric::Pose> X_WF;  ///< Poses of the supports in the world.
  geometric::PoseStep pose_here;                ///< Moves a link to where it is shown.
};

/// Shows the values of a step, and lets users change them.
class StepFields : public QWidget {
  Q_OBJECT

 public:
  explicit StepFields(QWidget* parent = nullptr);

  void show_step(const geometric::ProgramStep& step, const StepNames& names);

 signals:
  /// A user has changed a value of the step.
  void edited(const handway::geometric::ProgramStep& step);

 private:
  void show_values(const geometric::PickStep& pick);
  void show_values(const geometric::PlaceStep& place);
  void show_values(const geometric::PostureStep& move);
  void show_values(const geometric::PoseStep& move);
  void show_values(const geometric::LineStep& line);
  void show_values(const geometric::WaitStep& wait);
  void show_values(const geometric::OutputStep& output);
  void show_values(const geometric::AlternativesStep& step);
  void show_lengths(const QString& first, double first_length, const QString& second,
                    double second_length);
  /// Offers names for the step, and the one that it has now.
  void offer(const QString& label, const QStringList& names, const QString& chosen);
  /// Offers frames. @param first names before those of the scene, for references "" and "palm".
  void offer_frames(const QString& label, const QStringList& first, const std::string& chosen);
  void connect_fields();
  void take_name();
  void take_lengths();
  void take_frame();
  void take_line();
  void take_output();
  /// Changes a step of this kind, and emits it. @returns whether it is of this kind.
  template <typename Step>
  bool change(const std::function<void(Step&)>& edit);
  /// Returns the reference that is chosen in the list of frames.
  [[nodiscard]] std::string chosen_frame() const;
  /// Returns the pose of a reference in the world; nothing if it is not there.
  [[nodiscard]] const geometric::Pose* find_frame(const std::string& reference) const;

  QWidget* named_;  ///< Row of the name.
  QLabel* name_label_;
  QComboBox* name_;  ///< The object, the support, the posture or the link of the step.
  QWidget* framed_;  ///< Row of the frame.
  QLabel* frame_label_;
  QComboBox* frame_;
  QWidget* lengths_;
  QLabel* first_label_;
  QuantityField* first_;  ///< Length of the straight motion at the begin of the step.
  QLabel* second_label_;
  QuantityField* second_;  ///< Length of the straight motion at its end.
  PoseForm* pose_;
  QWidget* line_;
  std::array<QuantityField*, 3> shift_;
  QWidget* wait_;
  NumberField* duration_;
  QWidget* output_;
  QLineEdit* output_name_;
  QComboBox* output_value_;  ///< On, off or a number.
  NumberField* output_number_;
  geometric::ProgramStep step_;
  StepNames names_;
  int frames_before_ = 0;  ///< Number of the entries of the list of frames before the scene's.
};

}  // namespace handway::gui
