#pragma once

#include "features/glove/basis_report.h"
#include "features/glove/capture_pages.h"
#include "features/glove/hand_bases.h"
#include "handway/geometric/robot/robot_description.h"
#include "handway/geometric/robot/robot_model.h"
#include "handway/sampling/postures/pmd_basis.h"
#include "model/devices/glove_session.h"

#include <QPointF>
#include <QString>
#include <QWidget>

#include <Eigen/Core>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

class QComboBox;
class QLabel;
class QPushButton;
class QSpinBox;
class QTabBar;

namespace handway::gui {

/// Two axes of a PMD basis as a plane: postures as dots, the box B^h, and the hand's own
/// posture as a handle that can be dragged within the box.
class PmdPad : public QWidget {
  Q_OBJECT

 public:
  struct Axis {
    QString name;
    double half_side = 0.0;  ///< λ, normalised.
  };

  explicit PmdPad(QWidget* parent = nullptr);

  /// Nothing to show, and why.
  void clear(const QString& reason);
  void set_axes(const Axis& x, const Axis& y);
  /// @param dots coordinates of postures along both axes.
  void set_dots(std::vector<QPointF> dots);
  /// Where the hand is.
  void set_posture(const QPointF& coordinates);
  [[nodiscard]] const QPointF& posture() const { return posture_; }

  /// Pixel of a point of the plane.
  [[nodiscard]] QPointF to_pixel(const QPointF& coordinates) const;

  [[nodiscard]] QSize sizeHint() const override { return {300, 260}; }
  [[nodiscard]] QSize minimumSizeHint() const override { return {160, 150}; }

 signals:
  /// Dragged or clicked there; within the box.
  void moved(const QPointF& coordinates);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;

 private:
  [[nodiscard]] QRectF plane() const;
  [[nodiscard]] QPointF from_pixel(const QPointF& pixel) const;
  void drag_to(const QPointF& pixel);
  void fit_extent();
  void paint_frame(QPainter& painter) const;

  Axis x_;
  Axis y_;
  QString reason_;
  std::vector<QPointF> dots_;
  QPointF posture_;
  double extent_x_ = 1.0;  ///< Coordinate at the right edge.
  double extent_y_ = 1.0;
};

/// The axes of a PMD basis on the hand of a robot: postures to coordinates and back.
class HandAxes {
 public:
  HandAxes() = default;
  /// Empty if the robot lacks a joint of the basis.
  HandAxes(std::shared_ptr<const geometric::RobotModel> model, sampling::PmdBasis basis);

  [[nodiscard]] bool empty() const { return variables_.empty(); }
  [[nodiscard]] const sampling::PmdBasis& basis() const { return basis_; }
  [[nodiscard]] int dimension() const { return empty() ? 0 : basis_.dimension(); }
  [[nodiscard]] QString name(int axis) const;
  [[nodiscard]] double half_side(int axis) const;

  /// @param q shape [variable_count]. @returns shape [dimension].
  [[nodiscard]] Eigen::VectorXd coordinates(const geometric::Configuration& q) const;
  /// @param posture normalised joints named `joints`. @returns shape [dimension]; empty if
  /// one of the basis' joints is not among them.
  [[nodiscard]] Eigen::VectorXd coordinates(const std::vector<std::string>& joints,
                                            const Eigen::VectorXd& posture) const;
  /// The hand's posture at coordinates within the box.
  [[nodiscard]] geometric::NamedPosture posture(const Eigen::VectorXd& coordinates) const;

 private:
  std::shared_ptr<const geometric::RobotModel> model_;
  sampling::PmdBasis basis_;
  std::vector<int> variables_;  ///< Of the basis' joints.
};

/// Correlations of all pairs of joints as a square of colours: blue together, red
/// against each other (paper, section 4.2).
class CorrelationMap : public QWidget {
  Q_OBJECT

 public:
  explicit CorrelationMap(QWidget* parent = nullptr);

  /// @param correlations in [-1, 1], shape [joints, joints]; empty: not known.
  void set_correlations(const std::vector<std::string>& joints,
                        const Eigen::MatrixXd& correlations);

  [[nodiscard]] QSize sizeHint() const override { return {130, 140}; }
  [[nodiscard]] QSize minimumSizeHint() const override { return {90, 140}; }

 protected:
  void paintEvent(QPaintEvent* event) override;
  bool event(QEvent* event) override;

 private:
  [[nodiscard]] QRectF square() const;

  std::vector<std::string> joints_;
  Eigen::MatrixXd correlations_;
};

/// How much of the variance the first principal directions hold together: bars for each, a
/// line for their sum (paper, Fig. 10).
class VarianceChart : public QWidget {
  Q_OBJECT

 public:
  explicit VarianceChart(QWidget* parent = nullptr);

