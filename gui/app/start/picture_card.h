#pragma once

#include <QAbstractButton>
#include <QPixmap>
#include <QString>

#include <string>

namespace handway::gui {

/// A picture with a name below it, to be clicked; one that is checked has a frame.
class PictureCard : public QAbstractButton {
  Q_OBJECT

 public:
  static constexpr int kWidth = 288;

  /// @param picture file or resource; without it there is an icon. @param width px.
  PictureCard(const QString& title, const QString& picture, int width = kWidth,
              QWidget* parent = nullptr);

  [[nodiscard]] QSize sizeHint() const override;

 protected:
  void showEvent(QShowEvent* event) override;
  void hideEvent(QHideEvent* event) override;
  void paintEvent(QPaintEvent* event) override;
  void enterEvent(QEvent* event) override;
  void leaveEvent(QEvent* event) override;

 private:
  [[nodiscard]] int picture_height() const;

  QString file_;  ///< File of the picture.
  QPixmap picture_;
  int width_;
};

/// The file of the picture of a robot of the library; there may be none.
[[nodiscard]] QString robot_picture(const std::string& robot);

}  // namespace handway::gui
