#include "ponte/dli/presence.hpp"

#include <algorithm>
#include <bit>

namespace ponte::dli {
namespace {

/// The value of field `number` in data whose fields before that one are complete; nothing when it is absent.
std::optional<std::uint64_t> earlier_integer(const MessageInfo& message, Bytes data, std::size_t offset,
                                             std::uint64_t vector, std::uint8_t number) {
  for (const auto& field : message.fields) {
    if (field.number > number) break;
    if ((vector >> (field.number - 1U) & 1U) == 0) continue;
    const auto width = field.width != 0 ? std::uint64_t{field.width}
                                        : earlier_integer(message, data, offset, vector, field.length_from).value_or(0);
    if (field.number == number) return load_unsigned(data.subspan(offset, width));
    offset += width;
  }
  return std::nullopt;
}

}  // namespace

FieldReader::FieldReader(const MessageInfo& message, Bytes data, const Profile& profile)
    : message_{&message}, data_{data}, vector_size_{profile.presence_bytes_of(message)}, edition_{profile.edition} {
  if (!profile.has_fields(message)) {
    refuse(DecodeError::Reason::not_in_edition, 0);
  } else if (data.size() < vector_size_) {
    refuse(DecodeError::Reason::truncated_vector, 0);
  } else {
    offset_ = vector_size_;
    vector_ = load_unsigned(data.first(vector_size_));
    remaining_ = vector_;
  }
}

void FieldReader::refuse(DecodeError::Reason reason, std::uint8_t field) {
  stopped_ = true;
  error_ = DecodeError{reason, field};
}

std::size_t FieldReader::text_size(const FieldInfo& field) {
  const auto size = earlier_integer(*message_, data_, vector_size_, vector_, field.length_from);
  if (!size) {
    refuse(DecodeError::Reason::text_without_length, field.number);
    return 0;
  }
  if (*size > variable_text_max) refuse(DecodeError::Reason::text_too_long, field.number);
  return *size;
}

Result<DecodeFacts, DecodeError> FieldReader::finish() const {
  if (error_) return fail(*error_);
  if (remaining_ != 0) return DecodeFacts{.newer_fields = true};
  if (offset_ != data_.size()) return fail(DecodeError{DecodeError::Reason::bytes_after_last_field, 0});
  return DecodeFacts{};
}

FieldWriter::FieldWriter(const MessageInfo& message, MutableBytes out, const Profile& profile)
    : message_{&message}, out_{out}, vector_size_{profile.presence_bytes_of(message)}, edition_{profile.edition} {
  if (!profile.has_fields(message))
    refuse(EncodeError::Reason::not_in_edition, 0);
  else if (out.size() < vector_size_)
    refuse(EncodeError::Reason::no_room, 0);
  else
    offset_ = vector_size_;
}

void FieldWriter::refuse(EncodeError::Reason reason, std::uint8_t field) {
  if (!error_) error_ = EncodeError{reason, field};
}

bool FieldWriter::is_sent(const FieldInfo& field) const {
  return !error_ && !field.excluded && field.number <= 8U * vector_size_ &&
         !(field.since_edition_a && edition_ == Edition::ed3);
}

std::optional<MutableBytes> FieldWriter::claim(const FieldInfo& field, std::size_t size) {
  if (size > out_.size() - offset_) {
    refuse(EncodeError::Reason::no_room, field.number);
    return std::nullopt;
  }
  const auto room = out_.subspan(offset_, size);
  offset_ += size;
  vector_ |= std::uint64_t{1} << (field.number - 1U);
  return room;
}

void FieldWriter::put_integer(const FieldInfo& field, std::int64_t raw) {
  if (!is_sent(field)) return;
  if (!range_of(field).holds(raw)) return refuse(EncodeError::Reason::value_too_wide, field.number);
  if (const auto room = claim(field, field.width)) store_integer(*room, static_cast<std::uint64_t>(raw));
}

void FieldWriter::put_float(const FieldInfo& field, float raw) {
  if (!is_sent(field)) return;
  if (const auto room = claim(field, field.width)) store_integer(*room, std::bit_cast<std::uint32_t>(raw));
}

void FieldWriter::put_text(const FieldInfo& field, std::string_view text) {
  if (!is_sent(field)) return;
  std::size_t size = field.width;
  if (field.type == FieldType::variable_text) {
    const auto told = earlier_integer(*message_, out_, vector_size_, vector_, field.length_from);
    if (!told) return refuse(EncodeError::Reason::text_without_length, field.number);
    if (*told < text.size()) return refuse(EncodeError::Reason::text_longer_than_its_length, field.number);
    size = *told;
  } else {
    text = text.substr(0, size - 1);
  }
  const auto room = claim(field, size);
  if (!room) return;
  const auto used = std::ranges::copy(bytes_of(text), room->begin()).out;
  std::fill(used, room->end(), std::byte{0});
}

Result<std::size_t, EncodeError> FieldWriter::finish() {
  if (error_) return fail(*error_);
  store_integer(out_.first(vector_size_), vector_);
  return offset_;
}

}  // namespace ponte::dli
