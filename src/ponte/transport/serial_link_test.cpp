#include "ponte/core/bytes.hpp"
#include "ponte/transport/file_descriptor.hpp"
#include "ponte/transport/link.hpp"
#include "ponte/transport/pty.hpp"
#include "ponte/transport/serial_port.hpp"
#include "ponte/transport/test_witness.hpp"

#include <asm/termbits.h>
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/ioctl.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

namespace ponte::transport {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::must_open;
using ::testing::SizeIs;
using testing::wait_for;
using testing::Witness;

Bytes text(std::string_view text) { return bytes_of(text); }

constexpr LinkOptions impatient{.retry_first = 1ms, .retry_longest = 1ms};

std::string last_stream(const Witness& witness) {
  return witness.streams.empty() ? std::string{} : witness.streams.rbegin()->second;
}

/// A folder in which pseudo terminals appear under names that tests choose.
class SerialLinks : public ::testing::Test {
 protected:
  SerialLinks() {
    auto pattern = (fs::temp_directory_path() / "ponte-serial-XXXXXX").string();
    folder = ::mkdtemp(pattern.data());
    port = folder / "ttyACM0";
  }
  ~SerialLinks() override { fs::remove_all(folder); }

  std::unique_ptr<Link> plug_in(const LinkOptions& options = {}) {
    return open_pty(loop, port.string(), vehicle, options).value();
  }
  std::unique_ptr<Link> open(std::uint32_t baud = 57600) { return open(witness, baud); }
  std::unique_ptr<Link> open(Witness& its_witness, std::uint32_t baud = 57600) {
    return must_open(loop, endpoint(baud), its_witness, impatient);
  }
  [[nodiscard]] std::string endpoint(std::uint32_t baud = 57600) const {
    return "serial://" + port.string() + ':' + std::to_string(baud);
  }
  bool both_are_up() {
    return wait_for(loop, [&] { return witness.is_up() && vehicle.is_up(); });
  }

