#pragma once

#include <QDialog>
#include <QString>

#include <string>
#include <vector>

class QButtonGroup;
class QLabel;
class QPushButton;
class QVBoxLayout;

namespace handway::gui {

/// A robot of the library, by what its SRDF calls groups.
struct LibraryRobot {
  std::string name;
  bool has_arm = false;
  bool has_hand = false;
};

/// Returns the robots of the library in alphabetical order. A robot without such groups counts as
/// an arm.
[[nodiscard]] std::vector<LibraryRobot> library_robots();

/// Asks for the robot of a new scene, from pictures: an arm, and the hand that is mounted on it; or
/// one of them alone.
class NewSceneDialog : public QDialog {
  Q_OBJECT

 public:
  explicit NewSceneDialog(QWidget* parent = nullptr);

  /// Chooses robots to begin with; names that the library has not are passed over.
  void choose(const std::vector<std::string>& robots);

 signals:
  /// @param robot of the library. @param hand to mount on it; empty: none.
  void chosen(const std::string& robot, const std::string& hand);
  /// A robot that the library has not is wanted.
  void file_wanted();

 private:
  QWidget* make_choice();
  void add_cards(QVBoxLayout& layout, const QString& title, QButtonGroup& group,
                 const std::vector<std::string>& names, const QString& none);
  void follow_choice();
  void create();
  [[nodiscard]] static std::string name_in(const QButtonGroup& group);
  [[nodiscard]] bool arm_has_hand() const;

  std::vector<LibraryRobot> robots_;
  QButtonGroup* arms_;
  QButtonGroup* hands_;
  QLabel* note_;
  QPushButton* create_;
};

}  // namespace handway::gui
