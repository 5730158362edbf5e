#pragma once

#include "ponte/core/result.hpp"
#include "ponte/transport/link.hpp"

#include <memory>
#include <string>

namespace ponte::transport {

/// Makes a pseudo terminal, which other programs open by `path` as they would a serial port at any baud rate. The link
/// is our end: up while somebody has the port open, down otherwise, when what is sent is dropped. Destroying it is
/// pulling the plug: who has the port open sees it vanish, and `path` is gone.
///
/// `path` becomes a symbolic link. One that is already there and points to a pseudo terminal, as after a crash, is
/// replaced; anything else that is in the way is an error. `options` gives the queue only. The loop and the handler
/// outlive the link.
[[nodiscard]] Result<std::unique_ptr<Link>, OpenError> open_pty(Loop& loop, const std::string& path,
                                                                LinkHandler& handler, const LinkOptions& options = {});

}  // namespace ponte::transport
