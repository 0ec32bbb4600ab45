#pragma once

#include <QFrame>

class QLabel;

namespace handway::gui {

/// One message over the view that does not stop anybody: what went wrong, and a
/// button to put it away.
class Banner : public QFrame {
  Q_OBJECT

 public:
  /// Floats at the top of `host`.
  explicit Banner(QWidget* host);

  void show_message(const QString& title, const QString& message);
  [[nodiscard]] QString message() const;

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void place();

  QLabel* picture_;
  QLabel* text_;
};

}  // namespace handway::gui
