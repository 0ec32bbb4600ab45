#pragma once

#include "handway/device/core/device_stream.h"
#include "handway/device/export.h"
#include "handway/device/glove/glove_layout.h"
#include "handway/device/glove/raw_columns.h"

#include <string>
#include <vector>

namespace handway::device {

/// Properties that a connected glove reports.
struct GloveInfo {
  std::string device;           ///< Port or file, as the user named it.
  std::string model;            ///< "CyberGlove, firmware 1.2".
  int sensors = kGloveSensors;  ///< See cyberglove_wired().
  bool right_hand = true;
  double rate = 0.0;  ///< Requested frames per second, Hz.
  double round_trip =
      0.0;  ///< Shortest time from a query to its answer, s; 0 if no query was made.
  /// Sensors with angles, of a source that measures angles itself. Empty: a glove of counts.
  SensorIndices angle_sensors;
  /// Names and units of GloveFrame::raw, without values; empty for a glove of counts.
  RawColumns raw = {};
};

/// A sensorized glove (paper, section 3), or a replacement: frames of raw counts. Every count of a
/// sensor that the glove has is from 1 to 255.
class HANDWAY_DEVICE_EXPORT Glove : public SampledDevice<GloveInfo, GloveFrame> {
 private:
  void check_info(const GloveInfo& info) override;
  void check_sample(const GloveFrame& frame) const override;

  int sensors_ = kGloveSensors;
};

/// Result of reading a glove once.
using GloveReading = Glove::Reading;

/// Stream of a glove's frames, read on a thread of its own.
using GloveStream = DeviceStream<Glove>;
/// Callbacks of a glove's stream.
using GloveStreamHandlers = GloveStream::Handlers;

}  // namespace handway::device
