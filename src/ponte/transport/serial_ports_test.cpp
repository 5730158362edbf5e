#include "ponte/transport/serial_ports.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <ostream>
#include <string>

namespace ponte::transport {

void PrintTo(const SerialPort& port, std::ostream* out) {
  *out << port.device << " by-id " << port.by_id << (port.is_autopilot ? " autopilot" : "");
}

namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// A folder that looks like /dev.
class SerialPorts : public ::testing::Test {
 protected:
  SerialPorts() {
    auto pattern = (fs::temp_directory_path() / "ponte-ports-XXXXXX").string();
    folder = ::mkdtemp(pattern.data());
  }
  ~SerialPorts() override { fs::remove_all(folder); }

  void add(const std::string& name) { std::ofstream{folder / name}; }
  void add_by_id(const std::string& name, const std::string& port) {
    fs::create_directories(folder / "serial" / "by-id");
    fs::create_symlink("../../" + port, folder / "serial" / "by-id" / name);
  }
  [[nodiscard]] std::string path(const std::string& name) const { return (folder / name).string(); }

  fs::path folder;
};

bool never(const fs::path&) { return false; }

TEST_F(SerialPorts, AreListedByFamilyAndNumberWithAutopilotsFirst) {
  for (const auto* name : {"ttyUSB10", "ttyUSB2", "ttyACM1", "ttyACM0", "ttyAMA0", "ttyS0", "ttyS1"}) add(name);
  for (const auto* name : {"tty", "tty1", "ttyACM", "ttyACMx", "ttyS0x", "null", "ttyprintk"}) add(name);
  add_by_id("usb-Arduino_Uno_123-if00", "ttyACM0");
  add_by_id("usb-Holybro_Pixhawk6C_28003-if00", "ttyUSB2");
  add_by_id("usb-Holybro_Pixhawk6C_28003-if02", "ttyUSB2");
  const auto second_uart = [this](const fs::path& device) { return device == folder / "ttyS1"; };
  EXPECT_THAT(serial_ports_in(folder, second_uart),
              ElementsAre(SerialPort{path("ttyUSB2"), "usb-Holybro_Pixhawk6C_28003-if00", true},
                          SerialPort{path("ttyACM0"), "usb-Arduino_Uno_123-if00", false}, SerialPort{path("ttyACM1")},
                          SerialPort{path("ttyUSB10")}, SerialPort{path("ttyAMA0")}, SerialPort{path("ttyS1")}));
}

TEST_F(SerialPorts, AreListedWithoutUdev) {
  add("ttyACM0");
  EXPECT_THAT(serial_ports_in(folder, never), ElementsAre(SerialPort{path("ttyACM0")}));
}

TEST_F(SerialPorts, AreNoneInAFolderThatIsNotThere) {
  EXPECT_THAT(serial_ports_in(folder / "nowhere", never), IsEmpty());
}

TEST(SerialPortsOfThisMachine, AllExist) {
  for (const auto& port : serial_ports()) EXPECT_TRUE(fs::exists(port.device)) << port.device;
}

TEST(LooksLikeAutopilot, KnowsTheMakers) {
  for (const auto* name :
       {"usb-3D_Robotics_PX4_FMU_v2.x_0-if00", "usb-ArduPilot_Pixhawk1_3E0038-if00", "usb-CubePilot_CubeOrange_25-if00",
        "usb-Hex_ProfiCNC_CubeBlack_1-if00", "usb-Holybro_Durandal_1-if00", "usb-mRo_x2.1-777_2-if00",
        "usb-Auterion_PX4_FMU_v6X.x_0-if00", "usb-CUAV_V5+_1-if02", "usb-MATEKSYS_H743_1-if00"})
    EXPECT_TRUE(looks_like_autopilot(name)) << name;
  for (const auto* name :
       {"", "usb-Arduino_Uno_1-if00", "usb-FTDI_FT232R_USB_UART_A1-if00-port0",
        "usb-Silicon_Labs_CP2102_USB_to_UART_Bridge_Controller_0001-if00-port0", "usb-u-blox_AG_C_GNSS_receiver-if00"})
    EXPECT_FALSE(looks_like_autopilot(name)) << name;
}

}  // namespace
}  // namespace ponte::transport
