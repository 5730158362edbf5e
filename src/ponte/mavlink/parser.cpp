#include "ponte/mavlink/parser.hpp"

#include <algorithm>
#include <cstring>

namespace ponte::mavlink {
namespace {

/// Unknown frames in a row that are followed to find a proof: as many as fit into an Ethernet packet.
constexpr int chain_limit = 128;

bool has_expected_length(const FrameView& frame, const MessageInfo& message) {
  const auto size = frame.payload.size();
  return frame.version == Version::v2 ? size <= message.full_length : size == message.base_length;
}

/// How many more bytes have to come until more is known of the frame that begins at the first byte of `input`.
std::uint16_t bytes_until_news(Bytes input) {
  const std::size_t telling = input[0] != start_v2 ? 2 : 3;  // length, flags
  return static_cast<std::uint16_t>(input.size() < telling ? telling - input.size() : missing_bytes(input));
}

}  // namespace

void Parser::decide(Timestamp now, Bytes bytes, FrameSink& sink) {
  const auto rest = consume_held(bytes, sink);
  if (!rest.empty()) keep(rest.subspan(consume(rest, rest.size(), Ending::open, sink)));
  const bool is_unfinished = news_in_ > 0;
  deadline_ = is_unfinished ? now + silence_limit : never;
  quiet_size_ = static_cast<std::uint16_t>(is_unfinished ? held_size_ + news_in_ - 1 : 0);
}

void Parser::give_up(FrameSink& sink) {
  const auto held = Bytes{held_}.first(held_size_);
  keep(held.subspan(consume(held, held.size(), Ending::silence, sink)));
  deadline_ = never;
  quiet_size_ = 0;
}

std::size_t Parser::bytes_needed() const { return missing_bytes(Bytes{held_}.first(held_size_).subspan(behind_)); }

void Parser::finish(FrameSink& sink) {
  if (held_size_ > 0) consume(Bytes{held_}.first(held_size_), held_size_, Ending::end, sink);
  held_size_ = 0;
  deadline_ = never;
  quiet_size_ = 0;
}

void Parser::on_datagram(Bytes datagram, FrameSink& sink) {
  finish(sink);
  consume(datagram, datagram.size(), Ending::end, sink);
}

/// Decides on the held bytes with the help of those that have just come; a short piece is decided on in one go with
/// them. Returns the part of `bytes` that is still needed; if it is not empty, nothing is held any more.
Bytes Parser::consume_held(Bytes bytes, FrameSink& sink) {
  while (held_size_ > 0 && !bytes.empty()) {
    const std::size_t old_size = held_size_;
    const auto added = std::min({bytes.size(), held_.size() - old_size, max_frame_size});
    std::copy_n(bytes.begin(), added, held_.begin() + held_size_);
    const auto held = Bytes{held_}.first(old_size + added);
    const bool is_all = added == bytes.size();
    const auto stop = is_all ? held.size() : std::max<std::size_t>(old_size, behind_ + 1U);
    const auto done = consume(held, stop, Ending::open, sink);
    if (is_all || done < old_size) {
      keep(held.subspan(done));
      bytes = bytes.subspan(added);
    } else {
      held_size_ = 0;
      bytes = bytes.subspan(done - old_size);
    }
  }
  return bytes;
}

// This and `deliver` are done for every frame.
[[gnu::always_inline]] inline Parser::Verdict Parser::judge_known(const FrameView& frame,
                                                                  const MessageInfo& message) const {
  if (!checksum_matches(frame, message.crc_extra)) return {Claim::refuted, SkipReason::checksum};
  // A newer dialect may have extended the message, so an unexpected length alone is no objection.
  const bool is_expected = has_expected_length(frame, message);
  if (is_expected && !frame.is_signed()) return {Claim::confirmed, {}};
  const auto doubtful = is_expected ? frame.signature() : frame.whole.subspan(1);
  return {holds_frame(doubtful) ? Claim::refuted : Claim::confirmed, SkipReason::truncated};
}

/// Delivers a frame whose first `shared` bytes belong to the one before too.
[[gnu::always_inline]] inline void Parser::deliver(const FrameView& frame, const MessageInfo* message,
                                                   std::size_t shared, FrameSink& sink) {
  if (shared > 0) sink.on_overlap(shared);
  sink.on_frame(frame, message);
  const auto size = frame.whole.size();
  ++counters_.frames;
  if (message == nullptr) ++counters_.unknown_frames;
  if (shared > 0) ++counters_.overlaps;
  counters_.bytes += size - shared;
  behind_ = static_cast<std::uint16_t>(size);
}

/// Decides on frames and skipped bytes of `input`, whose first `behind_` bytes are decided on already, until `stop` is
/// reached, or until a decision needs bytes that are not there. Returns the number of bytes that are not needed any
/// more, which exceeds `stop` if a frame does.
std::size_t Parser::consume(Bytes input, std::size_t stop, Ending ending, FrameSink& sink) {
  std::size_t at = behind_;
  while (at < stop) {
    const auto rest = input.subspan(at);
    const auto frame = parse_frame(rest);
    const auto* message = frame ? find_message(*dialect_, *frame) : nullptr;
    const auto verdict = message != nullptr ? judge_known(*frame, *message)
                         : frame ? Verdict{judge_unknown(rest, frame->whole.size(), ending), SkipReason::unconfirmed}
                                 : judge_error(frame.error(), ending);
    if (verdict.claim == Claim::confirmed) {
      deliver(*frame, message, 0, sink);
      at += frame->whole.size();
      continue;
    }
    if (verdict.claim != Claim::refuted) {
      if (!frame) news_in_ = bytes_until_news(rest);
      return at - behind_;
    }

    look_back(input, at, ending);
    if (behind_ > 0) {
      const std::size_t shared = behind_;
      const auto overlapping = parse_frame(input.subspan(at - shared));
      if (!overlapping) {
        news_in_ = bytes_until_news(input.subspan(at - shared));
        return at - shared;
      }
      deliver(*overlapping, find_message(*dialect_, *overlapping), shared, sink);
      at += overlapping->whole.size() - shared;
      continue;
    }
    const auto size = verdict.objection == SkipReason::noise ? find_start(rest.first(stop - at)) : 1;
    skip(rest.first(size), verdict.objection, sink);
    at += size;
  }
  // What follows the last frame is not known yet. Of its bytes, those are enough that may begin another one.
  if (ending != Ending::open) behind_ = 0;
  look_back(input, at, ending);
  news_in_ = behind_ > 0 ? 1 : 0;
  return at - behind_;
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

/// Looks among the `behind_` bytes before `at` for the beginning of a good frame of a known message that ends behind
/// `at`, and moves `behind_` to the first that is one or that needs more bytes. If there is none, `behind_` becomes 0.
void Parser::look_back(Bytes input, std::size_t at, Ending ending) {
  for (; behind_ > 0; --behind_) {
    behind_ -= static_cast<std::uint16_t>(find_start(input.subspan(at - behind_, behind_)));
    if (behind_ == 0) return;
    const auto frame = parse_frame(input.subspan(at - behind_));
    if (!frame && frame.error() == FrameError::incomplete && ending == Ending::open) return;
    if (!frame || frame->whole.size() <= behind_) continue;
    const auto* message = find_message(*dialect_, *frame);
    if (message != nullptr && judge_known(*frame, *message).claim == Claim::confirmed) return;
  }
}

/// The message of a frame if it is known and the checksum is right, otherwise nothing.
const MessageInfo* Parser::find_proven(const FrameView& frame) const {
  const auto* message = find_message(*dialect_, frame);
  return message != nullptr && checksum_matches(frame, message->crc_extra) ? message : nullptr;
}

Parser::Verdict Parser::judge_error(FrameError error, Ending ending) {
  if (error == FrameError::not_a_frame) return {Claim::refuted, SkipReason::noise};
  if (error == FrameError::unknown_flag) return {Claim::refuted, SkipReason::unknown_flag};
  if (error == FrameError::checksum) return {Claim::refuted, SkipReason::checksum};
  return {ending == Ending::open ? Claim::needs_bytes : Claim::refuted, SkipReason::truncated};
}

/// Whether a good frame of a known message lies wholly inside `place`.
bool Parser::holds_frame(Bytes place) const {
  if (place.size() < min_frame_size) return false;
  const auto starts = place.first(place.size() - min_frame_size + 1);
  for (auto at = find_start(starts); at < starts.size(); at += 1 + find_start(starts.subspan(at + 1))) {
    const auto frame = parse_frame(place.subspan(at));
    if (frame && find_proven(*frame) != nullptr) return true;
  }
  return false;
}

/// Whether the unknown message in the first `size` bytes of `input` is proven to be one. Whatever is decided from some
/// of the bytes, more bytes would not change; this is what makes the pieces of a stream irrelevant. While it needs more
/// of them, `news_in_` tells how many.
Parser::Claim Parser::judge_unknown(Bytes input, std::size_t size, Ending ending) {
  const auto window = ending == Ending::end ? input : input.first(std::min(input.size(), lookahead));
  news_in_ = static_cast<std::uint16_t>(lookahead - std::min(window.size(), lookahead));
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
Parser::Claim Parser::follow(Bytes window, std::size_t& end, Ending ending) {
  const bool is_full = window.size() == lookahead && ending != Ending::end;
  for (int link = 0; link < chain_limit; ++link) {
    if (end == window.size()) {
      if (ending == Ending::end) return Claim::confirmed;
      news_in_ = 0;
      return is_full ? Claim::refuted : Claim::needs_successor;
    }
    const auto next = parse_frame(window.subspan(end));
    if (!next) {
      const bool may_become_one = next.error() == FrameError::incomplete && ending == Ending::open && !is_full;
      if (!may_become_one) return Claim::refuted;
      news_in_ = std::min(news_in_, bytes_until_news(window.subspan(end)));
      return Claim::needs_bytes;
    }
    if (const auto* message = find_message(*dialect_, *next); message != nullptr)
      return checksum_matches(*next, message->crc_extra) ? Claim::confirmed : Claim::refuted;
    end += next->whole.size();
  }
  return Claim::refuted;
}

/// Refutes if a good frame of a known message begins between `settled` and `end`, and needs bytes if one that begins
/// there is still unfinished. Moves `settled` as far as no more bytes can change the answer.
Parser::Claim Parser::look_inside(Bytes window, std::size_t& settled, std::size_t end, Ending ending) {
  bool is_settled = true;
  for (auto at = settled; at < end; ++at) {
    at += find_start(window.first(end).subspan(at));
    if (at == end) break;
    if (is_settled) settled = at;
    const auto frame = parse_frame(window.subspan(at));
    if (frame && find_proven(*frame) != nullptr) return Claim::refuted;
    if (!frame && frame.error() == FrameError::incomplete && ending != Ending::end) {
      is_settled = false;
      news_in_ = std::min(news_in_, bytes_until_news(window.subspan(at)));
    }
  }
  if (!is_settled) return Claim::needs_bytes;
  settled = std::max(settled, end);
  return Claim::confirmed;
}

}  // namespace ponte::mavlink
