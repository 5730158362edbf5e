#include "codegen/digest.hpp"
#include "codegen/dli_reader.hpp"
#include "codegen/emit.hpp"
#include "ponte/definitions/mavlink_reader.hpp"
#include "ponte/definitions/names.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <fstream>

namespace ponte::codegen {
namespace {

struct Options {
  std::filesystem::path input;
  std::string name;
  std::filesystem::path output;
  std::filesystem::path reference;
  std::filesystem::path digest;
  std::filesystem::path new_digest;
  std::vector<std::filesystem::path> search_path;
  bool bare{};
};

void write_text(const std::filesystem::path& path, const std::string& text) {
  if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path());
  std::ofstream file{path, std::ios::binary};
  file << text;
  file.close();
  if (!file) throw DefinitionError{{path, 0}, "cannot be written"};
}

void generate_mavlink(const Options& options) {
  auto protocol = read_mavlink(options.input, options.search_path);
  if (!options.name.empty()) protocol.name = options.name;
  if (!options.new_digest.empty()) write_text(options.new_digest, digest_of(protocol));
  if (!options.digest.empty()) check_digest(protocol, options.digest);
  if (!options.output.empty()) write_files(emit_mavlink(protocol, !options.bare), options.output);
  if (!options.reference.empty()) write_text(options.reference, emit_mavlink_reference(protocol, !options.bare));
}

void generate_dli(const Options& options) {
  const auto protocol = read_dli(options.input);
  if (!options.output.empty()) write_files(emit_dli(protocol), options.output);
  if (!options.reference.empty()) write_text(options.reference, emit_dli_reference(protocol));
}

}  // namespace
}  // namespace ponte::codegen

int main(int argc, char** argv) {
  using namespace ponte::codegen;
  Options options;
  CLI::App app{"Turns message definitions into C++"};
  app.require_subcommand(1);

  auto* mavlink = app.add_subcommand("mavlink", "A MAVLink XML dialect");
  mavlink->add_option("--input", options.input, "The dialect's XML file")->required();
  mavlink->add_option("--name", options.name, "Name of the dialect and its namespace; default: that of the file")
      ->check(CLI::Validator{
          [](const std::string& name) { return is_identifier(name) ? "" : "'" + name + "' is not an identifier"; },
          "IDENTIFIER"});
  mavlink->add_option("--include-dir", options.search_path, "Where included files are looked for");
  mavlink->add_option("--output", options.output, "Folder for the generated files");
  mavlink->add_option("--reference", options.reference, "Markdown page of all messages");
  mavlink->add_option("--digest", options.digest, "Table that the messages must agree with");
  mavlink->add_option("--write-digest", options.new_digest, "Write that table anew");
  mavlink->add_flag("--no-descriptions", options.bare, "Leave out the texts of the definition");
  mavlink->callback([&] { generate_mavlink(options); });

  auto* dli = app.add_subcommand("dli", "Our STANAG 4586 definitions");
  dli->add_option("--input", options.input, "Folder of the definition files")->required();
  dli->add_option("--output", options.output, "Folder for the generated files");
  dli->add_option("--reference", options.reference, "Markdown page of all tables");
  dli->callback([&] { generate_dli(options); });

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
  return 0;
}
