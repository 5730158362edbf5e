#pragma once

#include "ponte/core/time.hpp"
#include "ponte/mavlink/autopilots/file_transfer_protocol.hpp"
#include "ponte/mavlink/ftp_message.hpp"
#include "ponte/sim/speaker.hpp"
#include "ponte/sim/virtual_files.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ponte::sim {

using mavlink::FtpError;
using mavlink::FtpMessage;
using mavlink::FtpOpcode;

/// ArduPilot's server of MAVFTP, for the files that it makes up. The client chooses the number of its session. What is
/// not used for three seconds may give way to another client's session, and ends after 20; what was written takes
/// effect when it is closed.
class FileServer {
 public:
  /// `files` outlives it.
  explicit FileServer(VirtualFiles& files);

  void on_message(Timestamp now, const mavlink::autopilots::FileTransferProtocol& message, Requester from,
                  Speaker& speaker);
  /// Once in each step: goes on with bursts, and ends what is no longer used.
  void on_step(Timestamp now, Speaker& speaker);

 private:
  struct Burst {
    FtpMessage request;
    std::uint32_t offset;
    std::uint16_t sequence;  // of the next answer
    std::size_t blocks_left;
  };
  struct Session {
    bool is_open{};
    std::uint8_t number{};  // as its owner calls it
    bool writes{};
    Requester owner{};
    std::string path;
    std::vector<std::byte> content;
    std::optional<Burst> burst;
    Timestamp used{};
  };
  struct Answered {
    Requester to;
    std::uint16_t request;
    FtpMessage answer;
  };

  [[nodiscard]] FtpMessage answer(Timestamp now, const FtpMessage& request, Requester from);
  [[nodiscard]] std::optional<FtpError> open(Timestamp now, const FtpMessage& request, bool writes, Requester from,
                                             FtpMessage& reply);
  [[nodiscard]] std::optional<FtpError> read(const FtpMessage& request, const Session& session,
                                             FtpMessage& reply) const;
  [[nodiscard]] std::optional<FtpError> write(const FtpMessage& request, Session& session) const;
  [[nodiscard]] std::optional<FtpError> close(Session& session);
  [[nodiscard]] std::optional<FtpError> list(const FtpMessage& request, FtpMessage& reply);
  [[nodiscard]] std::optional<FtpError> checksum(const FtpMessage& request, FtpMessage& reply);
  [[nodiscard]] Session* find(const FtpMessage& request, Requester from);
  [[nodiscard]] Session* session_of(Timestamp now, const FtpMessage& request, Requester from);
  [[nodiscard]] Session* free_session(Timestamp now);
  void go_on(Session& session, Speaker& speaker);
  static void send(const FtpMessage& content, Requester to, Speaker& speaker);

  VirtualFiles& files_;
  std::array<Session, 5> sessions_;
  std::vector<std::byte> scratch_;
  std::optional<Answered> last_;
};

}  // namespace ponte::sim
