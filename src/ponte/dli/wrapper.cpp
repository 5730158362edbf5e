#include "ponte/dli/wrapper.hpp"

#include "ponte/core/assert.hpp"

#include <algorithm>

namespace ponte::dli {
namespace {

constexpr bool is_credible(std::size_t length) { return length >= 1 && length <= data_size_max; }

std::size_t length_in(Bytes input) { return u16_be(input, 2); }

Properties properties_in(Bytes input) { return properties_from_word(u16_be(input, 14)); }

bool checksum_holds(Checksum checksum, Bytes summed, Bytes trailer) {
  switch (checksum) {
    case Checksum::none:
    case Checksum::unassigned: return true;
    case Checksum::sum16: return u16_be(trailer, 0) == static_cast<std::uint16_t>(additive_sum(summed));
    case Checksum::sum32: return u32_be(trailer, 0) == additive_sum(summed);
  }
  return false;
}

}  // namespace

std::uint32_t additive_sum(Bytes bytes) {
  std::uint32_t sum = 0;
  for (const auto byte : bytes) sum += std::to_integer<std::uint32_t>(byte);
  return sum;
}

std::size_t claimed_size(Bytes input) {
  if (input.size() < wrapper_size || !is_credible(length_in(input))) return 0;
  const auto size = wrapper_size + length_in(input) + size_of(properties_in(input).checksum);
  return size <= input.size() ? size : 0;
}

Result<WrapperView, WrapperError> parse_message(Bytes input, const Profile& profile) {
  if (input.size() < wrapper_size) return fail(WrapperError::truncated);
  const auto length = length_in(input);
  if (!is_credible(length)) return fail(WrapperError::bad_length);
  const auto properties = properties_in(input);
  if (properties.checksum == Checksum::unassigned && !profile.accept_unassigned_checksum)
    return fail(WrapperError::unassigned_checksum);
  const auto size = claimed_size(input);
  if (size == 0) return fail(WrapperError::beyond_end);

  const auto summed = input.first(wrapper_size + length);
  if (!checksum_holds(properties.checksum, summed, input.first(size).subspan(summed.size())))
    return fail(WrapperError::bad_checksum);
  return WrapperView{
      .sequence = u16_be(input, 0),
      .source = EntityId{u32_be(input, 4)},
      .destination = EntityId{u32_be(input, 8)},
      .number = MessageNumber{u16_be(input, 12)},
      .properties = properties,
      .data = summed.subspan(wrapper_size),
      .whole = input.first(size),
  };
}

Result<std::size_t, WriteError> wrap_in_place(MutableBytes out, const Envelope& envelope, MessageNumber number,
                                              std::size_t data_size, const Profile& profile) {
  PONTE_ASSERT(profile.checksum != Checksum::unassigned);
  if (data_size == 0) return fail(WriteError::no_data);
  if (data_size > data_size_max) return fail(WriteError::too_long);
  const auto summed_size = wrapper_size + data_size;
  const auto size = summed_size + size_of(profile.checksum);
  if (size > out.size()) return fail(WriteError::no_room);

  const Properties properties{
      .acknowledgement_wanted = envelope.acknowledgement_wanted,
      .idd_version = profile.idd_version,
      .checksum = profile.checksum,
  };
  // The first field is Sequence # in Edition 3, where it holds -1, and Reserved in Edition A.
  store_be<std::uint16_t>(&out[0], profile.edition == Edition::ed3 ? 0xFFFF : 0);
  store_be(&out[2], static_cast<std::uint16_t>(data_size));
  store_be(&out[4], envelope.source.value);
  store_be(&out[8], envelope.destination.value);
  store_be(&out[12], number.value);
  store_be(&out[14], to_word(properties));
  const auto sum = additive_sum(out.first(summed_size));
  if (profile.checksum == Checksum::sum16) store_be(&out[summed_size], static_cast<std::uint16_t>(sum));
  if (profile.checksum == Checksum::sum32) store_be(&out[summed_size], sum);
  return size;
}

Result<std::size_t, WriteError> write_message(MutableBytes out, const Envelope& envelope, MessageNumber number,
                                              Bytes data, const Profile& profile) {
  if (data.empty()) return fail(WriteError::no_data);
  if (data.size() > data_size_max) return fail(WriteError::too_long);
  if (wrapper_size + data.size() > out.size()) return fail(WriteError::no_room);
  std::ranges::copy(data, out.subspan(wrapper_size).begin());
  return wrap_in_place(out, envelope, number, data.size(), profile);
}

}  // namespace ponte::dli
