#pragma once

#include "ponte/dli/message_info.hpp"
#include "ponte/dli/profile.hpp"
#include "ponte/mavlink/message_info.hpp"

#include <string>

namespace ponte::app {

/// The Catalogue of web/contract/openapi.yaml: messages and fields of both protocols, and the rules between them.
[[nodiscard]] std::string catalogue_json(const mavlink::Dialect& dialect, const dli::Catalogue& catalogue,
                                         const dli::Profile& profile);

}  // namespace ponte::app
