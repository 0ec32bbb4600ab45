#pragma once

#include <QString>
#include <QWidget>

class QToolButton;

namespace handway::gui {

/// A heading with an arrow that shows and hides what is below it. Whether it is open is remembered
/// from one run to the next.
class Disclosure : public QWidget {
  Q_OBJECT

 public:
  /// @param name by which tests and kept settings find it. It is closed at first.
  Disclosure(const char* name, const QString& title, QWidget* content, QWidget* parent = nullptr);

 private:
  QToolButton* heading_;
  QWidget* content_;
};

}  // namespace handway::gui
