#pragma once

#include "ponte/core/bytes.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <span>

namespace ponte::mavlink {

/// The secret that both ends of a signed link share. It can be neither printed nor compared, and is wiped at its end.
class SigningKey {
 public:
  static constexpr std::size_t size = 32;

  explicit SigningKey(std::span<const std::byte, size> secret);
  SigningKey(const SigningKey&) = default;
  SigningKey& operator=(const SigningKey&) = default;
  ~SigningKey();

  [[nodiscard]] std::span<const std::byte, size> secret() const { return secret_; }

 private:
  std::array<std::byte, size> secret_;
};

/// The key that a key file or a variable holds:
/// - `passphrase=` and words up to the end of the line: the key is their SHA-256, as ground stations make it;
/// - 64 hex digits, and perhaps the end of the line;
/// - exactly 32 bytes: the key itself.
/// Nothing if it is none of these.
[[nodiscard]] std::optional<SigningKey> read_signing_key(Bytes content);

/// Overwrites bytes that were secret, in a way that no optimiser leaves out.
void wipe(MutableBytes secret);

}  // namespace ponte::mavlink
