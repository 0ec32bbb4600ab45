#pragma once

#include <QFrame>
#include <QList>

namespace handway::gui {

/// A frame that floats over a widget and keeps its place when that one is resized.
/// It is hidden until it appears.
class FloatingCard : public QFrame {
  Q_OBJECT

 public:
  explicit FloatingCard(QWidget* host);

 protected:
  /// Shows it in its place, over the others.
  void appear();
  /// Sets the geometry in the host's coordinates; called whenever the host is resized, or another
  /// card over it comes, goes or is resized.
  virtual void place() = 0;
  /// The others that are shown over the same widget.
  [[nodiscard]] QList<FloatingCard*> others() const;
  void showEvent(QShowEvent* event) override;
  void hideEvent(QHideEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void place_others() const;
};

}  // namespace handway::gui
