#pragma once

#include <QAbstractButton>
#include <QPixmap>

namespace handway::gui {

/// A picture with a name below it, to be clicked.
class SceneCard : public QAbstractButton {
  Q_OBJECT

 public:
  static constexpr int kWidth = 232;
  static constexpr int kPictureHeight = 145;

  SceneCard(const QString& title, const QString& picture, QWidget* parent = nullptr);

  [[nodiscard]] QSize sizeHint() const override;

 protected:
  void paintEvent(QPaintEvent* event) override;
  void enterEvent(QEvent* event) override;
  void leaveEvent(QEvent* event) override;

 private:
  QPixmap picture_;
};

}  // namespace handway::gui
