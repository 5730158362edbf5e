#pragma once

#include "ponte/autopilot/peer.hpp"
#include "ponte/autopilot/subsystem_health.hpp"
#include "ponte/core/quantity.hpp"
#include "ponte/core/time.hpp"

#include <cstdint>
#include <optional>

namespace ponte::autopilot {

/// What the autopilot thinks of its own knowledge of attitude and place (ESTIMATOR_STATUS of PX4, EKF_STATUS_REPORT of
/// ArduPilot).
struct EstimatorHealth {
  bool attitude{};
  bool velocity{};
  bool position{};  ///< on Earth, horizontally
  bool altitude{};
  bool satellites_glitch{};
  /// The worst of what the sensors differ from the estimate, as a share of what it accepts: above 1 it rejects some.
  double worst_ratio{};
  std::optional<Metres> horizontal_accuracy{};  ///< one standard deviation; ArduPilot does not tell
  std::optional<Metres> vertical_accuracy{};
  friend bool operator==(const EstimatorHealth&, const EstimatorHealth&) = default;
};

/// GPS_RAW_INT.
struct SatelliteHealth {
  std::uint8_t fix_type{};  ///< GPS_FIX_TYPE: 3 and above is one with altitude
  std::optional<std::uint8_t> satellites{};
  std::optional<double> horizontal_dilution{};  ///< HDOP
  friend bool operator==(const SatelliteHealth&, const SatelliteHealth&) = default;
};

/// The first battery, by SYS_STATUS.
struct BatteryHealth {
  std::optional<double> voltage_v{};
  std::optional<double> current_a{};
  std::optional<Percent> remaining{};
  friend bool operator==(const BatteryHealth&, const BatteryHealth&) = default;
};

/// How well one vehicle says it is. What it has not said for `lifetime`, or said before it started anew, is not known.
class Health {
 public:
  static constexpr Duration lifetime = std::chrono::seconds{10};  ///< both tell all of it at least every 2 s

  explicit Health(const Peer& peer) : peer_{peer} {}

  /// Any frame with the right checksum; those of others are passed over.
  void on_message(Timestamp now, const mavlink::FrameView& frame);
  void on_reboot() { *this = Health{peer_}; }

  /// Which sensors are there, in use and healthy, bit by bit as in `sensor_rows`.
  [[nodiscard]] std::optional<SensorBits> sensors(Timestamp now) const { return sensors_.at(now); }
  [[nodiscard]] std::optional<BatteryHealth> battery(Timestamp now) const { return battery_.at(now); }
  [[nodiscard]] std::optional<EstimatorHealth> estimator(Timestamp now) const { return estimator_.at(now); }
  [[nodiscard]] std::optional<SatelliteHealth> satellites(Timestamp now) const { return satellites_.at(now); }

 private:
  template <class T>
  struct Told {
    std::optional<T> value{};
    Timestamp heard{};

    void learn(Timestamp now, const T& news) {
      value = news;
      heard = now;
    }
    [[nodiscard]] std::optional<T> at(Timestamp now) const {
      return value && now - heard <= lifetime ? value : std::nullopt;
    }
  };

  Peer peer_;
  Told<SensorBits> sensors_;
  Told<BatteryHealth> battery_;
  Told<EstimatorHealth> estimator_;
  Told<SatelliteHealth> satellites_;
};

}  // namespace ponte::autopilot
