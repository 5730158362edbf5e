#include "common/load_file.hpp"
#include "vehicle/actions.hpp"
#include "vehicle/carry_out.hpp"

#include <CLI/CLI.hpp>

#include <memory>

/// The files on board, by MAVFTP.
namespace ponte::app {
namespace {

using autopilot::FileFact;
using autopilot::Voice;

template <class Begin>
FileFact ask(Operator& station, const std::string& action, Begin&& begin) {
  const auto fact = use_file(station, action, begin);
  if (fact.kind != FileFact::Kind::failed) return fact;
  const bool is_refused = fact.failure == autopilot::FileFailure::refused;
  station.give_up(action, is_refused ? std::string{to_text(fact.error)} : std::string{}, to_text(fact.failure));
}

void list(Operator& station, const std::string& path) {
  (void)ask(station, "files list " + path,
            [&](Voice voice) { return station.client().files().list(station.now(), path, voice); });
  for (const auto& each : station.client().files().entries()) {
    if (!station.wants_json()) {
      fmt::print("{:>10} {}{}\n", each.is_directory ? std::string{} : std::to_string(each.size), each.name,
                 each.is_directory ? "/" : "");
      continue;
    }
    station.json()
        .member("name", std::string_view{each.name})
        .member("directory", each.is_directory)
        .member("size", each.size);
    station.print();
  }
}

struct Transfer {
  std::string path;
  std::string file;
};

void get(Operator& station, const Transfer& transfer) {
  (void)ask(station, "files get " + transfer.path,
            [&](Voice voice) { return station.client().files().read(station.now(), transfer.path, voice); });
  save_file(transfer.file, station.client().files().content());
  station.tell_done("files get");
}

void put(Operator& station, const Transfer& transfer) {
  auto loaded = load_file(transfer.file);
  if (!loaded.damage.empty()) throw Failure{fmt::format("{}: {}", transfer.file, loaded.damage)};
  (void)ask(station, "files put " + transfer.path, [&](Voice voice) {
    return station.client().files().write(station.now(), transfer.path, loaded.bytes, voice);
  });
  station.tell_done("files put");
}

void add_path_action(CLI::App& files, Action& chosen, const char* name, const char* description,
                     const std::function<void(Operator&, const std::string&)>& act) {
  auto path = std::make_shared<std::string>();
  auto* action = files.add_subcommand(name, description);
  action->add_option("PATH", *path, "On board, e.g. @MISSION")->required();
  action->callback([&chosen, path, act] { chosen = [path, act](Operator& station) { act(station, *path); }; });
}

void add_transfer_action(CLI::App& files, Action& chosen, const char* name, const char* description,
                         void (*act)(Operator&, const Transfer&)) {
  auto transfer = std::make_shared<Transfer>();
  auto* action = files.add_subcommand(name, description);
  action->add_option("PATH", transfer->path, "On board, e.g. @MISSION/mission.dat")->required();
  action->add_option("FILE", transfer->file, "Here")->required();
  action->callback(
      [&chosen, transfer, act] { chosen = [transfer, act](Operator& station) { act(station, *transfer); }; });
}

}  // namespace

void add_file_actions(CLI::App& command, Action& chosen) {
  auto* files = command.add_subcommand("files", "Files on board, by MAVFTP");
  files->require_subcommand(1);
  add_path_action(*files, chosen, "list", "What a directory has", list);
  add_transfer_action(*files, chosen, "get", "Read one", get);
  add_transfer_action(*files, chosen, "put", "Write one", put);
  add_path_action(*files, chosen, "remove", "Remove one", [](Operator& station, const std::string& path) {
    (void)ask(station, "files remove " + path,
              [&](Voice voice) { return station.client().files().remove(station.now(), path, voice); });
    station.tell_done("files remove");
  });
  add_path_action(*files, chosen, "checksum", "CRC-32 of one, as MAVFTP has it",
                  [](Operator& station, const std::string& path) {
                    const auto fact = ask(station, "files checksum " + path, [&](Voice voice) {
                      return station.client().files().checksum(station.now(), path, voice);
                    });
                    if (!station.wants_json()) return fmt::print("{:08x}\n", fact.checksum);
                    station.json().member("path", std::string_view{path}).member("checksum", fact.checksum);
                    station.print();
                  });
}

}  // namespace ponte::app
