#pragma once

#include "ponte/sim/failsafe.hpp"
#include "ponte/sim/flight_rig.hpp"
#include "ponte/sim/plane.hpp"

#include <memory>
#include <string_view>

namespace ponte::sim {

/// A flight under the eyes of its failsafes: a copter hovers 25 m above home, in GUIDED or AUTO.LOITER; a plane
/// circles.
class WatchedFlight {
 public:
  explicit WatchedFlight(VehicleKind kind, CopterConfig config = {})
      : kind_{kind},
        parameters_{kind.personality, kind.type},
        failsafes_{kind, settings_of(kind, parameters_).failsafes},
        rig{kind, airframe(kind, config)} {
    rig.before_step = [this](Duration now, Flight& flight, Airframe& airframe, Outbox<FlightFact>& facts) {
      if (station_) failsafes_.on_station_heartbeat(now);
      flight.set_has_position(has_position);
      failsafes_.step(now, has_position, flight, airframe, facts);
    };
    begin();
    rig.texts.clear();
  }

  void set(std::string_view name, double value) {
    parameters_.set(name, value);
    const auto settings = settings_of(kind_, parameters_);
    failsafes_.set_settings(settings.failsafes);
    rig.flight().set_settings(settings.flight);
  }
  const Failsafes& failsafes() const { return failsafes_; }
  Failsafes& failsafes() { return failsafes_; }
  void lose_station() { station_ = false; }

 private:
  static std::unique_ptr<Airframe> airframe(VehicleKind kind, const CopterConfig& config) {
    if (kind.type == AirframeType::plane) return std::make_unique<Plane>(PlaneConfig{}, field, Radians{});
    return std::make_unique<Copter>(config, field, Radians{});
  }

  void begin() {
    if (kind_.type == AirframeType::plane) {
      if (kind_.personality == Personality::px4) set("MIS_TAKEOFF_ALT", 50);
      EXPECT_TRUE(rig.enter(FlightMode::take_off));
      rig.arm();
      rig.wait(seconds{40});
      EXPECT_TRUE(rig.enter(FlightMode::loiter));
      return rig.wait(seconds{20});
    }
    EXPECT_TRUE(rig.enter(kind_.personality == Personality::px4 ? FlightMode::loiter : FlightMode::guided));
    rig.arm();
    EXPECT_TRUE(rig.take_off(25));
    rig.wait(seconds{25});
  }

  VehicleKind kind_;
  Parameters parameters_;
  Failsafes failsafes_;
  bool station_{true};

 public:
  FlightRig rig;
  bool has_position{true};
};

}  // namespace ponte::sim
