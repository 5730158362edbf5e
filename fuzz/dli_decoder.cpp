// Any datagram, in both editions: read, walked, decoded with its type, printed. What decodes must encode, and what was
// encoded must come back the same, byte for byte. The same input is also read as a capture file.

#include "ponte/core/assert.hpp"
#include "ponte/dli/codec.hpp"
#include "ponte/dli/json.hpp"
#include "ponte/dli/messages/all.hpp"
#include "ponte/dli/messages/catalogue.hpp"
#include "ponte/dli/pcap.hpp"
#include "ponte/dli/walk.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

namespace ponte::dli {
namespace {

using DataBuffer = std::array<std::byte, data_size_max>;

/// Decodes the data as message M, and holds the decoder against the walk and the encoder.
struct TypedDecoding {
  Bytes data;
  const Profile* profile;

  template <Message M>
  void operator()() const {
    DecodeFacts facts;
    const auto message = decode<M>(data, *profile, &facts);
    const auto walked = walk(M::info, data, *profile, [](const FieldInfo&, Bytes) {});
    PONTE_ASSERT(message.has_value() == walked.has_value());
    if (!message) {
      PONTE_ASSERT(message.error() == walked.error());
      return;
    }
    PONTE_ASSERT(facts == *walked);

    DataBuffer once{};
    const auto size = encode(*message, *profile, once);
    PONTE_ASSERT(size && *size <= data.size());
    const auto again = decode<M>(Bytes{once}.first(*size), *profile, &facts);
    PONTE_ASSERT(again && !facts.newer_fields);
    DataBuffer twice{};
    const auto size_again = encode(*again, *profile, twice);
    PONTE_ASSERT(size_again == size && once == twice);
  }
};

void use_message(const WrapperView& message, Bytes payload, const Profile& profile) {
  PONTE_ASSERT(message.whole.data() >= payload.data());
  PONTE_ASSERT(&message.whole.back() <= &payload.back());
  JsonText json;
  const auto printed = append_json(json, message, messages::catalogue, profile, 0);
  PONTE_ASSERT(printed.has_value() == !json.text().empty());
  messages::with_message(message.number, TypedDecoding{message.data, &profile});
}

void read_datagram(Bytes payload, const Profile& profile) {
  DatagramCounters counters;
  DatagramReader reader{payload, profile, counters};
  std::uint64_t messages = 0;
  std::uint64_t errors = 0;
  while (const auto item = reader.next()) {
    if (*item) {
      ++messages;
      use_message(**item, payload, profile);
    } else {
      ++errors;
      PONTE_ASSERT(item->error().offset <= payload.size());
    }
  }
  PONTE_ASSERT(messages == counters.messages && messages + errors > 0);
}

/// The input without wrapper: the first two bytes choose the message, so that the fuzzer need not find a checksum.
void read_data(Bytes input, const Profile& profile) {
  if (input.size() < 2 || input.size() - 2 > data_size_max) return;
  messages::with_message(MessageNumber{u16_be(input, 0)}, TypedDecoding{input.subspan(2), &profile});
}

void read_capture(Bytes file, const Profile& profile) {
  auto reader = PcapReader::open(file);
  if (!reader) return;
  while (const auto datagram = reader->next())
    if (*datagram) read_datagram((*datagram)->payload, profile);
}

}  // namespace
}  // namespace ponte::dli

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto input = std::as_bytes(std::span{data, size});
  for (const auto edition : {ponte::dli::Edition::ed3, ponte::dli::Edition::ed_a}) {
    ponte::dli::Profile profile{edition};
    profile.accept_unassigned_checksum = edition == ponte::dli::Edition::ed_a;
    ponte::dli::read_datagram(input, profile);
    ponte::dli::read_data(input, profile);
    ponte::dli::read_capture(input, profile);
  }
  return 0;
}
