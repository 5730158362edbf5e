#include "common/dialect_option.hpp"

#include "common/failure.hpp"
#include "ponte/autopilot/dialect.hpp"
#include "ponte/definitions/model.hpp"

#include <filesystem>
#include <system_error>

namespace ponte::app {
namespace {

namespace fs = std::filesystem;

/// Of the XML files that come with the program.
std::vector<fs::path> installed_definitions() {
  std::error_code error;
  const auto program = fs::read_symlink("/proc/self/exe", error);
  if (error) return {};
  return {program.parent_path().parent_path() / "share/ponte/mavlink"};
}

reflection::DialectFile load(const std::string& file) {
  try {
    return reflection::load_dialect(file, installed_definitions());
  } catch (const definitions::DefinitionError& error) {
    throw Failure{error.what()};
  }
}

}  // namespace

void add_dialect_option(CLI::App& command, std::string& file) {
  command.add_option("--dialect", file,
                     "MAVLink XML with messages of your own; it may include common.xml and the like");
}

ChosenDialect::ChosenDialect(const std::string& file) : dialect_{autopilot::dialect} {
  if (file.empty()) return;
  own_.emplace(load(file));
  const auto& own = own_->dialect();
  dialect_.name = own.name;
  if (own.is_v09()) {
    messages_ = reflection::messages_of(own, *autopilot::dialect.v09);
    v09_ = {own.name, messages_};
    dialect_.v09 = &v09_;
  } else {
    messages_ = reflection::messages_of(own, autopilot::dialect);
    dialect_.messages = messages_;
    dialect_.low = {};  // of other messages
  }
}

}  // namespace ponte::app
