#pragma once

#include "handway/device/glove/glove_layout.h"
#include "handway/device/glove/hand_mapper.h"
#include "handway/device/glove/hand_mapping.h"
#include "model/devices/glove_session.h"

#include <QWidget>

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace handway::gui {

/// State of a glove's sensors as observed while they are used.
class SensorWatch {
 public:
  enum class Verdict {
    kGood,
    kMissing,    ///< The glove lacks this sensor.
    kSaturated,  ///< At an end of its range for most of the last moments.
    kDead,       ///< Has not moved, though others have.
  };

  struct Sensor {
    std::uint16_t counts = 0;
    std::uint16_t least = 0;  ///< Since the beginning.
    std::uint16_t most = 0;
    double at_end = 0.0;  ///< Share of the recent frames at 1 or 255.
    Verdict verdict = Verdict::kMissing;
  };

  void restart() { *this = {}; }
  void take(const device::GloveFrame& frame);

  [[nodiscard]] const std::array<Sensor, device::kGloveSensors>& sensors() const {
    return sensors_;
  }

 private:
  [[nodiscard]] int moving() const;

  std::array<Sensor, device::kGloveSensors> sensors_{};
  double first_time_ = -1.0;
};

/// A row for each of the glove's 22 sensors, fingers apart: letter, name, a bar of the counts with
/// the range that was seen, counts and degrees. Sensors that drive no joint are pale; what
/// looks broken and what drives a joint to its limit is marked.
class SensorBars : public QWidget {
  Q_OBJECT

 public:
  explicit SensorBars(QWidget* parent = nullptr);

  /// Forgets the glove: empty bars.
  void clear();
  void set_mapping(const device::HandMapping& mapping);
  /// @param mapper of the sample's posture; may be null.
  void show_samples(const std::vector<GloveSample>& samples, const device::HandMapper* mapper);

  [[nodiscard]] const SensorWatch& watch() const { return watch_; }
  /// Joints at a limit that the latest sample would have gone beyond.
  [[nodiscard]] const std::vector<std::string>& clamped() const { return clamped_; }

  [[nodiscard]] QSize sizeHint() const override;
  [[nodiscard]] QSize minimumSizeHint() const override;

 protected:
  void paintEvent(QPaintEvent* event) override;
  bool event(QEvent* event) override;

 private:
  [[nodiscard]] QString explain(int sensor) const;
  [[nodiscard]] int top_of(int sensor) const;
  [[nodiscard]] bool at_limit(int sensor) const;
  void paint_row(QPainter& painter, int sensor) const;

  SensorWatch watch_;
  std::optional<GloveSample> latest_;
  std::array<std::vector<std::string>, device::kGloveSensors> driven_;
  std::vector<std::string> clamped_;
};

}  // namespace handway::gui
