#include "common/dialect_option.hpp"

#include "common/failure.hpp"
#include "ponte/definitions/model.hpp"
#include "ponte/mavlink/autopilots/dialect.hpp"

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

ChosenDialect::ChosenDialect(const std::string& file) : dialect_{mavlink::autopilots::dialect} {
  if (file.empty()) return;
  own_.emplace(load(file));
  messages_ = reflection::messages_of(own_->dialect(), mavlink::autopilots::dialect);
  dialect_ = {own_->dialect().name, messages_};
}

}  // namespace ponte::app
