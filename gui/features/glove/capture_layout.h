#pragma once

namespace handway::gui {

inline constexpr int kSideMargin = 12;  ///< Margin left and right of the parts of the coach, px.

}  // namespace handway::gui
