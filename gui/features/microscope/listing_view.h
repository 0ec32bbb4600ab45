#pragma once

#include "handway/planning/core/observer.h"

#include <QString>
#include <QWidget>

#include <span>
#include <string_view>

class QLabel;
class QPlainTextEdit;

namespace handway::gui {

/// Algorithms 1 to 4 of the paper (sections 5.1 to 5.3), its lines in other words.
struct AlgorithmListing {
  int algorithm;
  const char* title;                        ///< "SampleArm(step, ρₐ)"
  std::span<const std::string_view> lines;  ///< Line 1 first, indented by two spaces a level.
};

/// @pre algorithm is 1 to 4.
[[nodiscard]] const AlgorithmListing& algorithm_listing(int algorithm);

/// One of the paper's listings with its line numbers, one line marked.
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
  void changeEvent(QEvent* event) override;
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
