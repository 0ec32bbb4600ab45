#pragma once

#include <QWidget>

#include <Eigen/Core>

namespace handway::gui {

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

}  // namespace handway::gui
