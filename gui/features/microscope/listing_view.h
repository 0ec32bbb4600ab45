#pragma once

#include <QWidget>

class QLabel;
class QPlainTextEdit;

namespace handway::gui {

/// Shows one of the paper's listings with its line numbers, one line marked.
class ListingView : public QWidget {
  Q_OBJECT

 public:
  explicit ListingView(QWidget* parent = nullptr);

  /// @param algorithm 1 to 4. @param line from 1. @param calls paler: the line only calls
  /// another algorithm.
  void show_line(int algorithm, int line, bool calls);
  void clear();
  [[nodiscard]] int algorithm() const { return algorithm_; }
  [[nodiscard]] int line() const { return line_; }

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  void show_title();
  void mark();

  QLabel* title_;
  QPlainTextEdit* text_;
  int algorithm_ = 0;  ///< 0: none.
  int line_ = 0;
  bool calls_ = false;
};

}  // namespace handway::gui
