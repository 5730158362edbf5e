#pragma once

#include "ponte/definitions/model.hpp"

/// The committed table of what every message looks like on the wire, so that a definition package cannot change under
/// us: one line `id crc_extra base_length full_length NAME` per message, ascending.
namespace ponte::codegen {

using namespace definitions;

[[nodiscard]] std::string digest_of(const Protocol& protocol);

/// Throws `DefinitionError` that names the messages in which `protocol` and the digest file differ: the first 20, and
/// how many there are.
void check_digest(const Protocol& protocol, const std::filesystem::path& digest_file);

}  // namespace ponte::codegen
