// Ponte's MAVLink over the corpus, as bench/mavlink/peer.c does it with the C headers.
//
// usage: bench_mavlink FOLDER

#include "common/load_file.hpp"
#include "ponte/core/json_text.hpp"
#include "ponte/mavlink/autopilots/all.hpp"
#include "ponte/mavlink/autopilots/dialect.hpp"
#include "ponte/mavlink/codec.hpp"
#include "ponte/mavlink/crc.hpp"
#include "ponte/mavlink/parser.hpp"
#include "ponte/mavlink/signer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <ctime>
#include <new>
#include <string>
#include <tuple>
#include <vector>

namespace {

std::uint64_t allocations = 0;

}  // namespace

void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc{};
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace {

using namespace ponte;
using namespace ponte::mavlink::autopilots;
using mavlink::FrameView;
using mavlink::MessageInfo;

constexpr int repetitions = 5;
constexpr std::size_t samples_of_a_type = 512;
constexpr int encode_rounds = 200;

/// Makes the compiler believe that the value is used.
template <class T>
void keep(T& value) {
  __asm__ volatile("" : : "r"(&value) : "memory");
}

/// The fields of messages, or the bytes of frames, as one number: FNV-1a.
class Hash {
 public:
  void add(const void* bytes, std::size_t size) {
    const auto* at = static_cast<const unsigned char*>(bytes);
    for (std::size_t i = 0; i < size; ++i) value_ = (value_ ^ at[i]) * 0x100000001B3;
  }
  template <mavlink::Message M>
  void add_fields(const M& message) {
    M::visit(message, [this](const mavlink::FieldInfo&, const auto& value) { add(&value, sizeof value); });
  }
  [[nodiscard]] std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_{0xCBF29CE484222325};
};

/// The messages of the corpus, in the order in which they are encoded.
template <template <class...> class Of>
using CorpusMessages =
    Of<Heartbeat, SysStatus, SystemTime, ParamValue, GpsRawInt, ScaledPressure, RawImu, Attitude, AttitudeQuaternion,
       LocalPositionNed, GlobalPositionInt, ServoOutputRaw, ScaledImu, NavControllerOutput, RcChannels,
       RequestDataStream, VfrHud, CommandLong, CommandAck, MissionItemInt, PowerStatus, HighresImu, BatteryStatus,
       Vibration, HomePosition, ExtendedSysState, Statustext>;

/// Decodes the message of a frame, whichever of these it is, and hands it on.
template <class... M>
struct Decoder {
  template <class Function>
  static void decode(const FrameView& frame, const Function& function) {
    using Step = void (*)(const FrameView&, const Function&);
    static constexpr auto steps = [] {
      std::array<Step, 512> result{};
      ((result[M::info.id.value] = [](const FrameView& each, const Function& then) { then(mavlink::decode<M>(each)); }),
       ...);
      return result;
    }();
    if (frame.message.value >= steps.size()) return;
    if (const auto step = steps[frame.message.value]) step(frame, function);
  }
};
using AnyDecoder = CorpusMessages<Decoder>;

struct CountingSink final : mavlink::FrameSink {
  void on_frame(const FrameView& frame, const MessageInfo*) override {
    keep(frame);
    ++frames;
  }
  std::uint64_t frames{};
};

struct DecodingSink final : mavlink::FrameSink {
  void on_frame(const FrameView& frame, const MessageInfo*) override {
    ++frames;
    const auto use = [](const auto& message) { keep(message); };
    AnyDecoder::decode(frame, use);
  }
  std::uint64_t frames{};
};

struct HashingSink final : mavlink::FrameSink {
  void on_frame(const FrameView& frame, const MessageInfo*) override {
    ++frames;
    const auto add = [this](const auto& message) { hash.add_fields(message); };
    AnyDecoder::decode(frame, add);
  }
  std::uint64_t frames{};
  Hash hash;
};

double seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec) * 1e-9;
}

/// The median time of a pass, in seconds.
template <class Pass>
double median_of(Pass&& pass) {
  std::array<double, repetitions> times{};
  for (auto& time : times) {
    const auto begin = seconds();
    pass();
    time = seconds() - begin;
  }
  std::ranges::sort(times);
  return times[repetitions / 2];
}

template <class Sink>
void feed(Bytes stream, std::size_t chunk, Sink& sink) {
  mavlink::Parser parser{dialect};
  for (std::size_t at = 0; at < stream.size(); at += chunk)
    parser.on_bytes(Timestamp{}, stream.subspan(at, std::min(chunk, stream.size() - at)), sink);
  parser.finish(sink);
}

void print(std::string_view name, std::uint64_t frames, std::uint64_t hash, double time) {
  JsonText json;
  json.begin_object().member("case", name).member("frames", frames);
  json.member("hash", std::string_view{fmt::format("{:016x}", hash)});
  json.member("ns", time * 1e9 / static_cast<double>(frames)).end_object();
  fmt::print("{}\n", json.text());
}

