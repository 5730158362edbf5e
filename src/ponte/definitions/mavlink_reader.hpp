#pragma once

#include "ponte/definitions/model.hpp"

namespace ponte::definitions {

/// Reads a MAVLink XML dialect with everything it includes: messages by id, enumerations merged by name. An include is
/// looked for beside the file that names it, then in `search_path`. A `<message extend="true">` (our own attribute, for
/// definitions/mavlink/additions.xml) appends extension fields to a message that is defined elsewhere.
/// Wire order, offsets and crc_extra are computed as https://mavlink.io/en/guide/serialization.html says.
/// `<mavlink wire="0.9">` (ours too) makes it a dialect of MAVLink 0.9, with that version's wire rules.
/// Throws `DefinitionError`.
[[nodiscard]] Protocol read_mavlink(const std::filesystem::path& file,
                                    const std::vector<std::filesystem::path>& search_path);

/// The same from one text, for tests and fuzzing. There are no files, so an include is refused.
[[nodiscard]] Protocol read_mavlink_text(std::string_view text, const std::filesystem::path& name);

/// The order in which fields travel: base fields by element size, largest first, then the extensions as defined.
/// The numbers are indices into `message.fields`.
[[nodiscard]] std::vector<std::size_t> wire_order(const Message& message);

}  // namespace ponte::definitions
