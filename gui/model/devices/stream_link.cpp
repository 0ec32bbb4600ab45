#include "model/devices/stream_link.h"

namespace handway::gui {

void StreamLink::set_state(device::StreamState state, const std::string& error) {
  state_ = state;
  emit state_changed(state, QString::fromStdString(error));
}

}  // namespace handway::gui
