#include "model/devices/tracker_session.h"

#include "handway/device/tracker/polhemus_tracker.h"
#include "handway/device/tracker/tracker_units.h"
#include "handway/device/tracker/udp_tracker.h"
#include "handway/geometric/io/input_error.h"

#include <exception>
#include <memory>

namespace handway::gui {
namespace {

using device::StreamState;

constexpr std::uint64_t kEmulatorSeed = 1;

std::unique_ptr<device::Tracker> polhemus(device::PolhemusModel model, const std::string& address) {
  device::PolhemusSettings settings;
  settings.model = model;
  return std::make_unique<device::PolhemusTracker>(address, settings);
}

}  // namespace

TrackerSession::TrackerSession(QObject* parent) : QObject(parent) {
  connect(&link_, &TrackerLink::state_changed, this, &TrackerSession::state_changed);
  connect(&link_, &TrackerLink::arrived, this, &TrackerSession::sampled);
}

TrackerSession::~TrackerSession() { link_.blockSignals(true); }

QStringList TrackerSession::protocols() {
  return {QStringLiteral("emulator"), QStringLiteral("fastrak"), QStringLiteral("liberty"),
          QStringLiteral("udp")};
}

void TrackerSession::connect_to(const QString& device) {
  device_ = device.trimmed();
  const QString protocol = device_.section(QLatin1Char(':'), 0, 0).toLower();
  try {
    start(protocol, device_.mid(protocol.size() + 1).trimmed());
  } catch (const std::exception& error) {
    link_.stop();
    emit state_changed(StreamState::kFailed, QString::fromUtf8(error.what()));
  }
}

void TrackerSession::start(const QString& protocol, const QString& address) {
  if (protocol == QLatin1String("emulator")) {
    auto emulator = std::make_unique<device::DeviceEmulator>(
        device::DeviceEmulatorSettings{},
        device::make_fastrak_unit({}, device::wrist_motion_signal(kEmulatorSeed)));
    auto tracker = polhemus(device::PolhemusModel::kFastrak, emulator->address());
    link_.start(std::move(tracker), std::move(emulator));
    return;
  }
  if (!protocols().contains(protocol)) {
    throw geometric::InputError({"tracker", "", protocol.toStdString(),
                                 protocols().join(QStringLiteral(", ")).toStdString(),
                                 "Write, for example, fastrak:/dev/ttyUSB0"});
  }
  if (address.isEmpty()) {
    throw geometric::InputError({"tracker", "", "no address",
                                 protocol == QLatin1String("udp") ? "a port to hear datagrams on"
                                                                  : "a serial port or HOST:PORT",
                                 "Fill it in, or choose the emulator to try without a tracker"});
  }
  if (protocol == QLatin1String("udp")) {
    link_.start(std::make_unique<device::UdpTracker>(address.toStdString()));
  } else {
    link_.start(polhemus(protocol == QLatin1String("liberty") ? device::PolhemusModel::kLiberty
                                                              : device::PolhemusModel::kFastrak,
                         address.toStdString()));
  }
}

void TrackerSession::disconnect_tracker() { link_.stop(); }

}  // namespace handway::gui
