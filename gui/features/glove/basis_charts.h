#pragma once

#include <QWidget>

#include <Eigen/Core>

#include <string>
#include <vector>

namespace handway::gui {

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

/// Chart of the variance that the first principal directions explain together: bars for each, a
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

}  // namespace handway::gui
