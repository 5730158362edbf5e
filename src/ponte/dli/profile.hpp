#pragma once

#include "ponte/dli/message_info.hpp"
#include "ponte/dli/properties.hpp"

#include <cstdint>
#include <string_view>
#include <vector>

namespace ponte::dli {

/// The IDD version that an edition puts into the Message Properties: 30 or 32.
[[nodiscard]] constexpr std::uint8_t idd_version_of(Edition edition) { return edition == Edition::ed3 ? 30 : 32; }

/// "3" or "A".
[[nodiscard]] constexpr std::string_view name_of(Edition edition) { return edition == Edition::ed3 ? "3" : "A"; }

/// How we speak to the peers of one network: an edition, and where they differ from our tables. The tables are not
/// everywhere sure of the standard, so an integrator can override scales and widths per message.
class Profile {
 public:
  Profile() = default;
  explicit Profile(Edition spoken) : edition{spoken}, idd_version{idd_version_of(spoken)} {}

  Edition edition{Edition::ed3};
  std::uint8_t idd_version{idd_version_of(Edition::ed3)};  ///< sent; a received message of another one is not dropped
  Checksum checksum{Checksum::sum16};  ///< sent, never `unassigned`; received messages say what they have
  bool accept_unassigned_checksum{};   ///< checksum code 11: take the message, four bytes behind it remain unexamined

  /// Physical value = raw * `scale` in this field. `scale` is finite and above 0. BAM, floats and texts have no scale
  /// to override.
  void override_scale(MessageNumber message, std::uint8_t field, double scale);

  /// The presence vector of this message takes `bytes` bytes, 1 to 8. Fields that a narrower vector has no bit for are
  /// not sent.
  void override_presence_bytes(MessageNumber message, std::uint8_t bytes);

  /// Physical value of one raw unit, in the unit of the field; 0: there is none, or it is not known.
  [[nodiscard]] double scale_of(const MessageInfo& message, const FieldInfo& field) const;

  /// Width of the presence vector in the edition spoken; 0: not known.
  [[nodiscard]] std::uint8_t presence_bytes_of(const MessageInfo& message) const {
    return presence_overrides_.empty() ? message.presence_bytes_in(edition) : overridden_presence_bytes(message);
  }

  /// True when the message exists in the edition spoken, and its fields are known.
  [[nodiscard]] bool has_fields(const MessageInfo& message) const {
    return message.is_in(edition) && presence_bytes_of(message) != 0 && !message.fields.empty();
  }

  friend bool operator==(const Profile&, const Profile&) = default;

 private:
  struct ScaleOverride {
    MessageNumber message;
    std::uint8_t field;
    double scale;
    friend bool operator==(const ScaleOverride&, const ScaleOverride&) = default;
  };
  struct PresenceOverride {
    MessageNumber message;
    std::uint8_t bytes;
    friend bool operator==(const PresenceOverride&, const PresenceOverride&) = default;
  };

  [[nodiscard]] std::uint8_t overridden_presence_bytes(const MessageInfo& message) const;

  std::vector<ScaleOverride> scale_overrides_;        ///< by message and field, ascending
  std::vector<PresenceOverride> presence_overrides_;  ///< by message, ascending
};

}  // namespace ponte::dli
