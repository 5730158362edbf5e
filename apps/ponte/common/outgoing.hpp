#pragma once

#include "ponte/core/json_text.hpp"
#include "ponte/dli/profile.hpp"
#include "ponte/dli/wrapper.hpp"
#include "ponte/vsm/telemetry.hpp"

/// What the VSM sends, read back as its receivers read it.
namespace ponte::app {

/// The only message of that datagram, a view into it.
[[nodiscard]] dli::WrapperView view_of(const vsm::OutgoingMessage& message, const dli::Profile& profile);

/// Appends it as the JSON object of every DLI message.
void append_json(JsonText& json, const vsm::OutgoingMessage& message, const dli::Profile& profile);

}  // namespace ponte::app
