#include "ponte/autopilot/file_client.hpp"

#include "ponte/mavlink/autopilots/file_transfer_protocol.hpp"

#include <boost/crc.hpp>

#include <algorithm>

namespace ponte::autopilot {

namespace messages = mavlink::autopilots;

std::uint32_t ftp_checksum(Bytes content) {
  boost::crc_optimal<32, 0x04C11DB7, 0, 0, true, true> crc;
  crc.process_bytes(content.data(), content.size());
  return crc.checksum();
}

FileClient::FileClient(const Peer& peer, const FileTimes& times)
    : peer_{peer}, times_{times}, patience_{times.patience}, file_{size_limit} {}

FileClient::Started FileClient::begin(Timestamp now, Step step, Opcode opcode, std::string_view path, Voice& voice) {
  if (voice.version() == mavlink::Version::v0_9) return fail(FileRefusal::not_in_mavlink_09);
  if (is_busy()) return fail(FileRefusal::busy);
  if (path.empty() || path.size() >= Message::data_size_max || path.find('\0') != path.npos)
    return fail(FileRefusal::bad_path);
  step_ = step;
  aim_ = opcode;
  path_ = path;
  heard_ = now;
  end_ = now + times_.silence_limit;
  has_reset_ = false;
  id_ = FileRequestId{id_.value + 1};
  open(now, voice);
  return id_;
}

/// Also of what opens nothing: the request that has the path.
void FileClient::open(Timestamp now, Voice& voice) {
  Message message{.opcode = aim_};
  message.set_bytes(bytes_of(path_));
  if (aim_ == Opcode::list_directory) message.offset = listed_;
  request(now, message, voice);
}

FileClient::Started FileClient::read(Timestamp now, std::string_view path, Voice& voice) {
  auto started = begin(now, Step::opening, Opcode::open_read_only, path, voice);
  if (started) file_.clear();
  return started;
}

FileClient::Started FileClient::write(Timestamp now, std::string_view path, std::vector<std::byte> content,
                                      Voice& voice) {
  if (content.size() > size_limit) return fail(FileRefusal::too_large);
  auto started = begin(now, Step::opening, Opcode::create_file, path, voice);
  if (!started) return started;
  outgoing_ = std::move(content);
  written_ = 0;
  end_ += static_cast<std::int64_t>(outgoing_.size() / Message::data_size_max) * times_.per_block;
  return started;
}

FileClient::Started FileClient::list(Timestamp now, std::string_view path, Voice& voice) {
  if (is_busy()) return fail(FileRefusal::busy);
  listed_ = 0;
  auto started = begin(now, Step::asking, Opcode::list_directory, path, voice);
  if (started) entries_.clear();
  return started;
}

FileClient::Started FileClient::remove(Timestamp now, std::string_view path, Voice& voice) {
  return begin(now, Step::asking, Opcode::remove_file, path, voice);
}

FileClient::Started FileClient::checksum(Timestamp now, std::string_view path, Voice& voice) {
  return begin(now, Step::asking, Opcode::calculate_crc32, path, voice);
}

/// A new request, with a number higher than any that was heard, so that late answers are told from its own.
void FileClient::request(Timestamp now, Message message, Voice& voice) {
  message.sequence = ++sequence_;
  last_ = message;
  is_repeated_ = false;
  send(now, voice);
}

void FileClient::send(Timestamp now, Voice& voice) {
  voice.send(messages::FileTransferProtocol{.target_system = peer_.system.value,
                                            .target_component = peer_.component.value,
                                            .payload = mavlink::write_ftp(last_)});
  sent_ = now;
  next_try_ = now + patience_.current();
}

void FileClient::on_tick(Timestamp now, Voice& voice, Outbox<FileFact>& facts) {
  if (!is_busy() || now < *next_deadline()) return;
  if (now >= end_ || now - heard_ >= times_.silence_limit) return fail_with(FileFailure::silent, facts);
  patience_.ran_out();
  if (step_ == Step::bursting && heard_ > sent_) return burst(now, voice);  // the end of the burst was lost
  is_repeated_ = true;
  send(now, voice);
}

void FileClient::on_reboot(Timestamp now) {
  const bool has_file = is_busy() && step_ != Step::asking;
  if (!has_file) return;
  // It has no such session any more, which it will say; then the file is opened again.
  next_try_ = now;
}

std::optional<Timestamp> FileClient::next_deadline() const {
  if (!is_busy()) return std::nullopt;
  return std::min({next_try_, end_, heard_ + times_.silence_limit});
}

}  // namespace ponte::autopilot
