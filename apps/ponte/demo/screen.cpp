#include "demo/screen.hpp"

#include "ponte/core/assert.hpp"
#include "ponte/core/hex.hpp"
#include "ponte/dli/messages/inertial_states.hpp"
#include "ponte/dli/wrapper.hpp"
#include "ponte/mavlink/frame.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

namespace ponte::app {
namespace {

using Lines = std::vector<std::string>;

constexpr std::size_t column_width = 39;
// Where things stand on both sides, from 1.
constexpr std::size_t angles_line = 9;
constexpr std::size_t last_line = 15;
constexpr std::size_t header_bytes_per_line = 8;

double degrees(double radians) { return radians * 180 / std::numbers::pi; }
double microseconds(Duration time) { return std::chrono::duration<double, std::micro>(time).count(); }

/// The bytes in hex and below in decimal, in lines that fit.
void append_bytes(Lines& lines, Bytes bytes) {
  for (std::size_t at = 0; at < bytes.size(); at += header_bytes_per_line) {
    const auto piece = bytes.subspan(at, std::min(header_bytes_per_line, bytes.size() - at));
    std::string hex;
    std::string decimal;
    for (const auto byte : piece) {
      hex += fmt::format("{:>4}", fmt::format("{:02x}", std::to_integer<unsigned>(byte)));
      decimal += fmt::format("{:>4}", std::to_integer<unsigned>(byte));
    }
    lines.push_back("  hex" + hex);
    lines.push_back("  dec" + decimal);
  }
}

Lines mavlink_side(const AttitudePair& pair) {
  const auto frame = mavlink::parse_frame(pair.frame);
  PONTE_ASSERT(frame.has_value());
  Lines lines;
  lines.push_back(fmt::format("ATTITUDE (#{}), MAVLink {}, {} bytes", frame->message.value,
                              to_text(frame->version), frame->whole.size()));
  lines.push_back(fmt::format("system {}, component {}, sequence {}", frame->system.value, frame->component.value,
                              frame->sequence));
  lines.emplace_back("header");
  append_bytes(lines, frame->whole.first(mavlink::header_size(frame->version)));
  lines.resize(angles_line - 1);
  lines.push_back(fmt::format("{:<6}{:>12}{:>14}", "", "rad", "degrees"));
  for (std::size_t i = 0; i < angle_names.size(); ++i)
    lines.push_back(
        fmt::format("{:<6}{:>12.6f}{:>14.4f}", angle_names[i], pair.radians[i], degrees(double{pair.radians[i]})));
  lines.resize(last_line);
  lines.push_back(fmt::format("decoded after {:.1f} us", microseconds(pair.decoded)));
  return lines;
}

std::string bits(Bytes bytes) {
  std::string text;
  for (const auto byte : bytes) text += fmt::format(" {:08b}", std::to_integer<unsigned>(byte));
  return text;
}

Lines dli_side(const AttitudePair& pair, const dli::Profile& profile) {
  using dli::messages::InertialStates;
  const Bytes whole{pair.message};
  const auto message = dli::parse_message(whole, profile);
  PONTE_ASSERT(message.has_value());
  const auto vector = message->data.first(profile.presence_bytes_of(InertialStates::info));
  Lines lines;
  lines.push_back(fmt::format("#{} {}, {} bytes", message->number.value, InertialStates::info.name_in(profile.edition),
                              dli::name_of(profile.edition), whole.size()));
  lines.push_back(fmt::format("from {} to {}", to_text(message->source).view(), to_text(message->destination).view()));
  lines.emplace_back("wrapper");
  append_bytes(lines, whole.first(dli::wrapper_size));
  lines.resize(angles_line - 1);
  lines.push_back(fmt::format("{:<6}{:>7}{:>6}{:>10}{:>10}", "", "BAM", "hex", "x 180 deg", "degrees"));
  for (std::size_t i = 0; i < angle_names.size(); ++i) {
    constexpr double half_turn = 32'768;
    const auto raw = pair.bam[i];
    if (raw)
      lines.push_back(fmt::format("{:<6}{:>7}{:>6}{:>10.6f}{:>10.4f}", angle_names[i], *raw,
                                  fmt::format("{:04x}", static_cast<std::uint16_t>(*raw)), *raw / half_turn,
                                  *raw / half_turn * 180));
    else
      lines.push_back(fmt::format("{:<6}{:>7}", angle_names[i], "absent"));
  }
  lines.emplace_back();
  lines.push_back(fmt::format("presence  {}", to_hex(vector, " ")));
  lines.push_back(fmt::format("         {}", bits(vector)));
  lines.push_back(
      fmt::format("translated {:.1f} us, sent {:.1f} us", microseconds(pair.translated), microseconds(pair.sent)));
  return lines;
}

}  // namespace

std::string demo_screen(const TwoSides& sides, const DemoStatus& status) {
  Lines left{"waiting for ATTITUDE ..."};
  Lines right;
  if (const auto& pair = sides.shown()) {
    left = mavlink_side(*pair);
    if (!pair->message.empty()) right = dli_side(*pair, sides.profile());
  }
  if (!status.converts) right = {"conversion is off"};
  const auto& counts = sides.counts();
  std::string text = fmt::format("ponte demo   vehicle on {}   conversion {}\nThe bridge page is at {}\n",
                                 status.vehicle, status.converts ? "ON" : "OFF", status.page);
  text += fmt::format("{:<{}}| {}\n", "MAVLink", column_width, "STANAG 4586");
  text += std::string(column_width, '-') + "+" + std::string(column_width, '-') + "\n";
  for (std::size_t i = 0; i < std::max({left.size(), right.size(), last_line + 1}); ++i)
    text += fmt::format("{:<{}}| {}\n", i < left.size() ? left[i] : "", column_width, i < right.size() ? right[i] : "");
  text += std::string(2 * column_width + 1, '-') + "\n";
  text += fmt::format("{} frames, {} attitudes | {} DLI messages | {} compared, {} differ\n", counts.frames,
                      counts.attitudes, counts.messages, counts.compared, counts.different);
  if (counts.compared > 0)
    text += fmt::format("conversion adds {:.1f} us on average, {:.1f} us at most\n",
                        microseconds(counts.delay_sum) / static_cast<double>(counts.compared),
                        microseconds(counts.delay_max));
  else
    text += "\n";
  return text + "keys: c conversion on or off, q quit\n";
}

std::string demo_summary(const DemoCounts& counts) {
  auto text = fmt::format("MAVLink      {} frames, {} attitudes\n", counts.frames, counts.attitudes);
  text += fmt::format("STANAG 4586  {} messages heard by the station\n", counts.messages);
  text += fmt::format("compared     {} attitudes, {} differ by more than one unit, the largest difference is {}\n",
                      counts.compared, counts.different, counts.largest_difference);
  if (counts.not_heard > 0) text += fmt::format("lost         {} messages between VSM and station\n", counts.not_heard);
  if (counts.compared > 0)
    text += fmt::format("conversion   adds {:.1f} us on average, {:.1f} us at most (decoded to sent)\n",
                        microseconds(counts.delay_sum) / static_cast<double>(counts.compared),
                        microseconds(counts.delay_max));
  return text;
}

}  // namespace ponte::app
