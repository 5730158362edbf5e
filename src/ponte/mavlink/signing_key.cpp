#include "ponte/mavlink/signing_key.hpp"

#include "ponte/core/assert.hpp"
#include "ponte/core/hex.hpp"

#include <openssl/crypto.h>
#include <openssl/evp.h>

#include <algorithm>
#include <string_view>

namespace ponte::mavlink {
namespace {

std::string_view without_line_end(std::string_view text) {
  if (text.ends_with('\n')) text.remove_suffix(1);
  if (text.ends_with('\r')) text.remove_suffix(1);
  return text;
}

SigningKey key_of_passphrase(std::string_view words) {
  std::array<std::byte, SigningKey::size> hash{};
  const auto done = EVP_Digest(words.data(), words.size(), reinterpret_cast<unsigned char*>(hash.data()), nullptr,
                               EVP_sha256(), nullptr);
  PONTE_ASSERT(done == 1);
  const SigningKey key{hash};
  wipe(hash);
  return key;
}

}  // namespace

SigningKey::SigningKey(std::span<const std::byte, size> secret) { std::ranges::copy(secret, secret_.begin()); }
SigningKey::~SigningKey() { wipe(secret_); }

std::optional<SigningKey> read_signing_key(Bytes content) {
  constexpr std::string_view passphrase = "passphrase=";
  constexpr auto hex_digits = 2 * SigningKey::size;
  const auto line = without_line_end({reinterpret_cast<const char*>(content.data()), content.size()});
  if (line.starts_with(passphrase)) {
    const auto words = line.substr(passphrase.size());
    if (words.empty() || words.find_first_of("\r\n") != std::string_view::npos) return {};
    return key_of_passphrase(words);
  }
  if (content.size() == SigningKey::size) return SigningKey{content.first<SigningKey::size>()};
  if (line.size() != hex_digits) return {};
  auto bytes = parse_hex(line);
  if (!bytes || bytes->size() != SigningKey::size) return {};
  const SigningKey key{Bytes{*bytes}.first<SigningKey::size>()};
  wipe(*bytes);
  return key;
}

void wipe(MutableBytes secret) { OPENSSL_cleanse(secret.data(), secret.size()); }

}  // namespace ponte::mavlink
