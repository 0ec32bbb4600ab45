#pragma once

#include <QString>

#include <optional>

namespace handway::gui {

/// How well `text` answers to what was typed: all letters of `typed` must be in it, in
/// order, whatever their case. Letters that begin words or follow each other count
/// more. Nothing: it does not.
[[nodiscard]] std::optional<int> fuzzy_score(const QString& typed, const QString& text);

}  // namespace handway::gui
