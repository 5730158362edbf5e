#pragma once

#include "ponte/core/bytes.hpp"
#include "ponte/core/time.hpp"
#include "ponte/mavlink/frame.hpp"
#include "ponte/mavlink/message_info.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace ponte::mavlink {

/// Why a byte is not part of a frame.
enum class SkipReason : std::uint8_t {
  noise,         ///< not a start byte
  checksum,      ///< a start byte, but the checksum of the frame behind it is wrong
  unknown_flag,  ///< a start byte, but with incompatibility flags that we do not understand
  truncated,     ///< a start byte, but within the frame the datagram ends, the sender falls silent, or the next begins
  unconfirmed,   ///< a start byte, but of a message that is not in the dialect, in a place where no frame is proven
};
inline constexpr std::size_t skip_reason_count = 5;

/// What a parser has seen since it was made. Nothing here ever goes down.
struct ParserCounters {
  std::uint64_t bytes{};           ///< in frames or skipped; bytes that wait for a decision are not in it yet
  std::uint64_t frames{};          ///< delivered, those of unknown messages included
  std::uint64_t unknown_frames{};  ///< delivered without a known message
  std::uint64_t overlaps{};        ///< delivered although they begin inside the frame before: at most one is intact
  /// Bytes by reason. Each reason but `noise` takes exactly the one byte of the false start, so it counts false starts.
  std::array<std::uint64_t, skip_reason_count> skipped{};

  friend bool operator==(const ParserCounters&, const ParserCounters&) = default;
};

/// Receives what a parser finds, in the order of the bytes. Every byte fed ends up in exactly one call, but for those
/// that two frames share. Views are valid during the call only, and the parser must not be fed from within it.
class FrameSink {
 public:
  virtual ~FrameSink() = default;
  /// `message` is nothing if the dialect does not know the message: then the checksum could not be examined.
  virtual void on_frame(const FrameView& frame, const MessageInfo* message) = 0;
  /// The frame that comes next begins so many bytes before the end of the last one.
  virtual void on_overlap(std::size_t /*shared*/) {}
  /// One run of bytes may arrive in several calls.
  virtual void on_skipped(Bytes /*run*/, SkipReason /*reason*/) {}
};

/// Finds the frames in what one link delivers, as a stream in pieces of any size, or as datagrams.
///
/// - After a false start it goes on with the next byte, so that noise never costs an intact frame.
/// - A frame of a known message is delivered at once, but only with the right checksum, and only if no other one lies
///   inside it where none can belong: in the signature, which the checksum does not cover, or anywhere if the length is
///   none that the message can have.
/// - A checksum may be right by chance, and a signature may have lost bytes; such a frame takes the first bytes of the
///   next one along. Therefore, where no good frame follows a frame of a known message, a good one that begins inside
///   it and ends behind it is delivered too.
/// - A frame of an unknown message is delivered only if it ends where the datagram ends or where the next good frame
///   begins (known with the right checksum, or unknown and proven in this way too), and if no good frame of a known
///   message begins inside it. In a stream the proof must be found within `lookahead` bytes.
/// - How a stream is cut into pieces makes no difference; only silence between them does.
///
/// Frames that lie wholly within a piece of more than `max_frame_size` bytes are delivered as views into that piece. It
/// allocates nothing.
class Parser {
 public:
  /// A frame that stays unfinished for so long is a false start.
  static constexpr Duration silence_limit = std::chrono::milliseconds{50};
  /// From the beginning of a frame of an unknown message, itself included. A parser never holds more bytes than these
  /// and the frame before.
  static constexpr std::size_t lookahead = 2 * max_frame_size;

  /// The dialect must outlive the parser.
  explicit Parser(const Dialect& dialect) : dialect_{&dialect} {}

