#include "codegen/dli_reader.hpp"
#include "codegen/emit.hpp"
#include "ponte/definitions/mavlink_reader.hpp"
#include "ponte/definitions/test_tools.hpp"

#include <cstdlib>

/// Compares the generated headers of a few telling messages with the samples that are committed for review. When a
/// change of the generator is meant, PONTE_UPDATE_GOLDEN=1 in the environment of this test writes the samples anew.
namespace ponte::codegen {
namespace {

const std::filesystem::path golden_folder{PONTE_SOURCE_DIR "/codegen/golden"};

void expect_golden(const Files& files, const std::filesystem::path& generated) {
  const auto sample = golden_folder / generated.filename();
  ASSERT_TRUE(files.contains(generated)) << generated << " is not generated";
  if (std::getenv("PONTE_UPDATE_GOLDEN") != nullptr) {
    std::filesystem::create_directories(golden_folder);
    std::ofstream{sample, std::ios::binary} << files.at(generated);
  }
  EXPECT_EQ(files.at(generated), read_file(sample))
      << "If this change of " << generated << " is meant, run this test with PONTE_UPDATE_GOLDEN=1 and commit "
      << sample;
}

TEST(Golden, MavlinkHeadersAreAsReviewed) {
  const auto protocol = read_mavlink(PONTE_SOURCE_DIR "/definitions/mavlink/autopilots.xml",
                                     {PONTE_SOURCE_DIR "/definitions/mavlink", PONTE_MAVLINK_XML_DIR});
  // Without descriptions: those are the package's text and must not be committed.
  const auto files = emit_mavlink(protocol, false);
  for (const auto* name : {"heartbeat.hpp", "battery_status.hpp", "statustext.hpp"})
    expect_golden(files, std::filesystem::path{"ponte/mavlink/autopilots"} / name);
}

TEST(Golden, DliHeadersAreAsReviewed) {
  const auto files = emit_dli(read_dli(PONTE_SOURCE_DIR "/definitions/dli"));
  for (const auto* name : {"inertial_states.hpp", "subsystem_status_alert.hpp", "eo_ir_laser_payload_command.hpp"})
    expect_golden(files, std::filesystem::path{"ponte/dli/messages"} / name);
}

}  // namespace
}  // namespace ponte::codegen
