#include "ponte/dlisession/status_messages.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <string>
#include <vector>

namespace ponte::dlisession {
namespace {

using namespace std::string_view_literals;
using std::chrono::milliseconds;
using std::chrono::seconds;
using vehicle::Condition;
using vehicle::Leg;
using vehicle::Mode;
using vehicle::ModeKind;
using vehicle::Phase;
using vehicle::Subsystem;
using vehicle::Waypoint;

constexpr WallTime now = wall_time_from_unix_us(1'700'000'000'000'000);
constexpr std::int64_t now_stamp = 753'315'200'000;  ///< ms from 2000-01-01 to 2023-11-14 22:13:20
constexpr double pi = 3.14159265358979;

VehicleDescription description() {
  return {.vsm = dli::EntityId{20, dli::EntityType::vsm, 1},
          .vehicle = dli::EntityId{20, dli::EntityType::vehicle, 7},
          .vehicle_type = 3,
          .vehicle_subtype = std::nullopt,
          .tail_number = {},
          .call_sign = {}};
}

/// Raw integer, in decimal, or text of each field that a message has, by the field's key.
using Fields = std::map<std::string, std::string>;

std::string number(std::int64_t value) { return std::to_string(value); }
const std::string absent = "(absent)";

template <dli::Message M>
Fields fields_of(const M& message) {
  Fields fields;
  M::visit(message, [&]<class T>(const dli::FieldInfo& field, const T& member) {
    if constexpr (requires { member->view(); }) {
      if (member) fields[std::string{field.key}] = std::string{member->view()};
    } else if constexpr (requires { static_cast<std::int64_t>(*member); }) {
      if (member) fields[std::string{field.key}] = number(static_cast<std::int64_t>(*member));
    }
  });
  return fields;
}

template <dli::Message M>
Fields told(const vehicle::State& state, vehicle::Revision since = 0, const VehicleDescription& config = description(),
            const dli::Profile& profile = {}) {
  const auto built = status_message<M>(state, since, {profile, config});
  return built ? fields_of(built->message) : Fields{};
}

template <class T>
void learn(vehicle::State& state, vehicle::FactOf<T> fact, const T& value, WallTime at = now) {
  (state.*fact).learn(value, {at, Timestamp{}, ++state.revision});
}

/// What one row has to make of one value of its source.
struct Case {
  std::uint16_t message;
  std::string field;
  std::string source;
  Fields told;
  std::string expected;
};

class Cases {
 public:
  /// With nothing known but `fact`, the field has this raw value.
  template <dli::Message M, class Raw, class T>
  void add(std::optional<Raw> M::*field, vehicle::FactOf<T> fact, const T& value, std::string expected,
           const VehicleDescription& config = description()) {
    vehicle::State state;
    learn(state, fact, value);
    cases.push_back({M::info.number.value, std::string{detail::field_of(field)->key},
                     std::string{vehicle::name_of(fact)}, dlisession::told<M>(state, 0, config), expected});
  }
  template <dli::Message M, class Raw, class Source, class T>
  void add_report(std::optional<Raw> M::*field, T Source::*member, const M& message, std::string expected) {
    cases.push_back({M::info.number.value, std::string{detail::field_of(field)->key},
                     std::string{name_of_source(member)}, fields_of(message), expected});
  }

  std::vector<Case> cases;
};

constexpr double infinite = std::numeric_limits<double>::infinity();
Radians degrees(double value) { return Radians{value * pi / 180}; }

void add_inertial(Cases& all) {
  using I = messages::InertialStates;
  using S = vehicle::State;
  all.add(&I::latitude, &S::latitude, degrees(38.7223), number(461975034));
  all.add(&I::longitude, &S::longitude, degrees(-9.1393), number(-109036096));
  all.add(&I::longitude, &S::longitude, degrees(180), number(-2147483648));
  all.add(&I::altitude, &S::altitude_msl, Metres{120.5}, number(0x1789));
  all.add(&I::altitude, &S::altitude_msl, Metres{-1.0}, number(-50));
  all.add(&I::altitude, &S::altitude_msl, Metres{200'000}, absent);
  all.add(&I::altitude_type, &S::altitude_msl, Metres{0}, number(3));
  all.add(&I::u_speed, &S::north_speed, MetresPerSecond{12.3}, number(0xF6));
  all.add(&I::v_speed, &S::east_speed, MetresPerSecond{-4.5}, number(-90));
  all.add(&I::w_speed, &S::down_speed, MetresPerSecond{-1}, number(-20));
  all.add(&I::u_speed, &S::north_speed, MetresPerSecond{1700}, absent);
  all.add(&I::u_accel, &S::north_acceleration, MetresPerSecondSquared{1}, number(200));
  all.add(&I::v_accel, &S::east_acceleration, MetresPerSecondSquared{-0.5}, number(-100));
  all.add(&I::w_accel, &S::down_acceleration, MetresPerSecondSquared{9.80665}, number(1961));
  all.add(&I::roll, &S::roll, degrees(10), number(0x071C));
  all.add(&I::pitch, &S::pitch, degrees(-5), number(-910));
  all.add(&I::heading, &S::heading, degrees(90), number(0x4000));
  all.add(&I::heading, &S::heading, degrees(180), number(-32768));
  all.add(&I::heading, &S::heading, degrees(270), number(-16384));
  all.add(&I::roll, &S::roll, Radians{std::numeric_limits<double>::quiet_NaN()}, absent);
  all.add(&I::roll_rate, &S::roll_rate, RadiansPerSecond{0.1}, number(20));
  all.add(&I::pitch_rate, &S::pitch_rate, RadiansPerSecond{-0.05}, number(-10));
  all.add(&I::turn_rate, &S::turn_rate, RadiansPerSecond{0.02}, number(4));
  all.add(&I::turn_rate, &S::turn_rate, RadiansPerSecond{infinite}, absent);
}

void add_air(Cases& all) {
  using A = messages::AirAndGroundRelativeStates;
  using S = vehicle::State;
  all.add(&A::angle_of_attack, &S::angle_of_attack, degrees(10), number(0x071C));
  all.add(&A::angle_of_sideslip, &S::sideslip, degrees(-5), number(-910));
  all.add(&A::true_airspeed, &S::true_airspeed, MetresPerSecond{23.2}, number(464));
  all.add(&A::indicated_airspeed, &S::indicated_airspeed, MetresPerSecond{20}, number(400));
  all.add(&A::indicated_airspeed, &S::indicated_airspeed, MetresPerSecond{-1}, absent);
  all.add(&A::outside_air_temp, &S::air_temperature, Kelvins{293.15}, number(586));
  all.add(&A::u_wind, &S::north_wind, MetresPerSecond{5}, number(100));
  all.add(&A::v_wind, &S::east_wind, MetresPerSecond{-2.5}, number(-50));
  all.add(&A::barometric_altitude, &S::barometric_altitude, Metres{320.5}, number(16025));
  all.add(&A::barometric_altitude_rate, &S::climb_rate, MetresPerSecond{-1.5}, number(-30));
  all.add(&A::pressure_altitude, &S::pressure_altitude, Metres{1000}, number(50000));
  all.add(&A::agl_altitude, &S::height_above_ground, Metres{12.34}, number(617));
  all.add(&A::wgs_84_altitude, &S::altitude_ellipsoid, Metres{103.26}, number(5163));
  all.add(&A::u_ground, &S::north_speed, MetresPerSecond{12.3}, number(246));
  all.add(&A::v_ground, &S::east_speed, MetresPerSecond{-4.5}, number(-90));
}

void add_body(Cases& all) {
  using B = messages::BodyRelativeSensedStates;
  using S = vehicle::State;
  all.add(&B::x_body_accel, &S::body_x_acceleration, MetresPerSecondSquared{1}, number(200));
  all.add(&B::y_body_accel, &S::body_y_acceleration, MetresPerSecondSquared{-2}, number(-400));
  all.add(&B::z_body_accel, &S::body_z_acceleration, MetresPerSecondSquared{-9.80665}, number(-1961));
  all.add(&B::roll_rate, &S::body_roll_rate, RadiansPerSecond{0.1}, number(1000));
  all.add(&B::pitch_rate, &S::body_pitch_rate, RadiansPerSecond{-0.2}, number(-2000));
  all.add(&B::yaw_rate, &S::body_yaw_rate, RadiansPerSecond{3.2767}, number(32767));
  all.add(&B::yaw_rate, &S::body_yaw_rate, RadiansPerSecond{3.3}, absent);
}

void add_mode(Cases& all) {
  const auto field = &messages::VehicleOperatingModeReport::select_flight_path_control_mode;
  const auto add = [&](Mode mode, std::int64_t expected) {
    all.add(field, &vehicle::State::mode, mode, number(expected));
  };
  add({ModeKind::none, 0, {}}, 0);
  add({ModeKind::manual, 0, {}}, 2);
  add({ModeKind::mission, 0, {}}, 11);
  add({ModeKind::hold, 0, {}}, 12);
  add({ModeKind::guided, 0, {}}, 15);
  add({ModeKind::land, 0, {}}, 19);
  add({ModeKind::take_off, 0, {}}, 21);
  add({ModeKind::return_home, 0, {}}, 32);
  add({ModeKind::smart_return, 0, {}}, 33);
  add({ModeKind::vtol_return, 0, {}}, 34);
  add({ModeKind::other, 0, {}}, 64);
  add({ModeKind::other, 28, {}}, 92);
  add({ModeKind::other, 127, {}}, 191);
}

void add_operating(Cases& all) {
  using O = messages::VehicleOperatingStates;
  using S = vehicle::State;
  all.add(&O::commanded_altitude, &S::commanded_altitude_msl, Metres{120.5}, number(0x1789));
  all.add(&O::altitude_type, &S::commanded_altitude_msl, Metres{120.5}, number(3));
  all.add(&O::commanded_altitude, &S::commanded_height_above_ground, Metres{40}, number(2000));
  all.add(&O::altitude_type, &S::commanded_height_above_ground, Metres{40}, number(2));
  all.add(&O::commanded_heading, &S::commanded_heading, degrees(-90), number(-16384));
  all.add(&O::commanded_course, &S::commanded_course, degrees(10), number(0x071C));
  all.add(&O::commanded_roll, &S::commanded_roll, degrees(-5), number(-910));
  all.add(&O::power_level, &S::power_level, Percent{55}, number(55));
  all.add(&O::power_level, &S::power_level, Percent{200}, absent);
  all.add(&O::current_propulsion_energy_level, &S::energy_level, Percent{50}, number(31250));
  all.add(&O::current_propulsion_energy_level, &S::energy_level, Percent{100}, number(62500));
  all.add(&O::current_propulsion_energy_level, &S::energy_level, Percent{0}, number(0));
  all.add(&O::current_propulsion_energy_level, &S::energy_level, Percent{110}, absent);
  const auto add_phase = [&](Phase phase, std::int64_t expected) {
    all.add(&O::av_state, &S::phase, phase, number(expected));
  };
  add_phase(Phase::unknown, 0);
  add_phase(Phase::power_up, 1);
  add_phase(Phase::pre_start, 2);
  add_phase(Phase::pre_launch, 3);
  add_phase(Phase::taking_off, 10);
  add_phase(Phase::in_flight, 11);
  add_phase(Phase::landing, 12);
  add_phase(Phase::critical, 13);
}

void add_leg(Cases& all) {
  using N = messages::FromToNextWaypointStates;
  const Waypoint lisbon{.number = 4,
                        .latitude = degrees(38.7223),
                        .longitude = degrees(-9.1393),
                        .altitude_msl = Metres{120.5},
                        .reached = now - seconds{3}};
  const auto add = [&](auto field, const Leg& leg, std::string expected) {
    all.add(field, &vehicle::State::leg, leg, expected);
  };
  const Leg from{.from = lisbon}, to{.to = lisbon}, next{.next = lisbon};
  const Leg nowhere{.from = Waypoint{.number = 1}, .to = Waypoint{.number = 2}, .next = Waypoint{.number = 3}};
  add(&N::from_waypoint_latitude, from, number(461975034));
  add(&N::from_waypoint_longitude, from, number(-109036096));
  add(&N::from_waypoint_altitude, from, number(0x1789));
  add(&N::from_waypoint_time, from, number(now_stamp - 3000));
  add(&N::from_waypoint_number, from, number(4));
  add(&N::to_waypoint_latitude, to, number(461975034));
  add(&N::to_waypoint_longitude, to, number(-109036096));
  add(&N::to_waypoint_altitude, to, number(0x1789));
  add(&N::to_waypoint_number, to, number(4));
  add(&N::next_waypoint_latitude, next, number(461975034));
  add(&N::next_waypoint_longitude, next, number(-109036096));
  add(&N::next_waypoint_altitude, next, number(0x1789));
  add(&N::next_waypoint_number, next, number(4));
  for (const auto& leg : {from, to, next}) add(&N::altitude_type, leg, number(3));
  // Of a waypoint without a place, or of none, nothing is told but its number.
  for (const auto field : {&N::from_waypoint_latitude, &N::from_waypoint_longitude, &N::from_waypoint_altitude,
                           &N::to_waypoint_latitude, &N::to_waypoint_longitude, &N::to_waypoint_altitude,
                           &N::next_waypoint_latitude, &N::next_waypoint_longitude, &N::next_waypoint_altitude}) {
    add(field, nowhere, absent);
    add(field, Leg{}, absent);
  }
  add(&N::from_waypoint_time, nowhere, absent);
  add(&N::altitude_type, nowhere, absent);
  for (const auto field : {&N::from_waypoint_number, &N::to_waypoint_number, &N::next_waypoint_number})
    add(field, Leg{}, absent);
  all.add(&N::to_waypoint_time, &vehicle::State::arrival, now + seconds{60}, number(now_stamp + 60'000));
}

void add_identity(Cases& all) {
  using V = messages::VehicleId;
  const vehicle::Identity quadrotor{3, 2, "00112233"sv};
  const auto add = [&](auto field, std::string expected, const VehicleDescription& config = description(),
                       const vehicle::Identity& identity = {}) {
    all.add(field, &vehicle::State::identity, identity, expected, config);
  };
  auto configured = description();
  configured.vehicle_subtype = 99;
  configured.tail_number = "CS-ABC"sv;
  configured.call_sign = "PONTE 1"sv;
  add(&V::vsm_id, number(0x14600001));
  add(&V::vehicle_id_update, number(0x14400007));
  add(&V::vehicle_type, number(3));
  add(&V::vehicle_subtype, number(2), description(), quadrotor);
  add(&V::vehicle_subtype, number(99), configured, quadrotor);
  add(&V::owning_id, number(20));
  add(&V::tail_number, std::string{"00112233"}, description(), quadrotor);
  add(&V::tail_number, std::string{"CS-ABC"}, configured, quadrotor);
  add(&V::tail_number, absent);
  add(&V::atc_call_sign, std::string{"PONTE 1"}, configured);
  add(&V::atc_call_sign, absent);
  all.add(&V::mission_id, &vehicle::State::mission_id, Text<19>{"000012ab"}, std::string{"000012ab"});
}

void add_reports(Cases& all) {
  const dli::Profile profile;
  const auto config = description();
  const MappingContext context{profile, config};
  const auto alert = [&](Condition severity, Subsystem subsystem = Subsystem::comms) {
    return alert_message({severity, subsystem, "vehicle heartbeat lost"sv, -77}, now, context);
  };
  using L = messages::SubsystemStatusAlert;
  struct Severity {
    Condition severity;
    std::int64_t priority;
    std::int64_t type;
    std::string persistence;
  };
  const Severity severities[]{
      {Condition::no_status, 0, 0, number(0)}, {Condition::nominal, 1, 3, number(10)},
      {Condition::caution, 2, 3, number(10)},  {Condition::warning, 3, 2, absent},
      {Condition::emergency, 4, 2, absent},    {Condition::failed, 5, 2, absent},
  };
  for (const auto& each : severities) {
    all.add_report(&L::priority, &AlertReport::severity, alert(each.severity), number(each.priority));
    all.add_report(&L::type, &AlertReport::severity, alert(each.severity), number(each.type));
    all.add_report(&L::persistence, &AlertReport::severity, alert(each.severity), each.persistence);
  }
  using R = messages::SubsystemStatusReport;
  const std::pair<Subsystem, std::int64_t> subsystems[]{
      {Subsystem::engine, 0},  {Subsystem::mechanical, 1},        {Subsystem::electrical, 2},
      {Subsystem::comms, 3},   {Subsystem::propulsion_energy, 4}, {Subsystem::navigation, 5},
      {Subsystem::payload, 6}, {Subsystem::recovery, 7},          {Subsystem::environmental, 8},
      {Subsystem::vsm, 9}};
  for (const auto& [subsystem, expected] : subsystems) {
    all.add_report(&L::subsystem_id, &AlertReport::subsystem, alert(Condition::warning, subsystem), number(expected));
    all.add_report(&R::subsystem_id, &SubsystemReport::subsystem,
                   subsystem_message({subsystem, Condition::nominal}, now, context), number(expected));
  }
  all.add_report(&L::subsystem_state_report_reference, &AlertReport::subsystem, alert(Condition::warning), number(-1));
  all.add_report(&L::alert_id, &AlertReport::id, alert(Condition::warning), number(-77));
  all.add_report(&L::text, &AlertReport::text, alert(Condition::warning), std::string{"vehicle heartbeat lost"});
  for (std::int64_t state = 0; state <= 5; ++state) {
    const auto message = subsystem_message({Subsystem::engine, static_cast<Condition>(state)}, now, context);
    all.add_report(&R::subsystem_state, &SubsystemReport::condition, message, number(state));
    all.add_report(&R::subsystem_state_report_reference, &SubsystemReport::subsystem, message, number(-1));
  }
}

const std::vector<Case>& all_cases() {
  static const auto cases = [] {
    Cases all;
    add_inertial(all);
    add_air(all);
    add_body(all);
    add_mode(all);
    add_operating(all);
    add_leg(all);
    add_identity(all);
    add_reports(all);
    return all.cases;
  }();
  return cases;
}

TEST(StatusRows, MakeOfEveryFactWhatTheMappingSays) {
  for (const auto& each : all_cases()) {
    SCOPED_TRACE('#' + std::to_string(each.message) + ' ' + each.field + " from " + each.source);
    const auto found = each.told.find(each.field);
    EXPECT_EQ(found == each.told.end() ? absent : found->second, each.expected);
  }
}

TEST(StatusRows, HaveACaseEach) {
  EXPECT_GE(status_row_texts().size(), 80U);
  for (const auto& row : status_row_texts()) {
    const auto is_of_row = [&](const Case& each) {
      return each.message == row.message->number.value && each.field == row.field->key &&
             each.source == row.sources[0] && each.expected != absent;
    };
    EXPECT_TRUE(std::ranges::any_of(all_cases(), is_of_row))
        << "no test says what #" << row.message->number.value << ' ' << row.field->name << " is made of "
        << row.sources[0];
  }
}

TEST(StatusRows, KeepTheUnitOfTheFactUnlessTheirRuleConverts) {
  for (const auto& row : status_row_texts()) {
    SCOPED_TRACE('#' + std::to_string(row.message->number.value) + ' ' + std::string{row.field->name});
    EXPECT_FALSE(row.sources[0].empty());
    EXPECT_FALSE(row.rule.empty());
    EXPECT_TRUE(row.reference.starts_with("mapping "));
    if (row.rule != rules::as_is.text) continue;
    const bool is_time = row.sources[0] == "arrival";  // a point in time, in seconds on the wire
    EXPECT_EQ(row.field->unit, is_time ? "s" : row.units[0]);
  }
}

// "Knows the scale" is what makes a quantity encodable: without one the row would never say anything.
TEST(StatusRows, HaveAScaleForEveryQuantity) {
  const dli::Profile profile;
  for (const auto& row : status_row_texts())
    if (!row.units[0].empty() && !row.field->unit.empty()) {
      EXPECT_NE(profile.scale_of(*row.message, *row.field), 0) << row.field->name;
    }
}

template <dli::Message... Ms>
struct MessageList {
  template <class Visitor>
  static void each(Visitor&& visitor) {
    (visitor.template operator()<Ms>(), ...);
  }
};
using StateMessages =
    MessageList<messages::InertialStates, messages::AirAndGroundRelativeStates, messages::BodyRelativeSensedStates,
                messages::VehicleOperatingModeReport, messages::VehicleOperatingStates,
                messages::FromToNextWaypointStates, messages::VehicleId>;

TEST(StatusMessages, AreNotSentWhenNothingIsKnown) {
  StateMessages::each([]<class M>() { EXPECT_TRUE(told<M>({}).empty()) << M::info.name; });
}

/// A state in which everything is known and as zero as it can be.
vehicle::State known_zeros() {
  vehicle::State state;
  vehicle::visit_facts([&]<class T>(vehicle::FactOf<T> fact, auto...) { learn(state, fact, T{}); });
  learn(state, &vehicle::State::arrival, now);
  learn(state, &vehicle::State::leg, Leg{.from = Waypoint{}, .to = Waypoint{}, .next = Waypoint{}});
  return state;
}

TEST(StatusMessages, LeaveOutWhatIsNotKnownAndTellAZeroThatIs) {
  vehicle::visit_facts([&]<class T>(vehicle::FactOf<T> fact, std::string_view name, auto...) {
    auto state = known_zeros();
    (state.*fact).forget();
    std::map<std::uint16_t, std::pair<Fields, Fields>> with_and_without;
    StateMessages::each([&]<class M>() {
      with_and_without[M::info.number.value] = {told<M>(known_zeros()), told<M>(state)};
    });
    for (const auto& row : status_row_texts()) {
      if (row.sources[0] != name || row.units[0].empty()) continue;
      SCOPED_TRACE('#' + std::to_string(row.message->number.value) + ' ' + std::string{row.field->key});
      const auto& [with, without] = with_and_without[row.message->number.value];
      EXPECT_TRUE(with.contains(std::string{row.field->key})) << "0 is a value";
      const bool has_another_source = row.field->key == "commanded_altitude" || row.field->key == "altitude_type";
      if (!has_another_source) {
        EXPECT_FALSE(without.contains(std::string{row.field->key})) << "unknown " << name;
      }
    }
  });
}

TEST(StatusMessages, TellOnlyWhatWasLearntSince) {
  vehicle::State state;
  learn(state, &vehicle::State::latitude, degrees(1));
  learn(state, &vehicle::State::roll, degrees(1));
  const auto before = state.revision;
  learn(state, &vehicle::State::roll, degrees(1));
  using I = messages::InertialStates;
  EXPECT_EQ(told<I>(state, 0).size(), 3U) << "latitude, roll, time stamp";
  const auto news = told<I>(state, before);
  EXPECT_TRUE(news.contains("roll"));
  EXPECT_FALSE(news.contains("latitude"));
  EXPECT_TRUE(told<I>(state, state.revision).empty());
}

TEST(StatusMessages, AreStampedWithTheTimeOfTheirNewestFact) {
  vehicle::State state;
  learn(state, &vehicle::State::latitude, degrees(1), now);
  learn(state, &vehicle::State::roll, degrees(1), now - milliseconds{500});
  using I = messages::InertialStates;
  EXPECT_EQ(told<I>(state)["time_stamp"], number(now_stamp));
  const auto before = state.revision;
  learn(state, &vehicle::State::roll, degrees(2), now - milliseconds{400});
  EXPECT_EQ(told<I>(state, before)["time_stamp"], number(now_stamp - 400));
}

TEST(StatusMessages, HaveNoStampFromBefore2000) {
  vehicle::State state;
  learn(state, &vehicle::State::roll, degrees(1), WallTime{});
  const auto fields = told<messages::InertialStates>(state);
  EXPECT_TRUE(fields.contains("roll"));
  EXPECT_FALSE(fields.contains("time_stamp"));
}

TEST(StatusMessages, TellTheAltitudeAboveTheSeaWhereBothAreKnown) {
  vehicle::State state;
  learn(state, &vehicle::State::commanded_height_above_ground, Metres{40});
  learn(state, &vehicle::State::commanded_altitude_msl, Metres{120.5});
  auto fields = told<messages::VehicleOperatingStates>(state);
  EXPECT_EQ(fields["commanded_altitude"], number(0x1789));
  EXPECT_EQ(fields["altitude_type"], number(3));
}

// Each field has its own scale in the profile, fields of one type and unit too.
TEST(StatusMessages, UseTheScaleOfTheProfileForTheFieldThatItNames) {
  dli::Profile profile;
  constexpr std::uint8_t v_speed_field = 7;
  profile.override_scale(messages::InertialStates::info.number, v_speed_field, 0.5);
  vehicle::State state;
  learn(state, &vehicle::State::north_speed, MetresPerSecond{10});
  learn(state, &vehicle::State::east_speed, MetresPerSecond{10});
  learn(state, &vehicle::State::down_speed, MetresPerSecond{10});
  auto fields = told<messages::InertialStates>(state, 0, description(), profile);
  EXPECT_EQ(fields["u_speed"], number(200));
  EXPECT_EQ(fields["v_speed"], number(20));
  EXPECT_EQ(fields["w_speed"], number(200));
}

TEST(StatusMessages, HeartbeatHasItsTime) {
  EXPECT_EQ(heartbeat_message(now).time_stamp, now_stamp);
  EXPECT_EQ(heartbeat_message(WallTime{}).time_stamp, std::nullopt);
}

TEST(StatusMessages, ReportsAreStampedWithTheirOwnTime) {
  const dli::Profile profile;
  const auto config = description();
  EXPECT_EQ(alert_message({}, now, {profile, config}).time_stamp, now_stamp);
  EXPECT_EQ(subsystem_message({}, now - seconds{1}, {profile, config}).time_stamp, now_stamp - 1000);
}

}  // namespace
}  // namespace ponte::dlisession
