#pragma once

#include "ponte/core/time.hpp"
#include "ponte/vehicle/vocabulary.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

/// STATUSTEXT to alerts: severity, subsystem by keyword, and long texts put together from their chunks.
namespace ponte::autopilot {

/// MAV_SEVERITY 0 to 6 as an alert's severity; nothing for debug texts (7) and beyond.
[[nodiscard]] std::optional<vehicle::Condition> severity_of(std::uint8_t mav_severity);

struct KeywordRow {
  std::string_view keyword;  ///< in lower case
  vehicle::Subsystem subsystem;
};
/// Looked through in this order; the first keyword that stands in a text as a word of its own decides.
[[nodiscard]] std::span<const KeywordRow> keyword_rows();
[[nodiscard]] vehicle::Subsystem subsystem_of(std::string_view text);

/// Puts chunks of one sender together. A text is complete with the chunk that is shorter than 50 characters, or when a
/// new text begins, or after `chunk_patience` without the next chunk: then it is told as far as it came.
class StatusTextAssembler {
 public:
  static constexpr std::chrono::seconds chunk_patience{1};

  /// `text`: up to 50 characters. `id` 0: a text of one chunk.
  template <class Sink>
  void on_chunk(Timestamp now, std::uint8_t severity, std::uint16_t id, std::uint8_t chunk, std::string_view text,
                Sink&& sink) {
    const bool continues = pending_ && id != 0 && id == id_ && chunk == next_chunk_;
    if (!continues) finish(sink);
    if (!pending_) begin(severity, id, chunk);
    append(now, text);
    constexpr std::size_t whole_chunk = 50;
    if (id == 0 || text.size() < whole_chunk) finish(sink);
  }

  template <class Sink>
  void on_tick(Timestamp now, Sink&& sink) {
    if (pending_ && now - last_ >= chunk_patience) finish(sink);
  }

  /// Tells what is still incomplete, e.g. at the end of a recording. The sink gets a `vehicle::Alert`.
  template <class Sink>
  void finish(Sink&& sink) {
    if (const auto alert = take()) sink(*alert);
  }

  [[nodiscard]] std::optional<Timestamp> next_deadline() const {
    if (!pending_) return std::nullopt;
    return last_ + chunk_patience;
  }

 private:
  void begin(std::uint8_t severity, std::uint16_t id, std::uint8_t chunk);
  void append(Timestamp now, std::string_view text);
  std::optional<vehicle::Alert> take();

  bool pending_{};
  std::uint8_t severity_{};
  std::uint16_t id_{};
  std::uint8_t next_chunk_{};
  Timestamp last_{};
  std::size_t size_{};
  std::array<char, 256> text_{};
};

}  // namespace ponte::autopilot
