#include "ponte/transport/endpoint.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <utility>
#include <vector>

namespace ponte::transport {
namespace {

constexpr std::uint32_t baud_max = 4'000'000;
constexpr std::size_t host_size_max = 253;
constexpr std::size_t interface_size_max = 15;  // IFNAMSIZ, less the NUL
constexpr double speed_min = 0.01;
constexpr double speed_max = 1000;

/// A part of the text and where it stands.
struct Part {
  std::string_view text;
  std::size_t position{};

  [[nodiscard]] Part first(std::size_t size) const { return {text.substr(0, size), position}; }
  [[nodiscard]] Part from(std::size_t offset) const { return {text.substr(offset), position + offset}; }
  [[nodiscard]] Part end() const { return from(text.size()); }
};

auto refuse(Part part, std::string expectation) {
  return fail(EndpointError{std::string{part.text}, part.position, std::move(expectation)});
}

template <class Number>
std::optional<Number> number_in(std::string_view text) {
  Number number{};
  const auto* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc{} || stop != end) return {};
  return number;
}

// Not <cctype>: what an endpoint is does not depend on a locale.
bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }
bool is_in_host_names(char c) { return is_letter(c) || is_digit(c) || c == '-' || c == '.' || c == '_'; }

std::optional<in_addr> ipv4(std::string_view text) {
  in_addr address{};
  if (inet_pton(AF_INET, std::string{text}.c_str(), &address) != 1) return {};
  return address;
}

std::optional<in6_addr> ipv6(std::string_view text) {
  in6_addr address{};
  if (inet_pton(AF_INET6, std::string{text}.c_str(), &address) != 1) return {};
  return address;
}

bool is_interface_name(std::string_view text) {
  return !text.empty() && text.size() <= interface_size_max &&
         std::ranges::none_of(text, [](char c) { return c == '/' || c == ' ' || c == ':' || c == '%' || c == ']'; });
}

/// IPv6 with the interface that a link-local address needs, as in fe80::1%eth0.
bool is_scoped_ipv6(std::string_view text) {
  const auto percent = text.find('%');
  if (percent == std::string_view::npos) return ipv6(text).has_value();
  return ipv6(text.substr(0, percent)) && is_interface_name(text.substr(percent + 1));
}

bool is_host_name(std::string_view text) {
  return text.size() <= host_size_max && is_in_host_names(text.front()) && std::ranges::all_of(text, is_in_host_names);
}

bool is_multicast(std::string_view host) {
  if (const auto address = ipv4(host)) return IN_MULTICAST(ntohl(address->s_addr));
  const auto address = ipv6(host);
  return address && address->s6_addr[0] == 0xff;
}

enum class HostRule { numeric, name_or_numeric, group };
enum class PortRule { may_be_chosen, fixed };

std::string_view expected_host(HostRule rule) {
  switch (rule) {
    case HostRule::numeric: return "an IPv4 address, or an IPv6 address in brackets";
    case HostRule::name_or_numeric: return "a host name, an IPv4 address, or an IPv6 address in brackets";
    case HostRule::group: return "a multicast group: 224.0.0.0 to 239.255.255.255, or [ff00::] and above";
  }
  return {};
}

bool is_host(std::string_view text, bool in_brackets, HostRule rule) {
  if (text.empty()) return false;
  if (rule == HostRule::group) return is_multicast(text) && in_brackets == ipv6(text).has_value();
  if (in_brackets) return is_scoped_ipv6(text);
  if (ipv4(text)) return true;
  const auto may_be_numeric = std::ranges::all_of(text, [](char c) { return is_digit(c) || c == '.'; });
  return rule == HostRule::name_or_numeric && !may_be_numeric && is_host_name(text);
}

Result<HostPort, EndpointError> parse_host_port(Part part, HostRule host_rule, PortRule port_rule) {
  const auto in_brackets = part.text.starts_with('[');
  const auto bracket = part.text.find(']');
  if (in_brackets && bracket == std::string_view::npos) return refuse(part.end(), "']' behind the IPv6 address");

  const auto host_size = in_brackets ? bracket + 1 : std::min(part.text.find(':'), part.text.size());
  const auto written = part.first(host_size);
  const auto host = in_brackets ? written.text.substr(1, host_size - 2) : written.text;
  if (!is_host(host, in_brackets, host_rule)) return refuse(written, std::string{expected_host(host_rule)});

  const auto rest = part.from(host_size);
  const auto* const expected_port =
      port_rule == PortRule::fixed ? "a port from 1 to 65535" : "a port from 0 to 65535, 0 for any that is free";
  if (rest.text.empty()) return refuse(rest, fmt::format("':' and {}", expected_port));
  if (rest.text.front() != ':') return refuse(rest, fmt::format("':' and {}", expected_port));
  const auto port_text = rest.from(1);
  const auto port = number_in<std::uint16_t>(port_text.text);
  if (!port || (*port == 0 && port_rule == PortRule::fixed)) return refuse(port_text, expected_port);
  return HostPort{std::string{host}, *port};
}

