#pragma once

#include "ponte/core/result.hpp"
#include "ponte/transport/file_descriptor.hpp"
#include "ponte/transport/link.hpp"

#include <functional>
#include <memory>
#include <string>

namespace ponte::transport {

/// A terminal device that may come and go.
struct Device {
  std::string endpoint;  ///< the name of the link
  std::string name;      ///< of what is at the other end
  /// One attempt, which does not wait. It is destroyed as soon as the link is. The error is one line with the name.
  std::function<Result<FileDescriptor, std::string>()> open;
  std::string description_of_loss;  ///< one line for when it has gone, e.g. "/dev/ttyACM0 was unplugged"
};

[[nodiscard]] std::unique_ptr<Link> make_device_link(Loop& loop, Device device, LinkHandler& handler,
                                                     const LinkOptions& options);

}  // namespace ponte::transport
