#include "ponte/autopilot/file_client.hpp"
#include "ponte/mavlink/autopilots/file_transfer_protocol.hpp"
#include "ponte/mavlink/codec.hpp"

#include <algorithm>
#include <charconv>

namespace ponte::autopilot {

namespace messages = mavlink::autopilots;

void FileClient::on_message(Timestamp now, const mavlink::FrameView& frame, Voice& voice, Outbox<FileFact>& facts) {
  if (!is_busy() || !mavlink::carries<messages::FileTransferProtocol>(frame)) return;
  if (frame.system != peer_.system || frame.component != peer_.component) return;
  const auto message = mavlink::decode<messages::FileTransferProtocol>(frame);
  if (!voice.is_addressed(message.target_system, message.target_component)) return;

  const auto answer = mavlink::read_ftp(message.payload);
  // An answer has the number after that of its request; those of a burst count on from there.
  const auto later = static_cast<std::uint16_t>(answer.sequence - last_.sequence);
  constexpr std::uint16_t most_blocks = 4096;
  const bool is_answer =
      answer.request == last_.opcode && (step_ == Step::bursting ? later >= 1 && later <= most_blocks : later == 1);
  if (!is_answer) return;
  if (!is_repeated_ && heard_ < sent_) patience_.measured(now - sent_);
  heard_ = now;
  if (static_cast<std::uint16_t>(answer.sequence - sequence_) <= most_blocks) sequence_ = answer.sequence;
  if (answer.opcode == Opcode::ack)
    on_answer(now, answer, voice, facts);
  else if (answer.opcode == Opcode::nak)
    on_refusal(now, answer, voice, facts);
}

void FileClient::on_answer(Timestamp now, const Message& answer, Voice& voice, Outbox<FileFact>& facts) {
  switch (step_) {
    case Step::idle: return;
    case Step::asking: return on_asked(now, answer, voice, facts);
    case Step::resetting: step_ = Step::opening; return open(now, voice);
    case Step::opening:
      session_ = answer.session;
      if (aim_ == Opcode::create_file) return write_on(now, voice);
      return burst(now, voice);
    case Step::bursting:
    case Step::reading: return on_block(now, answer, voice, facts);
    case Step::writing:
      written_ += last_.size;
      facts.push({.kind = FileFact::Kind::progress, .request = id_, .bytes = static_cast<std::uint32_t>(written_)});
      return write_on(now, voice);
    case Step::closing:
      if (aim_ == Opcode::create_file)
        return tell({.kind = FileFact::Kind::written, .bytes = static_cast<std::uint32_t>(written_)}, facts);
      return tell({.kind = FileFact::Kind::was_read, .bytes = static_cast<std::uint32_t>(content().size())}, facts);
  }
}

void FileClient::on_refusal(Timestamp now, const Message& answer, Voice& voice, Outbox<FileFact>& facts) {
  const auto error = answer.bytes().empty() ? Error::fail : static_cast<Error>(answer.bytes().front());
  switch (step_) {
    case Step::bursting:
      if (error == Error::end_of_file) return read_on(now, voice);
      break;
    case Step::reading:
      // Behind the furthest piece: that was all.
      if (error == Error::end_of_file && last_.offset >= content().size()) return close(now, voice);
      break;
    case Step::closing:
      if (aim_ == Opcode::open_read_only) return on_answer(now, answer, voice, facts);
      break;
    case Step::opening:
      if (error == Error::no_session_free && !has_reset_) {  // ours of before, whose end was lost
        has_reset_ = true;
        step_ = Step::resetting;
        return request(now, {.opcode = Opcode::reset_sessions}, voice);
      }
      break;
    case Step::asking:
      if (aim_ == Opcode::list_directory && error == Error::end_of_file)
        return tell({.kind = FileFact::Kind::listed}, facts);
      if (aim_ == Opcode::remove_file && error == Error::not_found && is_repeated_)
        return tell({.kind = FileFact::Kind::removed}, facts);
      break;
    default: break;
  }
  const bool has_session = step_ != Step::asking && step_ != Step::opening && step_ != Step::resetting;
  if (error == Error::bad_session && has_session) {  // we were silent for too long, or it has started anew
    file_.clear();
    written_ = 0;
    step_ = Step::opening;
    return open(now, voice);
  }
  fail_with(FileFailure::refused, facts, error);
}

void FileClient::on_asked(Timestamp now, const Message& answer, Voice& voice, Outbox<FileFact>& facts) {
  if (aim_ == Opcode::list_directory) return add_entries(now, answer, voice);
  if (aim_ == Opcode::remove_file) return tell({.kind = FileFact::Kind::removed}, facts);
  if (answer.bytes().size() < sizeof(std::uint32_t)) return fail_with(FileFailure::refused, facts, Error::bad_size);
  tell({.kind = FileFact::Kind::checksum, .checksum = load_le<std::uint32_t>(answer.data.data())}, facts);
}

/// Entries end with a NUL each: "Fname\tsize", "Dname", and "S" for one that is left out.
void FileClient::add_entries(Timestamp now, const Message& answer, Voice& voice) {
  const auto bytes = answer.bytes();
  std::string_view text{reinterpret_cast<const char*>(bytes.data()), bytes.size()};
  constexpr std::size_t most_entries = 10'000;
  while (!text.empty() && entries_.size() < most_entries) {
    const auto entry = text.substr(0, text.find('\0'));
    text.remove_prefix(std::min(entry.size() + 1, text.size()));
    ++listed_;
    if (!entry.starts_with('F') && !entry.starts_with('D')) continue;
    const auto tab = std::min(entry.find('\t'), entry.size());
    FileEntry result{.name = std::string{entry.substr(1, tab - 1)}, .is_directory = entry.starts_with('D')};
    std::from_chars(entry.data() + std::min(tab + 1, entry.size()), entry.data() + entry.size(), result.size);
    entries_.push_back(std::move(result));
  }
  open(now, voice);
}

void FileClient::on_block(Timestamp now, const Message& block, Voice& voice, Outbox<FileFact>& facts) {
  const auto size = content().size();
  if (!file_.add(block.offset, block.bytes())) return fail_with(FileFailure::too_large, facts);
  if (content().size() > size) {
    const auto blocks = static_cast<std::int64_t>((content().size() - size) / Message::data_size_max + 1);
    end_ += blocks * times_.per_block;
    facts.push(
        {.kind = FileFact::Kind::progress, .request = id_, .bytes = static_cast<std::uint32_t>(content().size())});
  }
  if (step_ == Step::reading) return read_on(now, voice);
  next_try_ = now + patience_.current();
  if (block.burst_complete) burst(now, voice);
}

/// From the furthest piece on; what is missing before it is read afterwards.
void FileClient::burst(Timestamp now, Voice& voice) {
  step_ = Step::bursting;
  request(now,
          {.session = session_,
           .opcode = Opcode::burst_read_file,
           .size = Message::data_size_max,
           .offset = static_cast<std::uint32_t>(content().size())},
          voice);
}

/// The first that is missing; then whether there is more behind the furthest piece. The size that was told when the
/// file was opened is not relied on: ArduPilot makes some files up while they are read.
void FileClient::read_on(Timestamp now, Voice& voice) {
  step_ = Step::reading;
  const auto gap =
      file_.first_gap().value_or(ReceivedFile::Gap{content().size(), content().size() + Message::data_size_max});
  request(now,
          {.session = session_,
           .opcode = Opcode::read_file,
           .size = static_cast<std::uint8_t>(std::min<std::size_t>(gap.end - gap.begin, Message::data_size_max)),
           .offset = static_cast<std::uint32_t>(gap.begin)},
          voice);
}

void FileClient::write_on(Timestamp now, Voice& voice) {
  if (written_ == outgoing_.size()) return close(now, voice);
  step_ = Step::writing;
  Message message{.session = session_, .opcode = Opcode::write_file, .offset = static_cast<std::uint32_t>(written_)};
  message.set_bytes(Bytes{outgoing_}.subspan(written_, std::min(outgoing_.size() - written_, Message::data_size_max)));
  request(now, message, voice);
}

void FileClient::close(Timestamp now, Voice& voice) {
  step_ = Step::closing;
  request(now, {.session = session_, .opcode = Opcode::terminate_session}, voice);
}

void FileClient::fail_with(FileFailure failure, Outbox<FileFact>& facts, Error error) {
  tell({.kind = FileFact::Kind::failed, .failure = failure, .error = error}, facts);
}

void FileClient::tell(FileFact fact, Outbox<FileFact>& facts) {
  step_ = Step::idle;
  fact.request = id_;
  facts.push(fact);
}

}  // namespace ponte::autopilot
