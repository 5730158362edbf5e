#include "ponte/transport/addresses.hpp"

#include <algorithm>

namespace ponte::transport {

asio::awaitable<Result<std::vector<asio::ip::address>, std::string>> resolve(std::string host) {
  error_code error;
  const auto numeric = asio::ip::make_address(host, error);
  if (!error) co_return std::vector{numeric};

  asio::ip::udp::resolver resolver{co_await asio::this_coro::executor};
  auto token = asio::redirect_error(asio::use_awaitable, error);
  const auto found = co_await resolver.async_resolve(host, "", token);
  if (error) co_return fail("cannot find the host " + host + ": " + error.message());
  std::vector<asio::ip::address> addresses;
  for (const auto& entry : found) addresses.push_back(entry.endpoint().address());
  std::ranges::stable_partition(addresses, [](const auto& address) { return address.is_v4(); });
  co_return addresses;
}

}  // namespace ponte::transport