  /// @param shares in [0, 1], falling; empty: not known.
  void set_shares(const Eigen::VectorXd& shares);

  [[nodiscard]] QSize sizeHint() const override { return {130, 140}; }
  [[nodiscard]] QSize minimumSizeHint() const override { return {90, 140}; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  Eigen::VectorXd shares_;
};

/// How many principal motion directions a basis of the postures gets, and which joints have an axis
/// of their own.
class BasisOptions : public QWidget {
  Q_OBJECT

 public:
  explicit BasisOptions(QWidget* parent = nullptr);

  /// @param free joints, as indices, that have an axis of their own at first. Nothing changes while
  /// the joints are the same.
  void set_joints(const std::vector<std::string>& joints, const std::vector<int>& free);
  [[nodiscard]] sampling::PmdBasisOptions options() const;

 signals:
  void changed();

 private:
  void take_joints();

  std::vector<std::string> joints_;
  QSpinBox* directions_;
  QPushButton* free_;
};

/// Explores a hand along its principal motion directions: two axes as a pad to drag in, the
/// postures that were captured or recorded as dots, what the directions hold of the
/// variance, and which joints go together; or a report of how good a basis of them is. Bases are
/// chosen here, made of the postures, saved, compared, and taken for planning.
class PmdExplorer : public QWidget {
  Q_OBJECT

 public:
  explicit PmdExplorer(QWidget* parent = nullptr);

  /// Another scene. @param basis that it names; its basis may be null.
  void set_hand(std::shared_ptr<const geometric::RobotModel> model, const HandBasis& basis);
  /// The scene names another basis.
  void set_scene_basis(const HandBasis& basis);
  /// Where the hand is. @param q shape [variable_count].
  void set_configuration(const geometric::Configuration& q);
  /// What has been captured or recorded. @param source for people; empty: live.
  /// @param hand what a basis of them is of.
  void show_postures(const CapturedPostures& postures, const QString& source,
                     const std::string& hand);
  /// What made the postures of the person's.
  void show_method(PostureMethod method);
  /// How far each method's fingertips are from the person's; for people.
  void show_errors(const QString& text);
  [[nodiscard]] BasisReportView& report() { return *report_; }
  /// How many directions a basis of the postures gets, and which joints have their own axis.
  [[nodiscard]] sampling::PmdBasisOptions options() const { return options_->options(); }
  /// Takes a basis from a file, and shows it.
  /// @throws geometric::InputError as open_basis().
  void open(const std::filesystem::path& file);
  /// Saves the basis that is shown, and shows it as that file's.
  /// @throws geometric::InputError as save_basis().
  void save(const std::filesystem::path& file);

 signals:
  void posture_changed(const handway::geometric::NamedPosture& posture);
  void method_chosen(handway::gui::PostureMethod method);
  void recording_requested();
  /// Show the live postures again.
  void live_requested();
  /// Plan with it. @param file as a scene names it.
  void basis_chosen(const std::filesystem::path& file,
                    const std::shared_ptr<const handway::sampling::PmdBasis>& basis);
  void failed(const QString& message);
  /// The page has come to be seen.
  void shown();
  /// Another number of directions, or other free joints.
  void options_changed();

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  [[nodiscard]] QWidget* build_buttons();
  [[nodiscard]] QWidget* build_views();
  void list_bases();
  void take_choice(int row);
  void add_basis(HandBasis basis);
  [[nodiscard]] HandBasis made_basis() const;
  [[nodiscard]] const HandBasis* shown_basis() const;
  void show_comparison();
  void choose_to_open();
  /// @returns whether it was saved.
  bool choose_to_save();
  void use_shown();
  void rebuild_axes();
  void choose_axes();
  void show_dots();
  void show_statistics();
  void move_hand(const QPointF& coordinates);
  [[nodiscard]] bool shows_own_basis() const;

  std::shared_ptr<const geometric::RobotModel> model_;
  HandBasis scene_basis_;         ///< Of the scene; without basis: it names none.
  HandBasis made_;                ///< Of the postures; without basis: there are too few.
  std::vector<HandBasis> bases_;  ///< Of the library and of files.
  CapturedPostures postures_;
  QString postures_source_;
  std::string hand_;
  HandAxes axes_;
  geometric::Configuration q_;
  QComboBox* source_;
  QComboBox* method_;
  QLabel* errors_;
  QComboBox* basis_;
  BasisOptions* options_;
  QPushButton* save_;
  QPushButton* use_;
  QComboBox* across_;
  QComboBox* up_;
  PmdPad* pad_;
  VarianceChart* variance_;
  CorrelationMap* correlation_;
  BasisComparisonView* comparison_;
  BasisReportView* report_;
  QTabBar* views_;
  QLabel* note_;
  bool moving_ = false;  ///< The change that arrives is this widget's own.
};

}  // namespace handway::gui
