#pragma once

#include "handway/planning/edits/arranging.h"
#include "widgets/panels/floating_card.h"

#include <QObject>

#include <array>
#include <string>
#include <vector>

class QCheckBox;
class QComboBox;
class QLabel;
class QPushButton;
class QSpinBox;
class QStackedWidget;

namespace handway::gui {

class QuantityField;
class SceneEditor;
class SceneView;

/// A card at the view's upper right: how many copies, how far apart.
class ArrayCard : public FloatingCard {
  Q_OBJECT

 public:
  explicit ArrayCard(QWidget* host);

  /// Shows it, with distances that suit what is copied.
  void begin(const QString& objects, const geometric::Aabb& box);
  /// Returns the motions that make the copies. @param p_W the middle of what is copied.
  [[nodiscard]] std::vector<geometric::Pose> motions(const Eigen::Vector3d& p_W) const;
  /// Returns whether original and copies become a group.
  [[nodiscard]] bool groups() const;
  /// Shows how many objects will be added; above `most` none are.
  void show_count(int count, int most);

 signals:
  void changed();
  void accepted();
  void closed();

 protected:
  void keyPressEvent(QKeyEvent* event) override;

 private:
  QWidget* make_rows();
  QWidget* make_circle();
  QuantityField* add_field(const char* name, bool is_angle);
  QSpinBox* add_count(const char* name, int least);
  void close();
  void place() override;

  QLabel* title_;
  QComboBox* kind_;
  QStackedWidget* pages_;
  std::array<QSpinBox*, 3> counts_{};
  std::array<QuantityField*, 3> spacings_{};
  QSpinBox* around_ = nullptr;
  QComboBox* axis_ = nullptr;
  std::array<QuantityField*, 3> centre_{};
  QuantityField* angle_ = nullptr;
  QCheckBox* turning_ = nullptr;
  QCheckBox* group_;
  QLabel* note_;
  QPushButton* make_;
};

/// Copies of the selected objects in rows or around an axis: shown while a card over the
/// view is filled in, made in one edit.
class ArrayTool : public QObject {
  Q_OBJECT

 public:
  /// Largest number of copies that are made at once.
  static constexpr int kMostCopies = 400;

  /// All outlive it.
  ArrayTool(SceneEditor& editor, SceneView& view, QObject* parent = nullptr);

  void begin();

 private:
  void show_copies();
  void finish();
  void end();

  SceneEditor& editor_;
  SceneView& view_;
  ArrayCard* card_;
  planning::ObjectNames names_;  ///< Names of the objects to copy.
  planning::Copies copies_;
};

}  // namespace handway::gui
