#pragma once

#include "ponte/core/bytes.hpp"
#include "ponte/sim/mission_store.hpp"
#include "ponte/sim/parameters.hpp"

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

/// The files that ArduPilot makes up: its missions, fences, rally points and parameters.
namespace ponte::sim {

class VirtualFiles {
 public:
  /// Both outlive it.
  VirtualFiles(MissionStore& missions, const Parameters& parameters) : missions_{missions}, parameters_{parameters} {}

  /// The most bytes that a file has.
  [[nodiscard]] std::size_t largest() const;
  /// Writes the file into `content`, which has room for the largest; false if there is none of this path.
  [[nodiscard]] bool read(std::string_view path, std::vector<std::byte>& content) const;
  [[nodiscard]] bool may_write(std::string_view path) const;
  /// Takes over what was written, as a whole; false if it is not such a file, or has an item that is refused.
  [[nodiscard]] bool write(std::string_view path, Bytes content);

  /// The entry of a directory with this number, as MAVFTP lists it ("Fmission.dat\t10", without the NUL); nothing after
  /// the last. `directory_exists` tells an empty directory from none.
  [[nodiscard]] bool directory_exists(std::string_view path) const;
  [[nodiscard]] bool append_entry(std::string_view directory, std::size_t number,
                                  std::vector<std::byte>& listing) const;

 private:
  [[nodiscard]] std::size_t size_of(PlanType type) const;
  void read_plan(PlanType type, std::vector<std::byte>& content) const;
  void read_parameters(std::string_view options, std::vector<std::byte>& content) const;

  MissionStore& missions_;
  const Parameters& parameters_;
};

}  // namespace ponte::sim
