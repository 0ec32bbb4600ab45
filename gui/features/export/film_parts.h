#pragma once

#include <QString>

class QTemporaryDir;

namespace handway::gui {

/// Returns the folder for parts of a file or folder: beside it, on the same disk, under a hidden
/// name that contains the name of the program.
[[nodiscard]] QString parts_beside(const QString& file);

/// Checks that parts can be written. @throws geometric::InputError unless the parts' folder could
/// be made.
void need_writable(const QTemporaryDir& parts, const QString& file);

/// Removes parts beside a file that programs have left which were killed on this machine, in the
/// background.
void remove_leftovers_beside(const QString& file);

}  // namespace handway::gui
