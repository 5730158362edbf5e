// Writes the mapping tables as a Markdown page: every row of the code, in words.

#include "ponte/autopilot/modes.hpp"
#include "ponte/autopilot/status_text.hpp"
#include "ponte/autopilot/subsystem_health.hpp"
#include "ponte/autopilot/vehicle_monitor.hpp"
#include "ponte/dlisession/status_messages.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <span>

namespace {

using namespace ponte;

template <class Names>
std::string joined(const Names& names) {
  std::string text;
  for (const auto name : names) {
    if (name.empty()) continue;
    if (!text.empty()) text += ", ";
    text += name;
  }
  return text;
}

std::string text_to_dli() {
  std::string text = "## What becomes of it: vehicle to DLI\n";
  const dli::MessageInfo* message = nullptr;
  for (const auto& row : dlisession::status_row_texts()) {
    if (row.message != message) {
      message = row.message;
      text += fmt::format("\n### #{} {}\n\n| field | from | rule | unit | reference |\n|---|---|---|---|---|\n",
                          message->number.value, message->name);
    }
    text += fmt::format("| {} {} | {} | {} | {} | {} |\n", row.field->number, row.field->name, joined(row.sources),
                        row.rule, row.field->unit, row.reference);
  }
  return text + "\n#16002 Heartbeat Message has only its time stamp.\n\n";
}

std::string text_of_rows(std::string_view version, std::span<const autopilot::RowText> rows) {
  std::string text;
  std::string_view message;
  for (const auto& row : rows) {
    if (row.message != message) {
      message = row.message;
      text += fmt::format("\n### {}{}\n\n| fact | from | rule | unit | rank | reference |\n|---|---|---|---|---|---|\n",
                          version, message);
    }
    text += fmt::format("| {} | {} | {} | {} | {} | {} |\n", row.target, joined(row.sources), row.rule, row.unit,
                        row.rank, row.reference);
  }
  return text + '\n';
}

std::string text_from_mavlink() {
  return "## What is known: MAVLink to vehicle\n\nRank 0 is the best source; a worse one is listened to when "
         "the better has been silent for two seconds.\n" +
         text_of_rows("", autopilot::telemetry_row_texts()) + "## The same: MAVLink 0.9 to vehicle\n" +
         text_of_rows("MAVLink 0.9 ", autopilot::telemetry_row_texts_v09());
}

std::string text_of_modes() {
  constexpr std::array stacks{std::pair{autopilot::Stack::ardupilot_copter, "ArduCopter"},
                              std::pair{autopilot::Stack::ardupilot_plane, "ArduPlane"},
                              std::pair{autopilot::Stack::px4, "PX4"}};
  std::string text =
      "## Modes\n\nHEARTBEAT.custom_mode. AUTO counts as landing while ArduPlane flies NAV_LAND, and as "
      "take-off while ArduCopter flies NAV_TAKEOFF.\n";
  for (const auto& [stack, name] : stacks) {
    text += fmt::format("\n### {}\n\n| custom_mode | name | meaning |\n|---|---|---|\n", name);
    for (const auto& row : autopilot::modes_of(stack))
      text += fmt::format("| {0} (0x{0:08x}) | {1} | {2} |\n", row.custom_mode, row.name, vehicle::name_of(row.kind));
  }
  return text + '\n';
}

std::string text_of_health() {
  std::string text =
      "## Subsystems\n\nBits of SYS_STATUS.onboard_control_sensors_*: fitted, enabled and unhealthy is the "
      "condition named.\n\n| bit | sensor | subsystem | unhealthy is |\n|---|---|---|---|\n";
  for (const auto& row : autopilot::sensor_rows())
    text += fmt::format("| {} | {} | {} | {}{} |\n", row.bit, row.name, vehicle::name_of(row.subsystem),
                        vehicle::name_of(row.when_unhealthy),
                        row.excused_by == autopilot::no_excuse
                            ? std::string{}
                            : fmt::format("; caution while bit {} is healthy", row.excused_by));
  text +=
      "\n## Words in STATUSTEXT\n\nThe first that stands in a text decides on its subsystem; without one it is vsm.\n\n"
      "| word | subsystem |\n|---|---|\n";
  for (const auto& row : autopilot::keyword_rows())
    text += fmt::format("| {} | {} |\n", row.keyword, vehicle::name_of(row.subsystem));
  return text;
}

}  // namespace

int main() {
  fmt::print(
      "# MAVLink to STANAG 4586\n\nMade from the rows that the program runs: `src/ponte/autopilot/telemetry_rows.hpp` "
      "and `src/ponte/dlisession/status_rows.hpp`. References are to the team's mapping facts. The mapping is our "
      "proposal; units and scales are those of `dli-messages.md`.\n\n{}{}{}{}",
      text_from_mavlink(), text_to_dli(), text_of_modes(), text_of_health());
  return std::fflush(stdout) == 0 ? 0 : 1;
}
