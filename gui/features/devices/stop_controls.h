#pragma once

#include <QList>
#include <QObject>
#include <QPointer>
#include <QString>

class QPushButton;
class QWidget;

namespace handway::gui {

/// Controls of the program's windows that stop the robot: keys that no dialog, popup or text field
/// keeps for itself, and a STOP button in the main window and along the top of every dialog, also
/// of later ones. Buttons stop when they are pressed, not when they are released.
///
/// Native dialogs and menu bars can't show the button: from the constructor on the program uses
/// Qt's own.
class StopControls : public QObject {
  Q_OBJECT

 public:
  explicit StopControls(QObject* parent = nullptr);

  /// A button that is shown while there is something to stop. A window takes it over.
  [[nodiscard]] QPushButton* make_button(const QString& name);
  /// @param active whether there is something to stop.
  void set_active(bool active);

  /// Returns the keys for tool tips: "Ctrl+Space, Pause or F12".
  [[nodiscard]] static QString keys_text();

 signals:
  void stop_requested();

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void add_to(QWidget& window);
  [[nodiscard]] bool is_at_button(const QPoint& place) const;

  bool active_ = false;
  QList<QPointer<QPushButton>> buttons_;
};

}  // namespace handway::gui
