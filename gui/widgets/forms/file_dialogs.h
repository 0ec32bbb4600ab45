#pragma once

#include <QString>

class QWidget;

namespace handway::gui {

/// Asks for the file to write; the proposed name is selected without its ending. A name without an
/// ending gets that of the chosen type before the question whether to replace an existing file.
/// @param name that is proposed, with or without a folder.
/// @param filters as QFileDialog has them. @returns nothing if it was cancelled.
[[nodiscard]] QString ask_where_to_save(QWidget* parent, const QString& title, const QString& name,
                                        const QString& filters);

}  // namespace handway::gui
