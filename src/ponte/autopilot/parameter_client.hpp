#pragma once

#include "ponte/autopilot/parameter.hpp"
#include "ponte/autopilot/patience.hpp"
#include "ponte/autopilot/peer.hpp"
#include "ponte/autopilot/voice.hpp"
#include "ponte/core/id.hpp"
#include "ponte/core/outbox.hpp"
#include "ponte/core/result.hpp"
#include "ponte/mavlink/autopilots/param_error.hpp"
#include "ponte/mavlink/autopilots/param_value.hpp"
#include "ponte/mavlink/frame.hpp"

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace ponte::autopilot {

struct ParameterTimes {
  /// ArduPilot answers a single request after 10 to 190 ms (recordings).
  Patience::Limits patience{.first = std::chrono::seconds{1}, .least = std::chrono::milliseconds{300}};
  /// Of silence, after which a list is not coming any more, or what is left of it.
  Duration list_pause{std::chrono::seconds{1}};
  /// Of silence, after which all is given up; a name that ArduPilot does not know is never answered.
  Duration silence_limit{std::chrono::seconds{10}};
  /// For each parameter that is fetched, beyond the limit above: by then it has to be over.
  Duration per_parameter{std::chrono::milliseconds{200}};
};

using ParameterRequestId = Id<struct ParameterRequestTag, std::uint32_t>;

/// Why a request cannot even be started.
enum class ParameterRefusal : std::uint8_t {
  busy,               ///< with another request
  bad_name,           ///< empty, or longer than 16 characters
  bad_value,          ///< not of the parameter's type, or not finite
  not_in_mavlink_09,  ///< which is spoken on this link
};

/// Why a request has failed.
enum class ParameterFailure : std::uint8_t {
  none,
  silent,     ///< nothing was answered; or ArduPilot does not know the name
  refused,    ///< `error` says why
  differs,    ///< the vehicle keeps another value, which is in `parameter`
  bad_value,  ///< once its type was known: it has no such value
};

/// What has become of a request. Each ends in exactly one fact that is no `progress`.
struct ParameterFact {
  enum class Kind : std::uint8_t { progress, fetched, got, set, failed } kind{};
  ParameterRequestId request{};
  std::uint16_t done{};   ///< of `progress`: parameters that are known
  std::uint16_t total{};  ///< of `progress` and `fetched`
  bool was_known{};       ///< of `fetched`: the vehicle's hash says that nothing has changed
  Parameter parameter{};  ///< of a request for one
  ParameterFailure failure{};
  std::uint8_t error{};  ///< of `refused`: MAV_PARAM_ERROR
  friend bool operator==(const ParameterFact&, const ParameterFact&) = default;
};

/// Reads and writes the parameters of one autopilot, one request at a time, and keeps what it hears of them.
class ParameterClient {
 public:
  explicit ParameterClient(const Peer& peer, const ParameterTimes& times = {});

  /// All of them: the list, then what is missing of it by index, several at a time. A PX4 whose hash is still the one
  /// that it told with the last list is not asked for it again.
  Result<ParameterRequestId, ParameterRefusal> fetch_all(Timestamp now, Voice& voice);
  Result<ParameterRequestId, ParameterRefusal> get(Timestamp now, std::string_view name, Voice& voice);
  /// Is done when the vehicle says that it has this value. The type is asked for first where it is not known.
  Result<ParameterRequestId, ParameterRefusal> set(Timestamp now, std::string_view name, double value, Voice& voice);
  /// What was read in another way, e.g. from `@PARAM/param.pck`: all that there is.
  void take_over(std::vector<Parameter> all);

  /// A frame of the vehicle's system, with the right checksum.
  void on_message(Timestamp now, const mavlink::FrameView& frame, Voice& voice, Outbox<ParameterFact>& facts);
  void on_tick(Timestamp now, Voice& voice, Outbox<ParameterFact>& facts);
  /// The vehicle has started anew: it may have other parameters. A request goes on.
  void on_reboot();
  [[nodiscard]] std::optional<Timestamp> next_deadline() const;

  [[nodiscard]] bool is_busy() const { return step_ != Step::idle; }
  /// All parameters have been fetched since the vehicle started.
  [[nodiscard]] bool is_complete() const { return is_complete_; }
  /// Those that are known, in the order of the vehicle's list as far as this is known.
  [[nodiscard]] std::vector<Parameter> known() const;
  [[nodiscard]] const Parameter* find(std::string_view name) const;

 private:
  enum class Step : std::uint8_t { idle, comparing, listing, filling, reading, setting };

  /// One place in the vehicle's list, or what was heard of without one.
  struct Entry {
    bool is_known{};
    Parameter parameter{};
  };
  struct Wanted {
    std::uint16_t index{};
    Timestamp asked{};
    bool is_repeated{};
  };
  static constexpr std::size_t window = 10;  ///< ArduPilot keeps up to 20 requests
  static constexpr std::string_view hash_name = "_HASH_CHECK";

  [[nodiscard]] std::optional<ParameterRefusal> reason_not_to(const Voice& voice) const;
  ParameterRequestId begin(Timestamp now);
  void list(Timestamp now, Voice& voice);
  void read(std::string_view name, std::int16_t index, Voice& voice) const;
  void ask(Timestamp now, Voice& voice);
  void write(Voice& voice) const;
  void fill(Timestamp now, Voice& voice);

  // parameter_client_messages.cpp
  void on_value(Timestamp now, const mavlink::autopilots::ParamValue& value, Voice& voice,
                Outbox<ParameterFact>& facts);
  void on_hash(Timestamp now, std::uint32_t hash, Voice& voice, Outbox<ParameterFact>& facts);
  void on_listed(Timestamp now, std::uint16_t index, Voice& voice, Outbox<ParameterFact>& facts);
  void on_wanted(Timestamp now, const Parameter& parameter, Voice& voice, Outbox<ParameterFact>& facts);
  void on_error(const mavlink::autopilots::ParamError& error, const Voice& voice, Outbox<ParameterFact>& facts);
  void keep(const Parameter& parameter, std::uint16_t index, std::uint16_t count);
  void tell(ParameterFact fact, Outbox<ParameterFact>& facts);

  Peer peer_;
  ParameterTimes times_;
  Patience patience_;
  std::vector<Entry> entries_;  ///< by index
  std::vector<Entry> others_;   ///< without an index
  std::vector<Wanted> wanted_;  ///< of the list, asked for by index
  std::size_t known_{};         ///< of `entries_`
  std::size_t next_{};          ///< where to look for what is missing
  bool is_complete_{};
  std::optional<std::uint32_t> hash_;      ///< of the list that is complete
  std::optional<std::uint32_t> new_hash_;  ///< of the one that is being fetched
  Step step_{Step::idle};
  ParameterRequestId request_{};
  Parameter target_{};
  bool is_set_{};       ///< the request for one is to set it
  bool is_repeated_{};  ///< what was asked last
  int answers_{};       ///< that said another value than the one that is being set
  Timestamp began_{};
  Timestamp asked_{};
  Timestamp heard_{};
  Timestamp next_try_{};
  Timestamp end_{};
};

}  // namespace ponte::autopilot
