#pragma once

#include "handway/geometric/robot/robot_model.h"
#include "handway/sampling/postures/pmd_basis.h"
#include "handway/sampling/postures/posture_table.h"
#include "model/jobs/background.h"

#include <QString>
#include <QWidget>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

class QComboBox;
class QLabel;

namespace handway::gui {

/// A basis of the hand that can be chosen.
struct HandBasis {
  QString name;                ///< Displayed name.
  std::filesystem::path file;  ///< Its name in a scene; empty: not in a file yet.
  std::shared_ptr<const sampling::PmdBasis> basis;
  sampling::PostureTable postures = {};  ///< Source of a basis without file.
};

/// Returns whether the robot has all joints of the basis.
[[nodiscard]] bool fits(const geometric::RobotModel& model, const sampling::PmdBasis& basis);

/// Returns the bases of the library that fit the robot.
[[nodiscard]] std::vector<HandBasis> shipped_bases(const geometric::RobotModel& model);

/// @throws geometric::InputError if it is no basis, or doesn't fit the robot.
[[nodiscard]] HandBasis open_basis(const std::filesystem::path& file,
                                   const geometric::RobotModel& model);

/// Writes a basis, and the postures that it was made from into STEM_postures.csv beside it.
/// @returns the basis in its file.
/// @throws geometric::InputError if a file can't be written.
[[nodiscard]] HandBasis save_basis(const HandBasis& made, const std::filesystem::path& file);

/// Compares a basis with another one: the angles between their subspaces, and how much of each
/// other's postures they hold.
class BasisComparisonView : public QWidget {
  Q_OBJECT

 public:
  explicit BasisComparisonView(QWidget* parent = nullptr);

  /// @param shown what is compared; nothing: there is no basis.
  /// @param others what it can be compared with.
  void set_bases(std::shared_ptr<const geometric::RobotModel> model, std::optional<HandBasis> shown,
                 std::vector<HandBasis> others);
  [[nodiscard]] QString text() const;

 private:
  void compare();

  std::shared_ptr<const geometric::RobotModel> model_;
  std::optional<HandBasis> shown_;
  std::vector<HandBasis> others_;
  QComboBox* other_;
  QLabel* table_;
  LatestJob job_;
};

}  // namespace handway::gui