  /// The next piece of a stream. Notices by itself that silence came before it.
  void on_bytes(Timestamp now, Bytes bytes, FrameSink& sink) {
    on_tick(now, sink);
    if (bytes.empty()) return;
    if (held_size_ + bytes.size() <= quiet_size_)
      take(now, bytes);
    else
      decide(now, bytes, sink);
  }
  /// Silence, once `next_deadline` has come: gives up a frame that stayed unfinished, and finds those hidden behind it.
  void on_tick(Timestamp now, FrameSink& sink) {
    if (deadline_ <= now) [[unlikely]]
      give_up(sink);
  }
  /// How many more bytes of a stream have to come, at least, before anything can be delivered. One more may be enough
  /// for a decision that delivers nothing.
  [[nodiscard]] std::size_t bytes_needed() const;
  /// When `on_tick` next has something to do; nothing while no frame is unfinished.
  [[nodiscard]] std::optional<Timestamp> next_deadline() const {
    return deadline_ == never ? std::nullopt : std::optional{deadline_};
  }
  /// The end of a stream, which decides everything, like the end of a datagram.
  void finish(FrameSink& sink);

  /// A whole datagram. What a stream had left undecided before it, is decided first.
  void on_datagram(Bytes datagram, FrameSink& sink);

  [[nodiscard]] const ParserCounters& counters() const { return counters_; }

 private:
  /// What is known of the bytes behind those at hand.
  enum class Ending : std::uint8_t { open, silence, end };
  enum class Claim : std::uint8_t { confirmed, refuted, needs_bytes, needs_successor };
  struct Verdict {
    Claim claim{};
    SkipReason objection{};  ///< if it is refuted
  };

  /// Keeps bytes that tell nothing, which is most of them when they come one by one.
  void take(Timestamp now, Bytes bytes) {
    if (bytes.size() == 1)
      held_[held_size_] = bytes[0];
    else
      std::copy(bytes.begin(), bytes.end(), held_.begin() + held_size_);
    held_size_ += static_cast<std::uint16_t>(bytes.size());
    deadline_ = now + silence_limit;
  }

  void decide(Timestamp now, Bytes bytes, FrameSink& sink);
  void give_up(FrameSink& sink);
  std::size_t consume(Bytes input, std::size_t stop, Ending ending, FrameSink& sink);
  Bytes consume_held(Bytes bytes, FrameSink& sink);
  void keep(Bytes tail);
  void deliver(const FrameView& frame, const MessageInfo* message, std::size_t shared, FrameSink& sink);
  void skip(Bytes run, SkipReason reason, FrameSink& sink);
  void look_back(Bytes input, std::size_t at, Ending ending);
  const MessageInfo* find_proven(const FrameView& frame) const;
  static Verdict judge_error(FrameError error, Ending ending);
  Verdict judge_known(const FrameView& frame, const MessageInfo& message) const;
  bool holds_frame(Bytes place) const;
  Claim judge_unknown(Bytes input, std::size_t size, Ending ending);
  Claim follow(Bytes window, std::size_t& end, Ending ending);
  Claim look_inside(Bytes window, std::size_t& settled, std::size_t end, Ending ending);

  static constexpr Timestamp never = Timestamp::max();

  const Dialect* dialect_;
  ParserCounters counters_;
  // Counted like counters_.bytes: no good frame of a known message begins between the present position and this one.
  // It spares the bytes inside one unknown frame after the other from being examined again and again.
  std::uint64_t searched_until_{};
  Timestamp deadline_{never};
  std::uint16_t news_in_{};     // so many more bytes decide nothing but the last of them; 0: no frame is unfinished
  std::uint16_t quiet_size_{};  // as long as no more bytes are held, there is nothing to decide
  // The bytes before the present position that belong to a frame whose successor is not known yet. They are still at
  // hand, since another frame may turn out to begin among them.
  std::uint16_t behind_{};
  std::uint16_t held_size_{};
  std::array<std::byte, max_frame_size + lookahead> held_;  // those bytes, and the ones not yet decided on
};
static_assert(sizeof(Parser) < 1024);

}  // namespace ponte::mavlink
