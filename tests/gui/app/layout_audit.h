#pragma once

#include <QSet>
#include <QStringList>

class QWidget;

namespace handway::test {

/// What people can't read of a window: texts that are cut, widgets that lie outside of what they
/// are in, and texts with a contrast below 4.5 (3 of marks such as "●"). Neither what has the whole
/// text in its tool tip nor what a person can scroll to is cut; what is disabled may be faint.
class LayoutAudit {
 public:
  /// Of what is seen in `root` now, one sentence for each fault; each is named once.
  [[nodiscard]] QStringList new_faults(QWidget& root);

 private:
  QSet<QString> known_;    ///< Faults.
  QSet<QString> checked_;  ///< Places and texts that can be told from what is behind them.
};

}  // namespace handway::test
