#include "ponte/mavlink/parser.hpp"

#include <algorithm>
#include <cstring>

namespace ponte::mavlink {
namespace {

/// Unknown frames in a row that are followed to find a proof: as many as fit into an Ethernet packet.
constexpr int chain_limit = 128;

}  // namespace

void Parser::on_bytes(Timestamp now, Bytes bytes, FrameSink& sink) {
  on_tick(now, sink);
  if (bytes.empty()) return;
  const auto rest = consume_held(bytes, sink);
  if (!rest.empty()) keep(rest.subspan(consume(rest, rest.size(), Ending::open, sink)));
  deadline_.reset();
  if (is_unfinished_) deadline_ = now + silence_limit;
}

void Parser::on_tick(Timestamp now, FrameSink& sink) {
  if (!deadline_ || now < *deadline_) return;
  const auto held = Bytes{held_}.first(held_size_);
  keep(held.subspan(consume(held, held.size(), Ending::silence, sink)));
  deadline_.reset();
}

void Parser::finish(FrameSink& sink) {
  consume(Bytes{held_}.first(held_size_), held_size_, Ending::end, sink);
  held_size_ = 0;
  deadline_.reset();
}

void Parser::on_datagram(Bytes datagram, FrameSink& sink) {
  finish(sink);
  consume(datagram, datagram.size(), Ending::end, sink);
}

/// Decides on the held bytes with the help of those that have just come. Returns the part of `bytes` that begins with
/// the first undecided byte; if it is not empty, nothing is held any more.
Bytes Parser::consume_held(Bytes bytes, FrameSink& sink) {
  while (held_size_ > 0 && !bytes.empty()) {
    const std::size_t old_size = held_size_;
    const auto added = std::min({bytes.size(), held_.size() - old_size, max_frame_size});
    std::copy_n(bytes.begin(), added, held_.begin() + held_size_);
    const auto held = Bytes{held_}.first(old_size + added);
    const auto consumed = consume(held, old_size, Ending::open, sink);
    if (consumed < old_size) {
      keep(held.subspan(consumed));
      bytes = bytes.subspan(added);
    } else {
      held_size_ = 0;
      bytes = bytes.subspan(consumed - old_size);
    }
  }
  return bytes;
}

/// Decides on frames and skipped bytes from the beginning of `input` until `stop` is reached, or until a decision needs
/// bytes that are not there. Returns the number of bytes decided on, which exceeds `stop` if a frame does.
std::size_t Parser::consume(Bytes input, std::size_t stop, Ending ending, FrameSink& sink) {
  std::size_t at = 0;
  while (at < stop) {
    const auto rest = input.subspan(at);
    const auto frame = parse_frame(rest);
    if (!frame && frame.error() == FrameError::not_a_frame) {
      const auto run = rest.first(find_start(rest.first(stop - at)));
      skip(run, SkipReason::noise, sink);
      at += run.size();
      continue;
    }

    std::optional<SkipReason> objection;
    const MessageInfo* message = nullptr;
    if (!frame) {
      is_unfinished_ = frame.error() == FrameError::incomplete;
      if (is_unfinished_ && ending == Ending::open) return at;
      objection = is_unfinished_ ? SkipReason::truncated : SkipReason::unknown_flag;
    } else if (message = index_.find(frame->message); message == nullptr) {
      const auto claim = judge_unknown(rest, frame->whole.size(), ending);
      is_unfinished_ = claim == Claim::needs_bytes;
      if (claim == Claim::needs_bytes || claim == Claim::needs_successor) return at;
      if (claim == Claim::refuted) objection = SkipReason::unconfirmed;
    } else if (!checksum_matches(*frame, message->crc_extra)) {
      objection = SkipReason::checksum;
    } else if (frame->is_signed()) {
      const auto claim = judge_signature(rest, frame->whole.size(), ending);
      is_unfinished_ = claim == Claim::needs_bytes;
      if (is_unfinished_) return at;
      if (claim == Claim::refuted) objection = SkipReason::truncated;
    }

    if (objection) {
      skip(rest.first(1), *objection, sink);
      ++at;
      continue;
    }
    sink.on_frame(*frame, message);
    ++counters_.frames;
    if (message == nullptr) ++counters_.unknown_frames;
    counters_.bytes += frame->whole.size();
    at += frame->whole.size();
  }
  is_unfinished_ = false;
  return at;
}

void Parser::keep(Bytes tail) {
  std::memmove(held_.data(), tail.data(), tail.size());  // the tail may be a part of the held bytes
  held_size_ = static_cast<std::uint16_t>(tail.size());
}

void Parser::skip(Bytes run, SkipReason reason, FrameSink& sink) {
  sink.on_skipped(run, reason);
  counters_.bytes += run.size();
  counters_.skipped[static_cast<std::size_t>(reason)] += run.size();
}

/// Whether the signature at the end of the first `size` bytes of `input` is whole. The checksum does not cover it: if
/// some of it got lost, the beginning of the next frame has taken its place.
Parser::Claim Parser::judge_signature(Bytes input, std::size_t size, Ending ending) const {
  auto at = size - signature_size;
  const auto claim = look_inside(input, at, size, ending);
  return ending == Ending::open || claim == Claim::refuted ? claim : Claim::confirmed;
}

/// Whether the unknown message in the first `size` bytes of `input` is proven to be one. Whatever is decided from some
/// of the bytes, more bytes would not change; this is what makes the pieces of a stream irrelevant.
Parser::Claim Parser::judge_unknown(Bytes input, std::size_t size, Ending ending) {
  const auto window = ending == Ending::end ? input : input.first(std::min(input.size(), lookahead));
  auto end = size;
  const auto claim = follow(window, end, ending);
  if (claim == Claim::refuted) return claim;

  const auto position = counters_.bytes;
  auto settled = searched_until_ > position ? static_cast<std::size_t>(searched_until_ - position) : 1;
  const auto inside = look_inside(window, settled, end, ending);
  searched_until_ = position + settled;
  if (inside == Claim::refuted) return inside;
  const bool more_may_come = ending == Ending::open && window.size() < lookahead;
  return claim == Claim::confirmed && more_may_come ? inside : claim;
}

/// Goes from unknown frame to unknown frame, beginning with the one before `end`, to where the first of them is proved
/// or disproved. Leaves that place in `end`.
Parser::Claim Parser::follow(Bytes window, std::size_t& end, Ending ending) const {
  const bool is_full = window.size() == lookahead && ending != Ending::end;
  for (int link = 0; link < chain_limit; ++link) {
    if (end == window.size()) {
      if (ending == Ending::end) return Claim::confirmed;
      return is_full ? Claim::refuted : Claim::needs_successor;
    }
    const auto next = parse_frame(window.subspan(end));
    if (!next) {
      const bool may_become_one = next.error() == FrameError::incomplete && ending == Ending::open && !is_full;
      return may_become_one ? Claim::needs_bytes : Claim::refuted;
    }
    if (const auto* message = index_.find(next->message); message != nullptr)
      return checksum_matches(*next, message->crc_extra) ? Claim::confirmed : Claim::refuted;
    end += next->whole.size();
  }
  return Claim::refuted;
}

/// Refutes if a good frame of a known message begins between `settled` and `end`, and needs bytes if one that begins
/// there is still unfinished. Moves `settled` as far as no more bytes can change the answer.
Parser::Claim Parser::look_inside(Bytes window, std::size_t& settled, std::size_t end, Ending ending) const {
  bool is_settled = true;
  for (auto at = settled; at < end; ++at) {
    at += find_start(window.first(end).subspan(at));
    if (at == end) break;
    if (is_settled) settled = at;
    const auto frame = parse_frame(window.subspan(at));
    const auto* message = frame ? index_.find(frame->message) : nullptr;
    if (message != nullptr && checksum_matches(*frame, message->crc_extra)) return Claim::refuted;
    if (!frame && frame.error() == FrameError::incomplete && ending != Ending::end) is_settled = false;
  }
  if (!is_settled) return Claim::needs_bytes;
  settled = std::max(settled, end);
  return Claim::confirmed;
}

}  // namespace ponte::mavlink
