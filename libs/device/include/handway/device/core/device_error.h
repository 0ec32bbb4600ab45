#pragma once

#include "handway/device/export.h"
#include "handway/geometric/io/input_error.h"

namespace handway::device {

/// A device that can't be reached, doesn't answer as it should, or went away. `problem().source`
/// is the device's name as the user gave it.
class HANDWAY_DEVICE_EXPORT DeviceError : public geometric::InputError {
 public:
  using geometric::InputError::InputError;
};

}  // namespace handway::device
