#include "ponte/mavlink/link_guard.hpp"

#include "ponte/mavlink/test_signing.hpp"
#include "support/bytes.hpp"

#include <gtest/gtest.h>

namespace ponte::mavlink {
namespace {

using namespace std::chrono_literals;
using testing::beginning_of_2015;
using testing::key;
using testing::signed_heartbeat;

constexpr auto now = beginning_of_2015 + 1h;
constexpr auto radio_status_v1_frame = "fe 09 09 01 01 6d  00 00 00 00 00 00 00 00 00  00 00";

struct Scene {
  explicit Scene(UnsignedPolicy policy) : guard{LinkPolicy{.unsigned_frames = policy}} {}

  std::optional<Refusal> examine(const std::vector<std::byte>& frame) {
    return guard.examine(now, parse_frame(frame).value(), &signer);
  }
  std::optional<Refusal> examine(const char* frame) { return examine(bytes(frame)); }

  LinkGuard guard;
  Signer signer{key(), SigningTime{}};
  Signer peer{key(), SigningTime{}};
};

TEST(LinkGuard, TakesEverythingWhileThereIsNoKey) {
  LinkGuard guard{{.unsigned_frames = UnsignedPolicy::listed}};
  for (const auto* frame : {testing::heartbeat_frame, testing::heartbeat_v1_frame, testing::heartbeat_signed_frame})
    EXPECT_EQ(guard.examine(now, parse_frame(bytes(frame)).value(), nullptr), std::nullopt);
}

TEST(LinkGuard, TakesUnsignedFramesOfTheListOnly) {
  Scene scene{UnsignedPolicy::listed};
  EXPECT_EQ(scene.examine(testing::radio_status_frame), std::nullopt);
  EXPECT_EQ(scene.examine(testing::heartbeat_frame), Refusal::unsigned_frame);
  EXPECT_EQ(scene.examine(signed_heartbeat(scene.peer, now)), std::nullopt);
}

TEST(LinkGuard, RefusesADowngradeEvenToAMessageOfTheList) {
  Scene scene{UnsignedPolicy::listed};
  EXPECT_EQ(scene.examine(testing::heartbeat_v1_frame), Refusal::downgraded);
  EXPECT_EQ(scene.examine(radio_status_v1_frame), Refusal::downgraded);
}

TEST(LinkGuard, ClosesWithTheFirstRightSignature) {
  Scene scene{UnsignedPolicy::until_signed};
  Signer stranger{key(0), SigningTime{}};
  EXPECT_EQ(scene.examine(testing::heartbeat_v1_frame), std::nullopt);
  EXPECT_EQ(scene.examine(signed_heartbeat(stranger, now)), Refusal::wrong_signature);
  EXPECT_EQ(scene.examine(testing::heartbeat_frame), std::nullopt) << "a wrong signature closes nothing";
  EXPECT_EQ(scene.examine(signed_heartbeat(scene.peer, now)), std::nullopt);
  EXPECT_EQ(scene.examine(testing::heartbeat_frame), Refusal::unsigned_frame);
  EXPECT_EQ(scene.examine(testing::heartbeat_v1_frame), Refusal::downgraded);
  EXPECT_EQ(scene.examine(testing::radio_status_frame), std::nullopt);
}

TEST(LinkGuard, WhereAllUnsignedFramesAreTakenSignaturesMustStillBeRight) {
  Scene scene{UnsignedPolicy::all};
  const auto frame = signed_heartbeat(scene.peer, now);
  EXPECT_EQ(scene.examine(frame), std::nullopt);
  EXPECT_EQ(scene.examine(testing::heartbeat_v1_frame), std::nullopt);
  EXPECT_EQ(scene.examine(frame), Refusal::replayed);
}

TEST(LinkGuard, CountsEachRefusalUnderItsOwnReason) {
  Scene scene{UnsignedPolicy::listed};
  Signer stranger{key(0), SigningTime{}};
  Signer sleeper{key(), SigningTime{}};
  const auto frame = signed_heartbeat(scene.peer, now);
  EXPECT_EQ(scene.examine(frame), std::nullopt);
  EXPECT_EQ(scene.examine(testing::heartbeat_frame), Refusal::unsigned_frame);
  EXPECT_EQ(scene.examine(testing::heartbeat_v1_frame), Refusal::downgraded);
  EXPECT_EQ(scene.examine(signed_heartbeat(stranger, now)), Refusal::wrong_signature);
  EXPECT_EQ(scene.examine(frame), Refusal::replayed);
  EXPECT_EQ(scene.examine(signed_heartbeat(sleeper, now - 2min, {.link_id = 8})), Refusal::too_old);
  for (std::uint8_t i = 1; i < Signer::stream_limit; ++i)
    EXPECT_EQ(scene.examine(signed_heartbeat(scene.peer, now, {.system = SystemId{i}, .link_id = 9})), std::nullopt);
  EXPECT_EQ(scene.examine(signed_heartbeat(scene.peer, now, {.link_id = 10})), Refusal::too_many_streams);
  EXPECT_EQ(scene.guard.refused(), (Refusals{1, 1, 1, 1, 1, 1}));
}

}  // namespace
}  // namespace ponte::mavlink