/// One `name=value` behind the question mark.
struct Option {
  Part whole;
  Part name;
  Part value;
};

Option option_of(Part whole) {
  const auto name_size = std::min(whole.text.find('='), whole.text.size());
  return {whole, whole.first(name_size), whole.from(std::min(name_size + 1, whole.text.size()))};
}

/// What stands behind the scheme: the place and, behind a question mark, its options.
struct Body {
  Part place;
  std::vector<Option> options{};
};

Body split_options(Part part, std::size_t question_mark) {
  if (question_mark == std::string_view::npos) return {part};
  Body body{part.first(question_mark)};
  auto rest = part.from(question_mark + 1);
  for (auto end = rest.text.find('&'); end != std::string_view::npos; end = rest.text.find('&')) {
    body.options.push_back(option_of(rest.first(end)));
    rest = rest.from(end + 1);
  }
  body.options.push_back(option_of(rest));
  return body;
}

/// Hands every option to `apply`, which returns what was expected of the value, or nothing when it was right. The
/// names are all that there are, `expected` tells them to people.
template <std::size_t Count, class Apply>
Result<void, EndpointError> read_options(const std::vector<Option>& options,
                                         const std::array<std::string_view, Count>& names, const char* expected,
                                         Apply apply) {
  std::array<bool, Count> seen{};
  for (const auto& option : options) {
    const auto found = std::ranges::find(names, option.name.text);
    if (found == names.end() || option.name.text == option.whole.text) return refuse(option.whole, expected);
    auto& seen_before = seen[static_cast<std::size_t>(found - names.begin())];
    if (std::exchange(seen_before, true)) return refuse(option.whole, fmt::format("{} only once", *found));
    const std::string_view wanted = apply(option.name.text, option.value.text);
    if (!wanted.empty()) return refuse(option.value, std::string{wanted});
  }
  return {};
}

Result<Endpoint, EndpointError> parse_serial(Part part) {
  if (!part.text.starts_with('/')) return refuse(part, "the device's absolute path: serial:///dev/...");
  if (const auto question_mark = part.text.find('?'); question_mark != std::string_view::npos)
    return refuse(part.from(question_mark), "':' and a baud rate; there are no options");
  const auto colon = part.text.rfind(':');
  const auto tail = colon == std::string_view::npos ? part.end() : part.from(colon + 1);
  const auto ends_in_name = colon == std::string_view::npos || tail.text.find_first_of("/.") != std::string_view::npos;

  SerialEndpoint endpoint;
  endpoint.device = part.text.substr(0, ends_in_name ? part.text.size() : colon);
  if (endpoint.device.ends_with('/')) return refuse(part, "a device, as in serial:///dev/ttyACM0:57600");
  if (ends_in_name) return endpoint;
  const auto baud = number_in<std::uint32_t>(tail.text);
  if (!baud || *baud == 0 || *baud > baud_max) return refuse(tail, "a baud rate from 1 to 4000000");
  endpoint.baud = *baud;
  return endpoint;
}

template <class T>
Result<Endpoint, EndpointError> parse_listener(Part part) {
  return parse_host_port(part, HostRule::numeric, PortRule::may_be_chosen).map([](HostPort&& place) {
    return Endpoint{T{std::move(place)}};
  });
}

template <class T>
Result<Endpoint, EndpointError> parse_caller(Part part) {
  return parse_host_port(part, HostRule::name_or_numeric, PortRule::fixed).map([](HostPort&& place) {
    return Endpoint{T{std::move(place)}};
  });
}

Result<Endpoint, EndpointError> parse_multicast(Part part) {
  const auto body = split_options(part, part.text.find('?'));
  auto group = parse_host_port(body.place, HostRule::group, PortRule::may_be_chosen);
  if (!group) return fail(std::move(group).error());

  MulticastEndpoint endpoint{*std::move(group)};
  const auto apply = [&](std::string_view name, std::string_view value) -> const char* {
    if (name == "interface") {
      if (!is_interface_name(value)) return "the name of a network interface, e.g. eth0";
      endpoint.interface = value;
    } else if (name == "ttl") {
      const auto ttl = number_in<std::uint8_t>(value);
      if (!ttl) return "a number of hops from 0 to 255";
      endpoint.ttl = *ttl;
    } else {
      if (value != "0" && value != "1") return "0 or 1";
      endpoint.loopback = value == "1";
    }
    return "";
  };
  static constexpr std::array<std::string_view, 3> names{"interface", "ttl", "loopback"};
  if (auto read = read_options(body.options, names, "interface=NAME, ttl=N or loopback=0|1", apply); !read)
    return fail(std::move(read).error());
  return endpoint;
}

