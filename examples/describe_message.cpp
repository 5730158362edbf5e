// describe_message FILE.xml MESSAGE [FOLDER...]: the fields of a message that this program was not compiled with. What
// the file includes is looked for beside it and in the folders.
#include "ponte/definitions/model.hpp"
#include "ponte/reflection/dialect_file.hpp"

#include <cstdio>
#include <string>
#include <string_view>

int main(int argc, char** argv) {
  using namespace ponte;
  if (argc < 3) return 2;
  try {
    const auto file = reflection::load_dialect(argv[1], {argv + 3, argv + argc});
    const auto* message = file.dialect().find(std::string_view{argv[2]});
    if (message == nullptr) {
      std::printf("%s has no message %s\n", argv[1], argv[2]);
      return 1;
    }
    std::printf("%s, id %u, %d bytes\n", argv[2], message->id.value, message->full_length);
    for (const auto& field : message->fields) {
      std::printf("  %s [%s]", std::string{field.name}.c_str(), std::string{field.unit}.c_str());
      if (field.enumeration != nullptr)
        for (const auto& entry : field.enumeration->entries) std::printf(" %s", std::string{entry.name}.c_str());
      std::printf("\n");
    }
  } catch (const definitions::DefinitionError& error) {
    std::printf("%s\n", error.what());
    return 1;
  }
}
