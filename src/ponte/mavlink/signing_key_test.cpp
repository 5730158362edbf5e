#include "ponte/mavlink/signing_key.hpp"

#include "ponte/core/hex.hpp"

#include <gtest/gtest.h>

#include <concepts>
#include <ostream>
#include <string>

namespace ponte::mavlink {
namespace {

template <class T>
concept Printable = requires(std::ostream& out, const T& value) { out << value; };
static_assert(!std::equality_comparable<SigningKey> && !Printable<SigningKey>);

// What SHA-256 makes of "gateway-test-passphrase", by Python's hashlib.
constexpr auto hash = "eeb19eeebab0a23fc631fc42bc48d333ecd636616b6425e32e764d0f2881030a";

std::string key_in(std::string_view content) {
  const auto key = read_signing_key(bytes_of(content));
  return key ? to_hex(key->secret()) : "none";
}

TEST(ReadSigningKey, HashesAPassphrase) {
  EXPECT_EQ(key_in("passphrase=gateway-test-passphrase"), hash);
  EXPECT_EQ(key_in("passphrase=gateway-test-passphrase\n"), hash);
  EXPECT_EQ(key_in("passphrase=gateway-test-passphrase\r\n"), hash);
  EXPECT_EQ(key_in("passphrase=" + std::string(21, 'x')).size(), 64U) << "32 bytes, and a passphrase all the same";
  EXPECT_NE(key_in("passphrase= gateway-test-passphrase"), hash) << "blanks are part of it";
}

TEST(ReadSigningKey, TakesHexDigitsAndRawBytes) {
  EXPECT_EQ(key_in(hash), hash);
  EXPECT_EQ(key_in(std::string{hash} + "\n"), hash);
  const auto raw = parse_hex(hash).value();
  EXPECT_EQ(to_hex(read_signing_key(raw)->secret()), hash);
  const std::string ends_like_a_line = std::string(31, '\x01') + "\n";
  EXPECT_EQ(key_in(ends_like_a_line), to_hex(bytes_of(ends_like_a_line)));
}

TEST(ReadSigningKey, RefusesEverythingElse) {
  for (const std::string content :
       {"", "\n", "passphrase=", "passphrase=\n", "passphrase=two\nlines", "secret", "0123"})
    EXPECT_EQ(key_in(content), "none") << content;
  EXPECT_EQ(key_in(std::string(31, 'x')), "none");
  EXPECT_EQ(key_in(std::string(33, 'x')), "none");
  EXPECT_EQ(key_in(std::string(64, 'x')), "none");
  EXPECT_EQ(key_in(std::string(62, '0') + "  "), "none");
}

TEST(Wipe, OverwritesEveryByte) {
  std::array<std::byte, 5> secret{std::byte{1}, std::byte{2}, std::byte{3}, std::byte{4}, std::byte{5}};
  wipe(secret);
  EXPECT_EQ(secret, (std::array<std::byte, 5>{}));
}

}  // namespace
}  // namespace ponte::mavlink