Result<Endpoint, EndpointError> parse_file(Part part) {
  const auto body = split_options(part, part.text.rfind('?'));
  if (!body.place.text.starts_with('/') || body.place.text.ends_with('/'))
    return refuse(body.place, "the file's absolute path: file:///...");

  FileEndpoint endpoint{std::string{body.place.text}};
  const auto apply = [&](std::string_view, std::string_view value) -> const char* {
    const auto speed = number_in<double>(value);
    const auto is_speed = speed && (*speed == 0 || (*speed >= speed_min && *speed <= speed_max));
    if (!is_speed) return "a speed from 0.01 to 1000, or 0 for as fast as possible";
    endpoint.speed = *speed == 0 ? 0 : *speed;  // no negative zero
    return "";
  };
  static constexpr std::array<std::string_view, 1> names{"speed"};
  if (auto read = read_options(body.options, names, "speed=N", apply); !read) return fail(std::move(read).error());
  return endpoint;
}

struct Scheme {
  std::string_view name;
  Result<Endpoint, EndpointError> (*parse)(Part);
};

constexpr auto schemes = std::to_array<Scheme>({
    {"serial", parse_serial},
    {"udpin", parse_listener<UdpInEndpoint>},
    {"udpout", parse_caller<UdpOutEndpoint>},
    {"tcpin", parse_listener<TcpInEndpoint>},
    {"tcpout", parse_caller<TcpOutEndpoint>},
    {"udpmulticast", parse_multicast},
    {"file", parse_file},
});

struct TextWriter {
  std::string operator()(const SerialEndpoint& e) const { return fmt::format("serial://{}:{}", e.device, e.baud); }
  std::string operator()(const UdpInEndpoint& e) const { return "udpin://" + to_text(e.local); }
  std::string operator()(const UdpOutEndpoint& e) const { return "udpout://" + to_text(e.remote); }
  std::string operator()(const TcpInEndpoint& e) const { return "tcpin://" + to_text(e.local); }
  std::string operator()(const TcpOutEndpoint& e) const { return "tcpout://" + to_text(e.remote); }
  std::string operator()(const MulticastEndpoint& e) const {
    std::string options;
    if (!e.interface.empty()) options += "&interface=" + e.interface;
    if (e.ttl != 1) options += fmt::format("&ttl={}", e.ttl);
    if (!e.loopback) options += "&loopback=0";
    if (!options.empty()) options.front() = '?';
    return "udpmulticast://" + to_text(e.group) + options;
  }
  std::string operator()(const FileEndpoint& e) const {
    // A question mark in the path would be taken for the one before the options.
    const auto needs_speed = e.speed != 1 || e.path.find('?') != std::string::npos;
    return "file://" + e.path + (needs_speed ? fmt::format("?speed={}", e.speed) : "");
  }
};

}  // namespace

Result<Endpoint, EndpointError> parse_endpoint(std::string_view text) {
  const Part whole{text};
  const auto control = std::ranges::find_if(text, is_control);
  if (control != text.end())
    return refuse(whole.from(static_cast<std::size_t>(control - text.begin())).first(1), "no control characters");

  static constexpr std::string_view separator = "://";
  const auto scheme_size = text.find(separator);
  const auto name = whole.first(scheme_size);
  const auto scheme = std::ranges::find(schemes, name.text, &Scheme::name);
  if (scheme_size == std::string_view::npos || scheme == schemes.end())
    return refuse(name, "serial://, udpin://, udpout://, tcpin://, tcpout://, udpmulticast:// or file://");
  return scheme->parse(whole.from(scheme_size + separator.size()));
}

std::string to_text(const Endpoint& endpoint) { return std::visit(TextWriter{}, endpoint); }

std::string to_text(const HostPort& place) {
  const auto is_ipv6 = place.host.find(':') != std::string::npos;
  return is_ipv6 ? fmt::format("[{}]:{}", place.host, place.port) : fmt::format("{}:{}", place.host, place.port);
}

std::string to_text(const EndpointError& error) {
  const auto part = error.part.empty() ? std::string{"nothing"} : '"' + error.part + '"';
  return fmt::format("{} at character {}: expected {}", part, error.position + 1, error.expectation);
}

}  // namespace ponte::transport
