#pragma once

#include "handway/device/export.h"

#include <cstdint>
#include <deque>

namespace handway::device {

/// How well a stream of frames runs.
struct StreamStatistics {
  std::uint64_t frames = 0;
  double rate = 0.0;      ///< Frames a second over the last second, Hz.
  double jitter = 0.0;    ///< Mean deviation of the last second's intervals from their mean, s.
  double latency = 0.0;   ///< From a question to its answer on this connection, s; 0: none asked.
  double handling = 0.0;  ///< Mean time that a frame took from its arrival to the end of
                          ///< its handler, over the last second, s.
  std::uint64_t dropouts = 0;  ///< Intervals longer than three and a half of the asked rate's.
  double longest_gap = 0.0;    ///< Longest interval between two frames, s.
  std::uint64_t reconnects = 0;
  std::uint64_t resynchronisations = 0;  ///< Times that bytes had to be dropped.
};

/// Keeps StreamStatistics of frames as they arrive.
class HANDWAY_DEVICE_EXPORT StreamStatisticsCounter {
 public:
  /// A connection was made, on which so many frames a second (Hz) should come.
  void connected(double rate, double round_trip);

  /// A frame arrived at `time` (s, never falling) and was handled at `handled`.
  void frame(double time, double handled);

  void resynchronised(std::uint64_t total) { statistics_.resynchronisations = total; }

  /// @param now s, on the frames' clock.
  [[nodiscard]] StreamStatistics at(double now) const;

 private:
  struct Arrival {
    double time;
    double handling;
  };

  StreamStatistics statistics_;
  std::deque<Arrival> recent_;
  double period_ = 0.0;
  double last_time_ = 0.0;
  bool begun_ = false;
};

}  // namespace handway::device
