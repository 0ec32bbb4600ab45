#pragma once

class QComboBox;

namespace handway::gui {

/// Offers speeds from a tenth to ten times real time, each item's data the factor; real time is
/// chosen.
void offer_speeds(QComboBox& box);

}  // namespace handway::gui
