#pragma once

#include "ponte/autopilot/patience.hpp"
#include "ponte/autopilot/peer.hpp"
#include "ponte/autopilot/received_file.hpp"
#include "ponte/autopilot/voice.hpp"
#include "ponte/core/bytes.hpp"
#include "ponte/core/id.hpp"
#include "ponte/core/outbox.hpp"
#include "ponte/core/result.hpp"
#include "ponte/mavlink/frame.hpp"
#include "ponte/mavlink/ftp_message.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ponte::autopilot {

struct FileTimes {
  Patience::Limits patience{};
  Duration silence_limit{std::chrono::seconds{15}};
  /// Of all of a request, for each block of a file beyond the limit above.
  Duration per_block{std::chrono::seconds{1}};
};

using FileRequestId = Id<struct FileRequestTag, std::uint32_t>;

/// Why a request cannot even be started.
enum class FileRefusal : std::uint8_t {
  busy,               ///< with another request
  bad_path,           ///< empty, with a NUL, or longer than a message holds
  too_large,          ///< more bytes than `FileClient::size_limit`
  not_in_mavlink_09,  ///< which has no file transfer
};

enum class FileFailure : std::uint8_t {
  none,
  refused,    ///< `error` says why
  silent,     ///< nothing was answered, or too slowly
  too_large,  ///< more bytes than `FileClient::size_limit`, or too many pieces are missing
};

/// What has become of a request. Each ends in exactly one fact that is no `progress`.
struct FileFact {
  enum class Kind : std::uint8_t { progress, was_read, written, listed, removed, checksum, failed } kind{};
  FileRequestId request{};
  std::uint32_t bytes{};     ///< transferred so far, or in all
  std::uint32_t checksum{};  ///< of `checksum`, as `ftp_checksum`
  FileFailure failure{};
  mavlink::FtpError error{};
  friend bool operator==(const FileFact&, const FileFact&) = default;
};

struct FileEntry {
  std::string name{};
  bool is_directory{};
  std::uint32_t size{};  ///< bytes; 0 of a directory
  friend bool operator==(const FileEntry&, const FileEntry&) = default;
};

/// The CRC-32 of MAVFTP: nothing is done to the register before or after.
[[nodiscard]] std::uint32_t ftp_checksum(Bytes content);

/// The files of one autopilot by MAVFTP, one request at a time. A request that is not answered is repeated with its
/// number, which the server answers again without doing it twice.
class FileClient {
 public:
  static constexpr std::size_t size_limit = 4U << 20U;

  explicit FileClient(const Peer& peer, const FileTimes& times = {});

  using Started = Result<FileRequestId, FileRefusal>;
  /// In bursts, and then what is missing of them, block by block. Then `content` has it.
  Started read(Timestamp now, std::string_view path, Voice& voice);
  /// Makes the file, or empties and fills it. ArduPilot's virtual files take effect when they are closed, as a whole.
  Started write(Timestamp now, std::string_view path, std::vector<std::byte> content, Voice& voice);
  /// Then `entries` has it.
  Started list(Timestamp now, std::string_view path, Voice& voice);
  Started remove(Timestamp now, std::string_view path, Voice& voice);
  /// Of the file as it is on board.
  Started checksum(Timestamp now, std::string_view path, Voice& voice);

  /// A frame of the vehicle's system, with the right checksum.
  void on_message(Timestamp now, const mavlink::FrameView& frame, Voice& voice, Outbox<FileFact>& facts);
  void on_tick(Timestamp now, Voice& voice, Outbox<FileFact>& facts);
  /// The vehicle has started anew, with no file open: a request that had one begins again.
  void on_reboot(Timestamp now);
  [[nodiscard]] std::optional<Timestamp> next_deadline() const;

  [[nodiscard]] bool is_busy() const { return step_ != Step::idle; }
  [[nodiscard]] const std::vector<std::byte>& content() const { return file_.content(); }
  [[nodiscard]] const std::vector<FileEntry>& entries() const { return entries_; }

 private:
  using Opcode = mavlink::FtpOpcode;
  using Error = mavlink::FtpError;
  using Message = mavlink::FtpMessage;
  enum class Step : std::uint8_t { idle, asking, opening, resetting, bursting, reading, writing, closing };

  Started begin(Timestamp now, Step step, Opcode opcode, std::string_view path, Voice& voice);
  void open(Timestamp now, Voice& voice);
  void request(Timestamp now, Message message, Voice& voice);
  void send(Timestamp now, Voice& voice);

  // file_client_messages.cpp
  void on_answer(Timestamp now, const Message& answer, Voice& voice, Outbox<FileFact>& facts);
  void on_refusal(Timestamp now, const Message& answer, Voice& voice, Outbox<FileFact>& facts);
  void on_asked(Timestamp now, const Message& answer, Voice& voice, Outbox<FileFact>& facts);
  void on_block(Timestamp now, const Message& block, Voice& voice, Outbox<FileFact>& facts);
  void read_on(Timestamp now, Voice& voice);
  void burst(Timestamp now, Voice& voice);
  void write_on(Timestamp now, Voice& voice);
  void close(Timestamp now, Voice& voice);
  void add_entries(Timestamp now, const Message& answer, Voice& voice);
  void fail_with(FileFailure failure, Outbox<FileFact>& facts, Error error = {});
  void tell(FileFact fact, Outbox<FileFact>& facts);

  Peer peer_;
  FileTimes times_;
  Patience patience_;
  Step step_{Step::idle};
  FileRequestId id_{};
  Opcode aim_{};  ///< what the request begins with
  std::string path_;
  ReceivedFile file_;                ///< that is read
  std::vector<std::byte> outgoing_;  ///< that is written
  std::size_t written_{};
  std::vector<FileEntry> entries_;
  std::uint32_t listed_{};  ///< entries, those left out included
  std::uint8_t session_{};
  std::uint16_t sequence_{};  ///< the highest that was sent or heard
  Message last_{};            ///< what was asked last
  bool is_repeated_{};
  bool has_reset_{};
  Timestamp sent_{};
  Timestamp heard_{};
  Timestamp next_try_{};
  Timestamp end_{};
};

}  // namespace ponte::autopilot
