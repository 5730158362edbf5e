#include "common/endpoint_option.hpp"

#include "common/failure.hpp"

#include <fmt/format.h>

namespace ponte::app {

transport::Endpoint endpoint_from(const std::string& option, const std::string& text) {
  auto endpoint = transport::parse_endpoint(text);
  if (!endpoint)
    throw UsageError{
        fmt::format("{} {}: {}\n{}", option, text, transport::to_text(endpoint.error()), transport::endpoint_grammar)};
  return *endpoint;
}

}  // namespace ponte::app
