#pragma once

#include "ponte/core/bytes.hpp"
#include "ponte/core/result.hpp"
#include "ponte/dli/integers.hpp"
#include "ponte/dli/message_info.hpp"
#include "ponte/dli/profile.hpp"

#include <cstdint>
#include <optional>
#include <string_view>

/// Message data of Edition 3 and Edition A (presence vector): a vector that tells which fields are there, then these
/// fields without gaps. The vector is one big-endian integer; its bit `n - 1` stands for field `n`.
namespace ponte::dli {

/// Longest text of variable length, in bytes.
inline constexpr std::size_t variable_text_max = 255;

struct DecodeError {
  enum class Reason : std::uint8_t {
    not_in_edition,         ///< the message has no field table in the edition of the profile
    truncated_vector,       ///< the data end inside the presence vector
    truncated_field,        ///< the data end inside `field`
    text_without_length,    ///< `field` is a text whose length field is absent
    text_too_long,          ///< `field` is a text of more than 255 bytes
    bytes_after_last_field  ///< more data than the announced fields take
  } reason;
  std::uint8_t field{};  ///< number of the field, 0 where none is to blame

  friend constexpr bool operator==(const DecodeError&, const DecodeError&) = default;
};

/// What a decoder noticed beside the fields.
struct DecodeFacts {
  /// The vector announces fields that the edition of the profile does not know. The known fields before the first of
  /// them were read; from there on the data cannot be told apart and were ignored.
  bool newer_fields{};

  friend constexpr bool operator==(const DecodeFacts&, const DecodeFacts&) = default;
};

/// Takes message data apart, field by field. Ask `next` for every field of the table, in ascending order, then
/// `finish`.
class FieldReader {
 public:
  /// `message` and `data` must outlive the reader and what it returns.
  FieldReader(const MessageInfo& message, Bytes data, const Profile& profile);

  /// The bytes of `field`; nothing when it is absent, and nothing for any field after an error or a newer field.
  [[nodiscard]] std::optional<Bytes> next(const FieldInfo& field) {
    const auto bit = std::uint64_t{1} << (field.number - 1U);
    if ((remaining_ & bit) == 0 || stopped_) return std::nullopt;
    const auto unknown_before = (remaining_ & (bit - 1)) != 0;
    if (unknown_before || (field.since_edition_a && edition_ == Edition::ed3)) {
      stopped_ = true;
      return std::nullopt;
    }
    const auto size = field.width != 0 ? std::size_t{field.width} : text_size(field);
    if (stopped_) return std::nullopt;
    if (size > data_.size() - offset_) {
      refuse(DecodeError::Reason::truncated_field, field.number);
      return std::nullopt;
    }
    const auto bytes = data_.subspan(offset_, size);
    offset_ += size;
    remaining_ &= ~bit;
    return bytes;
  }

  [[nodiscard]] Result<DecodeFacts, DecodeError> finish() const;

 private:
  void refuse(DecodeError::Reason reason, std::uint8_t field);
  [[nodiscard]] std::size_t text_size(const FieldInfo& field);

  const MessageInfo* message_;
  Bytes data_;
  std::uint8_t vector_size_;
  Edition edition_;
  std::size_t offset_{};
  std::uint64_t vector_{};
  std::uint64_t remaining_{};  ///< bits of fields not yet read
  bool stopped_{};
  std::optional<DecodeError> error_;
};

struct EncodeError {
  enum class Reason : std::uint8_t {
    not_in_edition,              ///< the message has no field table in the edition of the profile
    no_room,                     ///< the data do not fit into the buffer
    value_too_wide,              ///< the raw value of `field` needs more bytes than the field has
    text_without_length,         ///< `field` is a text whose length field is absent
    text_longer_than_its_length  ///< `field` is a text that its length field would cut
  } reason;
  std::uint8_t field{};  ///< number of the field, 0 where none is to blame

  friend constexpr bool operator==(const EncodeError&, const EncodeError&) = default;
};

/// Puts message data together. Fields are put in ascending order; those that the edition of the profile does not know,
/// that a presence vector made narrower has no bit for, or that are out of ponte's scope are left out.
class FieldWriter {
 public:
  /// `message` and `out` must outlive the writer.
  FieldWriter(const MessageInfo& message, MutableBytes out, const Profile& profile);

  /// `raw` in the range of an integer field.
  void put_integer(const FieldInfo& field, std::int64_t raw);
  void put_float(const FieldInfo& field, float raw);
  /// Into a text of fixed width the text goes up to its width less one, and NULs fill the rest: a text always ends in
  /// NUL. Into a text of variable length go as many bytes as its length field tells, NULs behind a shorter text.
  void put_text(const FieldInfo& field, std::string_view text);

  /// The number of bytes written to `out`.
  [[nodiscard]] Result<std::size_t, EncodeError> finish();

 private:
  /// Room for `size` bytes of the field, and its bit in the vector; nothing when the field is not to be sent.
  [[nodiscard]] std::optional<MutableBytes> claim(const FieldInfo& field, std::size_t size);
  [[nodiscard]] bool is_sent(const FieldInfo& field) const;
  void refuse(EncodeError::Reason reason, std::uint8_t field);

  const MessageInfo* message_;
  MutableBytes out_;
  std::uint8_t vector_size_;
  Edition edition_;
  std::size_t offset_{};
  std::uint64_t vector_{};
  std::optional<EncodeError> error_;
};

}  // namespace ponte::dli