void measure_parse(const std::string& folder, std::string_view name) {
  const auto file = app::load_file(fmt::format("{}/{}.bin", folder, name));
  const Bytes stream = file.bytes;
  HashingSink check;
  feed(stream, 1500, check);
  for (const std::size_t chunk : {std::size_t{1}, std::size_t{64}, std::size_t{1500}, std::size_t{65536}}) {
    std::uint64_t frames{};
    const auto allocations_before = allocations;
    const auto time = median_of([&] {
      DecodingSink sink;
      feed(stream, chunk, sink);
      frames = sink.frames;
    });
    if (allocations != allocations_before) throw std::runtime_error{"it allocates memory for frames"};
    print(fmt::format("decode {} {}", name, chunk), frames, check.hash.value(), time);
  }
}

/// The signatures of frames that are decoded.
struct VerifyingSink final : mavlink::FrameSink {
  VerifyingSink() : signer{corpus_key(), {}} {}

  static mavlink::SigningKey corpus_key() {
    std::array<std::byte, mavlink::SigningKey::size> bytes{};
    for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::byte>(i);
    return mavlink::SigningKey{bytes};
  }

  void on_frame(const FrameView& frame, const MessageInfo*) override {
    constexpr WallTime before_all_of_them{};
    if (signer.verify(before_all_of_them, frame) != mavlink::SignatureVerdict::accepted) return;
    ++frames;
    const auto use = [](const auto& message) { keep(message); };
    AnyDecoder::decode(frame, use);
  }

  mavlink::Signer signer;
  std::uint64_t frames{};
};

void measure_verify(const std::string& folder) {
  const auto file = app::load_file(folder + "/v2_signed.bin");
  std::uint64_t frames{};
  const auto time = median_of([&] {
    VerifyingSink sink;
    feed(file.bytes, 1500, sink);
    frames = sink.frames;
  });
  print("verify v2_signed", frames, 0, time);
}

/// Finding frames alone, beside the checksum of the same frames alone.
void measure_checksum(const std::string& folder) {
  const auto file = app::load_file(folder + "/v2.bin");
  const Bytes stream = file.bytes;
  std::uint64_t frames{};
  const auto parse_time = median_of([&] {
    CountingSink sink;
    feed(stream, 1500, sink);
    frames = sink.frames;
  });
  print("parse v2 1500", frames, 0, parse_time);
  struct Collector final : mavlink::FrameSink {
    void on_frame(const FrameView& frame, const MessageInfo*) override { found.push_back(frame.whole); }
    std::vector<Bytes> found;
  } collector;
  mavlink::Parser{dialect}.on_bytes(Timestamp{}, stream, collector);
  const auto crc_time = median_of([&] {
    for (const auto frame : collector.found) {
      const auto crc = mavlink::crc_of(frame.subspan(1, frame.size() - 3));
      keep(crc);
    }
  });
  print("checksum v2", collector.found.size(), 0, crc_time);
}

/// Messages of each type, to be encoded one after the other.
template <class... M>
class Samples {
 public:
  void take(const FrameView& frame) { (take_if<M>(frame), ...); }

  template <class Function>
  void for_each(Function&& function) const {
    (std::ranges::for_each(std::get<std::vector<M>>(messages_), function), ...);
  }

 private:
  template <class T>
  void take_if(const FrameView& frame) {
    auto& messages = std::get<std::vector<T>>(messages_);
    if (frame.message == T::info.id && messages.size() < samples_of_a_type)
      messages.push_back(mavlink::decode<T>(frame));
  }

  std::tuple<std::vector<M>...> messages_;
};

void measure_encode(const std::string& folder) {
  const auto file = app::load_file(folder + "/v2.bin");
  struct Collector final : mavlink::FrameSink {
    void on_frame(const FrameView& frame, const MessageInfo*) override { samples.take(frame); }
    CorpusMessages<Samples> samples;
  } collector;
  mavlink::Parser{dialect}.on_bytes(Timestamp{}, file.bytes, collector);

  mavlink::FrameHeader header{.system = mavlink::SystemId{1}, .component = mavlink::ComponentId{1}};
  std::array<std::byte, mavlink::max_frame_size> buffer{};
  Hash hash;
  collector.samples.for_each([&](const auto& message) {
    hash.add(buffer.data(), mavlink::encode(message, header, buffer).value());
    ++header.sequence;
  });
  std::uint64_t frames{};
  const auto time = median_of([&] {
    frames = 0;
    for (int round = 0; round < encode_rounds; ++round)
      collector.samples.for_each([&](const auto& message) {
        const auto size = mavlink::encode(message, header, buffer);
        keep(buffer);
        keep(size);
        ++header.sequence;
        ++frames;
      });
  });
  print("encode", frames, hash.value(), time);
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 2) return 2;
  for (const auto* name : {"v1", "v2", "v2_signed", "v2_noisy"}) measure_parse(argv[1], name);
  measure_verify(argv[1]);
  measure_checksum(argv[1]);
  measure_encode(argv[1]);
  return 0;
} catch (const std::exception& error) {
  fmt::print(stderr, "{}\n", error.what());
  return 1;
}
