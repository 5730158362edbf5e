// A hostile autopilot against the clients that transfer plans, parameters and files. The first byte chooses what the
// autopilot is taken for; then comes, again and again, a byte that chooses a request, which is made if none is running,
// or lets time go by; or a message of the protocols, with the size of its payload and the payload. Messages are mostly
// for us, or few would get past the first look. Every request has to end, once, in bounded time.

#include "ponte/autopilot/file_client.hpp"
#include "ponte/autopilot/mission_client.hpp"
#include "ponte/autopilot/parameter_client.hpp"
#include "ponte/core/assert.hpp"
#include "ponte/mavlink/autopilots/file_transfer_protocol.hpp"
#include "ponte/mavlink/autopilots/mission_ack.hpp"
#include "ponte/mavlink/autopilots/mission_count.hpp"
#include "ponte/mavlink/autopilots/mission_request.hpp"
#include "ponte/mavlink/autopilots/mission_request_int.hpp"
#include "ponte/mavlink/codec.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

namespace {

using namespace ponte;
using namespace ponte::autopilot;
namespace messages = mavlink::autopilots;

constexpr mavlink::SystemId us{255};
constexpr mavlink::ComponentId station{190};
constexpr mavlink::SystemId vehicle{1};
constexpr mavlink::ComponentId autopilot_component{1};

/// Requests of one client: how many were made, and how many have ended.
struct Count {
  std::uint64_t made{};
  std::uint64_t ended{};
};

class Station {
 public:
  explicit Station(Stack stack)
      : missions_{Peer{vehicle, autopilot_component, stack}},
        parameters_{Peer{vehicle, autopilot_component, stack}},
        files_{Peer{vehicle, autopilot_component, stack}} {}

  void request(unsigned choice) {
    const auto type = static_cast<PlanType>(choice % plan_types);
    std::vector<WireItem> items(1 + choice % 5, WireItem{.command = 16, .x = static_cast<std::int32_t>(choice)});
    switch (choice % 12) {
      case 0: return begun(plans, missions_.upload(now_, type, items, voice_));
      case 1: return begun(plans, missions_.download(now_, type, voice_));
      case 2: return begun(plans, missions_.clear(now_, type, voice_));
      case 3: return begun(plans, missions_.set_current(now_, 1, voice_));
      case 4: return begun(plans, missions_.confirm(now_, type, items, voice_));
      case 5: return begun(values, parameters_.fetch_all(now_, voice_));
      case 6: return begun(values, parameters_.get(now_, "A", voice_));
      case 7: return begun(values, parameters_.set(now_, "A", 1, voice_));
      case 8: return begun(files, files_.read(now_, "a", voice_));
      case 9: return begun(files, files_.write(now_, "a", std::vector<std::byte>(300), voice_));
      case 10: return begun(files, files_.list(now_, "a", voice_));
      default:
        missions_.on_reboot(now_);
        parameters_.on_reboot();
        files_.on_reboot(now_);
    }
  }

  void hear(const mavlink::FrameView& frame) {
    missions_.on_message(now_, frame, voice_, mission_facts_);
    parameters_.on_message(now_, frame, voice_, parameter_facts_);
    files_.on_message(now_, frame, voice_, file_facts_);
    take();
  }

  /// False if nothing is to be done until then.
  bool tick(Timestamp until) {
    auto next = Timestamp::max();
    for (const auto& each : {missions_.next_deadline(), parameters_.next_deadline(), files_.next_deadline()})
      next = std::min(next, each.value_or(Timestamp::max()));
    if (next > until) return false;
    now_ = std::max(now_, next);
    missions_.on_tick(now_, voice_, mission_facts_);
    parameters_.on_tick(now_, voice_, parameter_facts_);
    files_.on_tick(now_, voice_, file_facts_);
    take();
    return true;
  }
  void wait(Duration duration) {
    const auto end = now_ + duration;
    while (tick(end)) {
    }
    now_ = end;
  }

