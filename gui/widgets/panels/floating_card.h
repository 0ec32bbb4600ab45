#pragma once

#include <QFrame>
#include <QList>
#include <QPoint>
#include <QSize>

#include <cstddef>
#include <functional>
#include <vector>

class QLabel;
class QPushButton;
class QToolButton;

namespace handway::gui {

/// A frame that floats over a widget and keeps its place when that one is resized.
/// It is hidden until it appears.
class FloatingCard : public QFrame {
  Q_OBJECT

 public:
  /// @param role in the style sheet.
  FloatingCard(QWidget* host, const char* name, const char* role);

 protected:
  /// Shows it in its place, over the others.
  void appear();
  /// Sets the geometry in the host's coordinates; called whenever the host is resized, or another
  /// card over it comes, goes or is resized.
  virtual void place() = 0;
  /// The button that puts it away; without an effect of its own.
  [[nodiscard]] QToolButton* make_close(const char* name, const QString& tip);
  /// A button that leaves of the card what is not in `details`, and back.
  [[nodiscard]] QToolButton* make_fold(const QString& name, QWidget& details);
  /// Moves it, as large as it has to be, to the lower right, above others that are there.
  void stand_at_lower_right();
  /// Moves it, with this size, to the corner of the host where it hides least. The lower right is
  /// the first choice.
  void stand_where_it_hides_least(const QSize& size, const std::vector<QPoint>& to_be_seen);
  /// Returns how much it hides at a place: the number of these points, and far more for another
  /// card.
  [[nodiscard]] std::ptrdiff_t hidden_at(const QRect& place,
                                         const std::vector<QPoint>& to_be_seen) const;
  /// Returns the middle part of the host between other cards that are higher than half of it; all
  /// of the host if that part is narrower than `least`.
  [[nodiscard]] QRect between_high_cards(int least) const;
  /// Returns the other cards over the same widget.
  [[nodiscard]] QList<FloatingCard*> others() const;
  void showEvent(QShowEvent* event) override;
  void hideEvent(QHideEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void place_others() const;
};

/// A message over the view that does not block the user: an error or a suggestion, and a button to
/// close it.
class Banner : public FloatingCard {
  Q_OBJECT

 public:
  /// Floats at the top of `host`.
  explicit Banner(QWidget* host);

  void show_message(const QString& title, const QString& message);
  /// Closes a message; an offer stays.
  void hide_message();
  /// A question that may be left open. Both buttons put the banner away.
  void offer(const QString& title, const QString& message, const QString& accept,
             std::function<void()> on_accept, const QString& refuse,
             std::function<void()> on_refuse);
  [[nodiscard]] QString message() const;

 private:
  void show_text(const QString& title, const QString& message, bool is_offer);
  void place() override;

  QLabel* picture_;
  QLabel* text_;
  bool is_offer_ = false;
  QWidget* answers_;
  QPushButton* accept_;
  QPushButton* refuse_;
  std::function<void()> on_accept_;
  std::function<void()> on_refuse_;
};

}  // namespace handway::gui
