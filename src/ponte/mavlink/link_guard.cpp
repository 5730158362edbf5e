#include "ponte/mavlink/link_guard.hpp"

#include <algorithm>

namespace ponte::mavlink {
namespace {

std::optional<Refusal> refusal_for(SignatureVerdict verdict) {
  switch (verdict) {
    case SignatureVerdict::accepted: return {};
    case SignatureVerdict::wrong: return Refusal::wrong_signature;
    case SignatureVerdict::replayed: return Refusal::replayed;
    case SignatureVerdict::too_old: return Refusal::too_old;
    case SignatureVerdict::too_many_streams: return Refusal::too_many_streams;
  }
  return {};
}

}  // namespace

std::string_view name_of(Refusal refusal) {
  switch (refusal) {
    case Refusal::unsigned_frame: return "unsigned";
    case Refusal::downgraded: return "downgraded";
    case Refusal::wrong_signature: return name_of(SignatureVerdict::wrong);
    case Refusal::replayed: return name_of(SignatureVerdict::replayed);
    case Refusal::too_old: return name_of(SignatureVerdict::too_old);
    case Refusal::too_many_streams: return name_of(SignatureVerdict::too_many_streams);
  }
  return {};
}

std::optional<Refusal> LinkGuard::examine(WallTime now, const FrameView& frame, Signer* signer) {
  if (signer == nullptr) return {};
  const auto refusal = judge(now, frame, *signer);
  if (refusal) ++refused_[static_cast<std::size_t>(*refusal)];
  return refusal;
}

std::optional<Refusal> LinkGuard::judge(WallTime now, const FrameView& frame, Signer& signer) {
  if (frame.is_signed()) {
    const auto refusal = refusal_for(signer.verify(now, frame));
    if (!refusal) has_heard_signed_ = true;
    return refusal;
  }
  if (policy_.unsigned_frames == UnsignedPolicy::all) return {};
  if (policy_.unsigned_frames == UnsignedPolicy::until_signed && !has_heard_signed_) return {};
  if (frame.version != Version::v2) return Refusal::downgraded;
  if (std::ranges::find(policy_.unsigned_list, frame.message) != policy_.unsigned_list.end()) return {};
  return Refusal::unsigned_frame;
}

}  // namespace ponte::mavlink