  /// Nobody answers any more: all has to end.
  void finish() {
    constexpr int most_ticks = 1'000'000;
    int ticks = 0;
    while (tick(Timestamp::max() - std::chrono::hours{1})) PONTE_ASSERT(++ticks < most_ticks);
    for (const auto& each : {plans, values, files}) PONTE_ASSERT(each.made == each.ended);
  }

 private:
  template <class Id, class Refusal>
  void begun(Count& count, const Result<Id, Refusal>& started) {
    if (started) ++count.made;
    take();
  }
  template <class Fact>
  void take(Outbox<Fact>& facts, Count& count) {
    PONTE_ASSERT(facts.overwritten() == 0);
    facts.drain([&](const Fact& fact) {
      if (fact.kind != Fact::Kind::progress) ++count.ended;
    });
    PONTE_ASSERT(count.ended <= count.made);
  }
  void take() {
    PONTE_ASSERT(out_.overwritten() == 0);
    out_.drain([](const OutgoingFrame& frame) { PONTE_ASSERT(mavlink::parse_frame(frame.bytes()).has_value()); });
    take(mission_facts_, plans);
    take(parameter_facts_, values);
    take(file_facts_, files);
  }

  Timestamp now_{};
  mavlink::FrameSender sender_{mavlink::Version::v2, us, station};
  Outbox<OutgoingFrame> out_{64};
  Voice voice_{sender_, LinkId{}, out_};
  Outbox<MissionFact> mission_facts_{16};
  Outbox<ParameterFact> parameter_facts_{16};
  Outbox<FileFact> file_facts_{16};
  MissionClient missions_;
  ParameterClient parameters_;
  FileClient files_;
  Count plans, values, files;
};

/// Hands on the message that is in the payload, made one for us.
template <mavlink::Message M>
void say(Bytes payload, Station& to) {
  auto message = mavlink::decode<M>(payload);
  if constexpr (requires { message.target_system; }) {
    message.target_system = us.value;
    message.target_component = station.value;
  }
  std::array<std::byte, mavlink::max_frame_size> buffer{};
  const auto size = mavlink::encode(
      message, {.version = mavlink::Version::v2, .system = vehicle, .component = autopilot_component}, buffer);
  PONTE_ASSERT(size.has_value());
  to.hear(*mavlink::parse_frame(Bytes{buffer}.first(*size)));
}

void say(unsigned choice, Bytes payload, Station& to) {
  switch (choice % 9) {
    case 0: return say<messages::MissionRequest>(payload, to);
    case 1: return say<messages::MissionRequestInt>(payload, to);
    case 2: return say<messages::MissionAck>(payload, to);
    case 3: return say<messages::MissionCount>(payload, to);
    case 4: return say<messages::MissionItemInt>(payload, to);
    case 5: return say<messages::MissionCurrent>(payload, to);
    case 6: return say<messages::ParamValue>(payload, to);
    case 7: return say<messages::ParamError>(payload, to);
    default: return say<messages::FileTransferProtocol>(payload, to);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes input = std::as_bytes(std::span{data, size});
  if (input.empty()) return 0;
  constexpr std::array stacks{Stack::ardupilot_copter, Stack::ardupilot_plane, Stack::px4, Stack::unknown};
  Station subject{stacks[u8(input, 0) % stacks.size()]};
  input = input.subspan(1);
  while (input.size() >= 2) {
    const unsigned kind = u8(input, 0);
    const unsigned value = u8(input, 1);
    input = input.subspan(2);
    if (kind < 64) {
      subject.request(value);
    } else if (kind < 96) {
      subject.wait(std::chrono::milliseconds{10 * value});
    } else {
      const auto payload = input.first(std::min<std::size_t>(value, input.size()));
      input = input.subspan(payload.size());
      say(kind, payload, subject);
    }
  }
  subject.finish();
  return 0;
}
