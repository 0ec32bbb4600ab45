#pragma once

#include <QString>
#include <QTemporaryDir>

namespace handway::gui {

/// Where parts of a file or folder are made: beside it, on the same disk, under a hidden name that
/// tells which program makes them.
[[nodiscard]] QString parts_beside(const QString& file);

/// @throws geometric::InputError unless the parts' folder could be made.
void need_writable(const QTemporaryDir& parts, const QString& file);

/// Removes parts beside a file that programs have left which were killed on this machine, in the
/// background.
void remove_leftovers_beside(const QString& file);

}  // namespace handway::gui
