// Keys, stored times, SETUP_SIGNING, and the judgement of any frame. The first byte chooses the policy; the second how
// many of the rest are a key file, the others a stream of frames. Every second frame is signed before it is judged.

#include "ponte/core/assert.hpp"
#include "ponte/mavlink/link_guard.hpp"
#include "ponte/mavlink/setup_signing.hpp"
#include "ponte/mavlink/signing_store.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

namespace {

using namespace ponte;
using namespace ponte::mavlink;

constexpr WallTime now = wall_time_from_unix_us(1'700'000'000'000'000);

void judge(const FrameView& frame, LinkGuard& guard, Signer& signer) {
  (void)read_setup_signing(frame);
  const auto time = signer.time();
  const auto refusal = guard.examine(now, frame, &signer);
  PONTE_ASSERT(signer.time() >= time);
  if (frame.is_signed() && !refusal) PONTE_ASSERT(guard.examine(now, frame, &signer) == Refusal::replayed);
}

void judge_signed(const FrameView& frame, LinkGuard& guard, Signer& signer) {
  std::array<std::byte, max_frame_size> copy{};
  std::ranges::copy(frame.whole, copy.begin());
  const auto size = signer.sign(now, 1, copy, frame.whole.size());
  const auto sealed = parse_frame(Bytes{copy}.first(size));
  PONTE_ASSERT(sealed && sealed->is_signed());
  PONTE_ASSERT(guard.examine(now, *sealed, &signer) != Refusal::wrong_signature);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  auto input = std::as_bytes(std::span{data, size});
  if (input.size() < 2) return 0;
  LinkGuard guard{{.unsigned_frames = static_cast<UnsignedPolicy>(u8(input, 0) % 3)}};
  const std::size_t key_size = u8(input, 1);
  input = input.subspan(2);
  const auto head = input.first(std::min(key_size, input.size()));
  const auto key = read_signing_key(head);
  const auto stored = read_signing_store(head);
  PONTE_ASSERT(stored.next_slot < signing_slot_count);
  Signer signer{key ? *key : SigningKey{std::array<std::byte, SigningKey::size>{}}, SigningTime{}};

  auto rest = input.subspan(head.size());
  for (bool is_odd = false; !rest.empty(); is_odd = !is_odd) {
    const auto frame = parse_frame(rest);
    if (frame && is_odd && frame->version == Version::v2 && !frame->is_signed())
      judge_signed(*frame, guard, signer);
    else if (frame)
      judge(*frame, guard, signer);
    rest = rest.subspan(frame ? frame->whole.size() : 1);
  }
  return 0;
}
