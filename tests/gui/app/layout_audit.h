#pragma once

#include <QSet>
#include <QStringList>

class QWidget;

namespace handway::test {

/// Finds what users can't read of a window: texts that are cut, widgets that lie outside of their
/// parent, and texts with a contrast below 4.5 (3 for marks such as "●"). Texts are not cut if the
/// tool tip has the whole text or if they can be scrolled to; disabled ones may be faint.
class LayoutAudit {
 public:
  /// Returns the faults of what is visible in `root` now, one sentence for each; each is named
  /// once.
  [[nodiscard]] QStringList new_faults(QWidget& root);

 private:
  QSet<QString> known_;    ///< Faults.
  QSet<QString> checked_;  ///< Places and texts that differ from their background.
};

}  // namespace handway::test
