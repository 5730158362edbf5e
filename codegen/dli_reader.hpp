#pragma once

#include "ponte/definitions/model.hpp"

namespace ponte::codegen {

using namespace definitions;

/// Reads every *.toml of a folder of DLI definitions (definitions/dli/README.md explains the columns).
/// Throws `DefinitionError`, also for a key that is not known, so that a slip of the pen is not passed over.
[[nodiscard]] Protocol read_dli(const std::filesystem::path& folder);

/// The same from one text, for tests and fuzzing. Enumerations and messages may stand in any order.
[[nodiscard]] Protocol read_dli_text(std::string_view text, const std::filesystem::path& name);

}  // namespace ponte::codegen