  fs::path folder;
  fs::path port;
  Loop loop;
  Witness witness;
  Witness vehicle;
};

TEST_F(SerialLinks, CarryEveryByteBothWays) {
  const auto pty = plug_in();
  const auto serial = open();
  EXPECT_EQ(serial->state(), LinkState::connecting);
  ASSERT_TRUE(both_are_up());
  EXPECT_THAT(witness.states, ElementsAre(LinkState::connecting, LinkState::up));
  EXPECT_EQ(serial->name(), endpoint());
  EXPECT_EQ(serial->local_port(), 0);
  EXPECT_EQ(serial->peer_name(witness.joined.at(0)), port.string());

  std::string every_byte;
  for (auto i = 0; i < 256; ++i) every_byte.push_back(static_cast<char>(i));
  serial->send(text(every_byte));
  pty->send(text(every_byte));
  ASSERT_TRUE(wait_for(loop, [&] { return last_stream(witness).size() + last_stream(vehicle).size() >= 512; }));
  EXPECT_EQ(last_stream(witness), every_byte);
  EXPECT_EQ(last_stream(vehicle), every_byte) << "nothing is echoed, nothing translated";
  EXPECT_EQ(serial->counters().bytes_out, 256U);
  EXPECT_EQ(serial->counters().messages_out, 1U);
  EXPECT_EQ(serial->counters().bytes_in, 256U);
}

class BaudRates : public SerialLinks, public ::testing::WithParamInterface<std::uint32_t> {};

TEST_P(BaudRates, AreSet) {
  const auto pty = plug_in();
  const auto serial = open(GetParam());
  ASSERT_TRUE(both_are_up());
  const FileDescriptor observer{::open(port.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC)};
  termios2 settings{};
  ASSERT_EQ(::ioctl(observer.get(), TCGETS2, &settings), 0);
  EXPECT_EQ(settings.c_ispeed, GetParam());
  EXPECT_EQ(settings.c_ospeed, GetParam());
  EXPECT_EQ(settings.c_cflag & CSIZE, tcflag_t{CS8});
  EXPECT_EQ(settings.c_cflag & (PARENB | CSTOPB | CRTSCTS | HUPCL), 0U);
  EXPECT_EQ(settings.c_lflag, 0U);
  serial->send(text("at any rate"));
  EXPECT_TRUE(wait_for(loop, [&] { return last_stream(vehicle) == "at any rate"; }));
}

INSTANTIATE_TEST_SUITE_P(UsualAndOdd, BaudRates, ::testing::Values(57600, 115200, 921600, 1, 74880, 123457, 4000000));

TEST(BaudRates, AgreeWithinThreePercent) {
  EXPECT_TRUE(baud_rates_agree(57600, 57600));
  EXPECT_TRUE(baud_rates_agree(57600, 58800));
  EXPECT_TRUE(baud_rates_agree(57600, 56400));
  EXPECT_FALSE(baud_rates_agree(57600, 59400));
  EXPECT_FALSE(baud_rates_agree(921600, 9600));
  EXPECT_FALSE(baud_rates_agree(9600, 4'000'000));
}

TEST_F(SerialLinks, WaitForAPortThatIsMissing) {
  const auto serial = open();
  ASSERT_TRUE(wait_for(loop, [&] { return witness.is_down(); }));
  EXPECT_EQ(witness.reasons.back(), port.string() + " is missing");
  serial->send(text("lost"));
  EXPECT_EQ(serial->counters().dropped_by(DropReason::not_connected), 1U);
  loop.run_for(20ms);
  EXPECT_THAT(witness.states, ElementsAre(LinkState::connecting, LinkState::down)) << "told once, not per attempt";

  const auto pty = plug_in();
  ASSERT_TRUE(both_are_up());
  EXPECT_EQ(serial->counters().reconnects, 0U);
}

TEST_F(SerialLinks, ComeBackWhenThePortIsPluggedInAgain) {
  auto pty = plug_in();
  const auto serial = open();
  ASSERT_TRUE(both_are_up());
  pty->send(text("before"));
  ASSERT_TRUE(wait_for(loop, [&] { return last_stream(witness) == "before"; }));

  pty.reset();
  ASSERT_TRUE(wait_for(loop, [&] { return witness.is_down(); }));
  EXPECT_EQ(witness.reasons.back(), port.string() + " was unplugged");
  EXPECT_THAT(witness.left, ElementsAre(witness.joined.at(0)));
  EXPECT_FALSE(fs::exists(fs::symlink_status(port)));
  loop.run_for(20ms);

  vehicle = Witness{};
  pty = plug_in();
  ASSERT_TRUE(both_are_up());
  pty->send(text("after"));
  ASSERT_TRUE(wait_for(loop, [&] { return last_stream(witness) == "after"; }));
  EXPECT_THAT(witness.states, ElementsAre(LinkState::connecting, LinkState::up, LinkState::down, LinkState::up));
  ASSERT_THAT(witness.joined, SizeIs(2));
  EXPECT_NE(witness.joined[0], witness.joined[1]);
  EXPECT_EQ(serial->counters().reconnects, 1U);
}

TEST_F(SerialLinks, SayThatAPortIsBusyAndTakeItWhenItIsFree) {
  const auto pty = plug_in();
  auto first = open();
  ASSERT_TRUE(both_are_up());
  Witness second_witness;
  const auto second = open(second_witness);
  ASSERT_TRUE(wait_for(loop, [&] { return second_witness.is_down(); }));
  EXPECT_EQ(second_witness.reasons.back(), port.string() + " is busy: another program has it open");
  first.reset();
  ASSERT_TRUE(wait_for(loop, [&] { return second_witness.is_up(); }));
}

TEST_F(SerialLinks, RefuseWhatIsNoSerialPort) {
  std::ofstream{port} << "a file";
  const auto serial = open();
  ASSERT_TRUE(wait_for(loop, [&] { return witness.is_down(); }));
  EXPECT_EQ(witness.reasons.back(), port.string() + " is no serial port");

  EXPECT_THAT(open_serial_port(folder.string(), 57600).error(), HasSubstr(folder.string()));
}

TEST_F(SerialLinks, AreNotOpenedOnAMissingPortWithoutReconnect) {
  const auto missing = open_link(loop, *parse_endpoint(endpoint()), witness, {.reconnect = false});
  ASSERT_FALSE(missing);
  EXPECT_EQ(to_text(missing.error()), endpoint() + ": " + port.string() + " is missing");

  auto pty = plug_in();
  const auto present = open_link(loop, *parse_endpoint(endpoint()), witness, {.reconnect = false});
  ASSERT_TRUE(present);
  ASSERT_TRUE(both_are_up());
  pty.reset();
  ASSERT_TRUE(wait_for(loop, [&] { return witness.is_down(); }));
  pty = plug_in();
  loop.run_for(20ms);
  EXPECT_TRUE(witness.is_down());
}

TEST_F(SerialLinks, DropWhatAPortDoesNotTake) {
  const auto pty = plug_in({.queue = {.bytes = 5000, .messages = 5}});
  const FileDescriptor silent{::open(port.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC)};
  ASSERT_TRUE(wait_for(loop, [&] { return vehicle.is_up(); }));
  const std::string message(1000, 'x');
  constexpr auto count = 1000U;
  for (auto i = 0U; i < count; ++i) pty->send(text(message));
  const auto& counters = pty->counters();
  const auto dropped = counters.dropped_by(DropReason::queue_full);
  EXPECT_GT(dropped, 100U);
  EXPECT_EQ(counters.messages_out + dropped + 5, count) << "five wait";
}

TEST_F(SerialLinks, MayBeDestroyedByTheirHandler) {
  auto pty = plug_in();
  auto serial = open();
  ASSERT_TRUE(both_are_up());
  witness.and_then = [&] { serial.reset(); };
  vehicle.and_then = [&] { pty.reset(); };
  pty->send(text("one"));
  ASSERT_TRUE(wait_for(loop, [&] { return serial == nullptr; }));
  ASSERT_TRUE(wait_for(loop, [&] { return vehicle.is_down(); })) << "nobody is there any more";
  EXPECT_TRUE(witness.is_up());
}

using Ptys = SerialLinks;

TEST_F(Ptys, KnowWhetherSomebodyIsThere) {
  const auto pty = plug_in();
  ASSERT_TRUE(wait_for(loop, [&] { return vehicle.is_down(); }));
  EXPECT_EQ(vehicle.reasons.back(), "nobody has " + port.string() + " open");
  pty->send(text("to nobody"));
  EXPECT_EQ(pty->counters().dropped_by(DropReason::not_connected), 1U);
  EXPECT_EQ(pty->name(), "pty://" + port.string());

  auto serial = open();
  ASSERT_TRUE(both_are_up());
  serial.reset();
  ASSERT_TRUE(wait_for(loop, [&] { return vehicle.is_down(); }));
  EXPECT_THAT(vehicle.states, ElementsAre(LinkState::connecting, LinkState::down, LinkState::up, LinkState::down));
}

TEST_F(Ptys, KeepNothingForThoseWhoComeLater) {
  const auto pty = plug_in();
  {
    const FileDescriptor silent{::open(port.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC)};
    ASSERT_TRUE(wait_for(loop, [&] { return vehicle.is_up(); }));
    pty->send(text("old"));
  }
  ASSERT_TRUE(wait_for(loop, [&] { return vehicle.states.size() >= 2 && vehicle.is_down(); }));
  loop.run_for(30ms);
  const auto serial = open();
  ASSERT_TRUE(both_are_up());
  pty->send(text("new"));
  ASSERT_TRUE(wait_for(loop, [&] { return last_stream(witness).ends_with("new"); }));
  EXPECT_EQ(last_stream(witness), "new");
}

TEST_F(Ptys, ReplaceWhatACrashLeftBehind) {
  fs::create_symlink("/dev/pts/99999", port);
  const auto pty = plug_in();
  const auto serial = open();
  EXPECT_TRUE(both_are_up());
}

TEST_F(Ptys, AreNotMadeInPlaceOfAnythingElse) {
  std::ofstream{port} << "precious";
  const auto pty = open_pty(loop, port.string(), vehicle);
  ASSERT_FALSE(pty);
  EXPECT_EQ(to_text(pty.error()), "pty://" + port.string() + ": cannot make " + port.string() + ": File exists");
  EXPECT_TRUE(fs::is_regular_file(port));

  fs::remove(port);
  fs::create_symlink("/dev/null", port);
  EXPECT_FALSE(open_pty(loop, port.string(), vehicle));
  EXPECT_EQ(fs::read_symlink(port), "/dev/null");
}

TEST_F(Ptys, RemoveTheirLinkAndNobodyElses) {
  auto first = plug_in();
  auto second = plug_in();
  first.reset();
  EXPECT_TRUE(fs::exists(fs::symlink_status(port))) << "it is the second one's";
  second.reset();
  EXPECT_FALSE(fs::exists(fs::symlink_status(port)));
}

}  // namespace
}  // namespace ponte::transport
