#include "ponte/transport/endpoint.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <vector>

namespace ponte::transport {

// For messages of failed tests.
void PrintTo(const Endpoint& endpoint, std::ostream* out) { *out << to_text(endpoint); }
void PrintTo(const EndpointError& error, std::ostream* out) { *out << to_text(error); }

namespace {

struct Reading {
  std::string text;
  Endpoint endpoint;
};

class Endpoints : public ::testing::TestWithParam<Reading> {};

TEST_P(Endpoints, AreReadAndWrittenBack) {
  const auto& [text, endpoint] = GetParam();
  EXPECT_EQ(parse_endpoint(text), endpoint) << text;
  EXPECT_EQ(to_text(endpoint), text);
}

const std::vector<Reading> in_shortest_form{
    {"serial:///dev/ttyACM0:57600", SerialEndpoint{"/dev/ttyACM0", 57600}},
    {"serial:///dev/ttyUSB1:1", SerialEndpoint{"/dev/ttyUSB1", 1}},
    {"serial:///dev/serial0:4000000", SerialEndpoint{"/dev/serial0", 4'000'000}},
    {"serial:///dev/serial/by-path/pci-0:2:1.0:123457", SerialEndpoint{"/dev/serial/by-path/pci-0:2:1.0", 123'457}},
    {"udpin://0.0.0.0:14550", UdpInEndpoint{{"0.0.0.0", 14550}}},
    {"udpin://127.0.0.1:0", UdpInEndpoint{{"127.0.0.1", 0}}},
    {"udpin://[::]:14550", UdpInEndpoint{{"::", 14550}}},
    {"udpin://[fe80::1%eth0]:14550", UdpInEndpoint{{"fe80::1%eth0", 14550}}},
    {"udpout://127.0.0.1:14550", UdpOutEndpoint{{"127.0.0.1", 14550}}},
    {"udpout://localhost:1", UdpOutEndpoint{{"localhost", 1}}},
    {"udpout://[2001:db8::2]:65535", UdpOutEndpoint{{"2001:db8::2", 65535}}},
    {"tcpin://0.0.0.0:5760", TcpInEndpoint{{"0.0.0.0", 5760}}},
    {"tcpout://sitl-3.example_net.org:5760", TcpOutEndpoint{{"sitl-3.example_net.org", 5760}}},
    {"udpmulticast://239.255.45.86:45860", MulticastEndpoint{{"239.255.45.86", 45860}}},
    {"udpmulticast://[ff02::4586]:45860", MulticastEndpoint{{"ff02::4586", 45860}}},
    {"udpmulticast://239.1.2.3:30001?interface=eth0&ttl=7&loopback=0",
     MulticastEndpoint{{"239.1.2.3", 30001}, "eth0", 7, false}},
    {"udpmulticast://224.0.0.1:1?ttl=0", MulticastEndpoint{{"224.0.0.1", 1}, "", 0, true}},
    {"file:///path/flight.tlog", FileEndpoint{"/path/flight.tlog", 1}},
    {"file:///path/flight.tlog?speed=2.5", FileEndpoint{"/path/flight.tlog", 2.5}},
    {"file:///path/flight.tlog?speed=0", FileEndpoint{"/path/flight.tlog", 0}},
    {"file:///what?.tlog?speed=1", FileEndpoint{"/what?.tlog", 1}},
    {"file:///with blanks & co.tlog", FileEndpoint{"/with blanks & co.tlog", 1}},
};
INSTANTIATE_TEST_SUITE_P(InShortestForm, Endpoints, ::testing::ValuesIn(in_shortest_form));

TEST(ParseEndpoint, UnderstandsLongerForms) {
  EXPECT_EQ(parse_endpoint("serial:///dev/ttyACM0"), (Endpoint{SerialEndpoint{"/dev/ttyACM0", 57600}}));
  EXPECT_EQ(parse_endpoint("serial:///dev/serial/by-path/pci-0:1.0"),
            (Endpoint{SerialEndpoint{"/dev/serial/by-path/pci-0:1.0", 57600}}));
  EXPECT_EQ(parse_endpoint("udpmulticast://239.1.2.3:5?loopback=1&ttl=1"),
            (Endpoint{MulticastEndpoint{{"239.1.2.3", 5}}}));
  EXPECT_EQ(parse_endpoint("file:///a?speed=1.0"), Endpoint{FileEndpoint{"/a"}});
  EXPECT_EQ(parse_endpoint("file:///a?speed=-0.0"), (Endpoint{FileEndpoint{"/a", 0}}));
}

struct Refusal {
  std::string text;
  std::string part;
  std::size_t position;
  std::string expectation;
};

class BadEndpoints : public ::testing::TestWithParam<Refusal> {};

TEST_P(BadEndpoints, AreRefusedWithThePartThatIsWrong) {
  const auto& [text, part, position, expectation] = GetParam();
  EXPECT_EQ(parse_endpoint(text), fail(EndpointError{part, position, expectation})) << text;
  EXPECT_EQ(text.substr(position, part.size()), part);
}

constexpr auto schemes = "serial://, udpin://, udpout://, tcpin://, tcpout://, udpmulticast:// or file://";
constexpr auto baud = "a baud rate from 1 to 4000000";
constexpr auto device_path = "the device's absolute path: serial:///dev/...";
constexpr auto local_host = "an IPv4 address, or an IPv6 address in brackets";
constexpr auto remote_host = "a host name, an IPv4 address, or an IPv6 address in brackets";
constexpr auto group = "a multicast group: 224.0.0.0 to 239.255.255.255, or [ff00::] and above";
constexpr auto local_port = "a port from 0 to 65535, 0 for any that is free";
constexpr auto remote_port = "a port from 1 to 65535";
constexpr auto multicast_options = "interface=NAME, ttl=N or loopback=0|1";
constexpr auto interface_name = "the name of a network interface, e.g. eth0";
constexpr auto hops = "a number of hops from 0 to 255";
constexpr auto file_path = "the file's absolute path: file:///...";
constexpr auto speed = "a speed from 0.01 to 1000, or 0 for as fast as possible";

const std::vector<Refusal> refusals{
    {"", "", 0, schemes},
    {"/dev/ttyACM0", "/dev/ttyACM0", 0, schemes},
    {"udp://0.0.0.0:14550", "udp", 0, schemes},
    {"UDPIN://0.0.0.0:14550", "UDPIN", 0, schemes},
    {"udpin:/0.0.0.0:14550", "udpin:/0.0.0.0:14550", 0, schemes},
    {"serial:///dev/tty\n", "\n", 17, "no control characters"},
    {std::string{"file:///a\0b", 11}, std::string{"\0", 1}, 9, "no control characters"},
    {"serial://", "", 9, device_path},
    {"serial://COM3:57600", "COM3:57600", 9, device_path},
    {"serial:///dev/:57600", "/dev/:57600", 9, "a device, as in serial:///dev/ttyACM0:57600"},
    {"serial:///dev/ttyACM0:", "", 22, baud},
    {"serial:///dev/ttyACM0:0", "0", 22, baud},
    {"serial:///dev/ttyACM0:4000001", "4000001", 22, baud},
    {"serial:///dev/ttyACM0:99999999999", "99999999999", 22, baud},
    {"serial:///dev/ttyACM0:-9600", "-9600", 22, baud},
    {"serial:///dev/ttyACM0:57600x", "57600x", 22, baud},
    {"serial:///dev/ttyACM0?baud=9600", "?baud=9600", 21, "':' and a baud rate; there are no options"},
    {"udpin://", "", 8, local_host},
    {"udpin://localhost:14550", "localhost", 8, local_host},
    {"udpin://256.0.0.1:14550", "256.0.0.1", 8, local_host},
    {"udpin://::1:14550", "", 8, local_host},
    {"udpin://[::1:14550", "", 18, "']' behind the IPv6 address"},
    {"udpin://[1.2.3.4]:14550", "[1.2.3.4]", 8, local_host},
    {"udpin://[fe80::1%]:14550", "[fe80::1%]", 8, local_host},
    {"udpin://0.0.0.0", "", 15, std::string{"':' and "} + local_port},
    {"udpin://0.0.0.0:", "", 16, local_port},
    {"udpin://0.0.0.0:65536", "65536", 16, local_port},
    {"udpin://0.0.0.0:+1", "+1", 16, local_port},
    {"udpin://0.0.0.0:14550?ttl=1", "14550?ttl=1", 16, local_port},
    {"udpin://[::1]14550", "14550", 13, std::string{"':' and "} + local_port},
    {"udpout://:14550", "", 9, remote_host},
    {"udpout://1.2.3:14550", "1.2.3", 9, remote_host},
    {"udpout://a b:14550", "a b", 9, remote_host},
    {"udpout://" + std::string(254, 'a') + ":1", std::string(254, 'a'), 9, remote_host},
    {"udpout://127.0.0.1:0", "0", 19, remote_port},
    {"udpout://127.0.0.1:70000", "70000", 19, remote_port},
    {"tcpin://example.org:5760", "example.org", 8, local_host},
    {"tcpin://0.0.0.0:x", "x", 16, local_port},
    {"tcpout://127.0.0.1:0", "0", 19, remote_port},
    {"tcpout://127.0.0.1", "", 18, std::string{"':' and "} + remote_port},
    {"udpmulticast://192.168.1.1:1", "192.168.1.1", 15, group},
    {"udpmulticast://[fe80::1]:1", "[fe80::1]", 15, group},
    {"udpmulticast://group:1", "group", 15, group},
    {"udpmulticast://239.1.2.3?ttl=1", "", 24, std::string{"':' and "} + local_port},
    {"udpmulticast://239.1.2.3:1?", "", 27, multicast_options},
    {"udpmulticast://239.1.2.3:1?ttl=1&", "", 33, multicast_options},
    {"udpmulticast://239.1.2.3:1?ttl", "ttl", 27, multicast_options},
    {"udpmulticast://239.1.2.3:1?hops=1", "hops=1", 27, multicast_options},
    {"udpmulticast://239.1.2.3:1?ttl=256", "256", 31, hops},
    {"udpmulticast://239.1.2.3:1?ttl=1&ttl=2", "ttl=2", 33, "ttl only once"},
    {"udpmulticast://239.1.2.3:1?ttl=1&loopback=yes", "yes", 42, "0 or 1"},
    {"udpmulticast://239.1.2.3:1?interface=", "", 37, interface_name},
    {"udpmulticast://239.1.2.3:1?interface=sixteen_letters_", "sixteen_letters_", 37, interface_name},
    {"file://flight.tlog", "flight.tlog", 7, file_path},
    {"file:///flights/", "/flights/", 7, file_path},
    {"file:///a?", "", 10, "speed=N"},
    {"file:///a?speed=", "", 16, speed},
    {"file:///a?speed=-1", "-1", 16, speed},
    {"file:///a?speed=0.001", "0.001", 16, speed},
    {"file:///a?speed=1001", "1001", 16, speed},
    {"file:///a?speed=nan", "nan", 16, speed},
    {"file:///a?speed=inf", "inf", 16, speed},
    {"file:///a?b.tlog", "b.tlog", 10, "speed=N"},
};
INSTANTIATE_TEST_SUITE_P(OfEveryKind, BadEndpoints, ::testing::ValuesIn(refusals));

TEST(EndpointError, IsOneLine) {
  EXPECT_EQ(to_text(parse_endpoint("udpout://127.0.0.1:70000").error()),
            "\"70000\" at character 20: expected a port from 1 to 65535");
  EXPECT_EQ(to_text(parse_endpoint("serial:///dev/ttyACM0:").error()),
            "nothing at character 23: expected a baud rate from 1 to 4000000");
}

TEST(EndpointGrammar, ShowsEveryScheme) {
  for (const auto* scheme :
       {"serial://", "udpin://", "udpout://", "tcpin://", "tcpout://", "udpmulticast://", "file://"})
    EXPECT_THAT(std::string{endpoint_grammar}, ::testing::HasSubstr(scheme));
}

}  // namespace
}  // namespace ponte::transport
