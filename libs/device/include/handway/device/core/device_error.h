#pragma once

#include "handway/device/export.h"
#include "handway/geometric/io/input_error.h"

namespace handway::device {

/// Error of a device that can't be reached, answers wrongly, or is gone. `problem().source` is the
/// device's name as the user gave it.
class HANDWAY_DEVICE_EXPORT DeviceError : public geometric::InputError {
 public:
  using geometric::InputError::InputError;
};

}  // namespace handway::device
