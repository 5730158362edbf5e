#include "ponte/sim/file_server.hpp"

#include <boost/crc.hpp>

#include <algorithm>

namespace ponte::sim {

namespace messages = mavlink::autopilots;

namespace {

constexpr Duration reuse_limit = std::chrono::seconds{3};
constexpr Duration idle_limit = std::chrono::seconds{20};
constexpr std::size_t blocks_per_burst = 64;
constexpr std::size_t blocks_per_step = 4;

}  // namespace

FileServer::FileServer(VirtualFiles& files) : files_{files} {
  for (auto& each : sessions_) {
    each.path.reserve(FtpMessage::data_size_max);
    each.content.reserve(files.largest());
  }
  scratch_.reserve(files.largest());
}

void FileServer::send(const FtpMessage& content, Requester to, Speaker& speaker) {
  speaker.send(messages::FileTransferProtocol{.target_system = to.system.value,
                                              .target_component = to.component.value,
                                              .payload = mavlink::write_ftp(content)});
}

void FileServer::on_message(Timestamp now, const messages::FileTransferProtocol& message, Requester from,
                            Speaker& speaker) {
  const auto request = mavlink::read_ftp(message.payload);
  if (last_ && last_->to == from && last_->request == request.sequence)  // our answer was lost
    return send(last_->answer, from, speaker);

  if (request.opcode == FtpOpcode::burst_read_file) {
    if (auto* session = session_of(now, request, from); session != nullptr && !session->writes) {
      session->burst = {.request = request,
                        .offset = request.offset,
                        .sequence = static_cast<std::uint16_t>(request.sequence + 1),
                        .blocks_left = blocks_per_burst};
      return;
    }
  }
  const auto reply = answer(now, request, from);
  last_ = {.to = from, .request = request.sequence, .answer = reply};
  send(reply, from, speaker);
}

FtpMessage FileServer::answer(Timestamp now, const FtpMessage& request, Requester from) {
  FtpMessage reply{.sequence = static_cast<std::uint16_t>(request.sequence + 1),
                   .session = request.session,
                   .opcode = FtpOpcode::ack,
                   .request = request.opcode,
                   .offset = request.offset};
  const auto in_session = [&](auto&& act) -> std::optional<FtpError> {
    auto* session = session_of(now, request, from);
    return session == nullptr ? std::optional{FtpError::not_found} : act(*session);
  };
  const auto error = [&]() -> std::optional<FtpError> {
    switch (request.opcode) {
      case FtpOpcode::none: return std::nullopt;
      case FtpOpcode::reset_sessions:
        for (auto& each : sessions_)
          if (each.is_open && each.owner == from) each.is_open = false;
        return std::nullopt;
      case FtpOpcode::terminate_session: {
        auto* session = session_of(now, request, from);
        return session == nullptr ? std::nullopt : close(*session);
      }
      case FtpOpcode::list_directory: return list(request, reply);
      case FtpOpcode::open_read_only: return open(now, request, false, from, reply);
      case FtpOpcode::create_file:
      case FtpOpcode::open_write_only: return open(now, request, true, from, reply);
      case FtpOpcode::read_file: return in_session([&](Session& session) { return read(request, session, reply); });
      case FtpOpcode::write_file: return in_session([&](Session& session) { return write(request, session); });
      case FtpOpcode::calculate_crc32: return checksum(request, reply);
      case FtpOpcode::burst_read_file: return FtpError::not_found;
      case FtpOpcode::remove_file:
      case FtpOpcode::ack:
      case FtpOpcode::nak: break;
    }
    return FtpError::unknown_command;
  }();
  if (!error) return reply;
  reply.opcode = FtpOpcode::nak;
  const std::array reason{static_cast<std::byte>(*error)};
  reply.set_bytes(reason);
  return reply;
}

FileServer::Session* FileServer::find(const FtpMessage& request, Requester from) {
  const auto found = std::ranges::find_if(sessions_, [&](const Session& each) {
    return each.is_open && each.number == request.session && each.owner == from;
  });
  return found == sessions_.end() ? nullptr : &*found;
}

FileServer::Session* FileServer::session_of(Timestamp now, const FtpMessage& request, Requester from) {
  auto* session = find(request, from);
  if (session == nullptr) return nullptr;
  session->used = now;
  session->burst.reset();
  return session;
}

/// One that is free, or that nobody has used for a while.
FileServer::Session* FileServer::free_session(Timestamp now) {
  const auto is_free = [&](const Session& each) { return !each.is_open || now - each.used > reuse_limit; };
  const auto found = std::ranges::find_if(sessions_, is_free);
  return found == sessions_.end() ? nullptr : &*found;
}

std::optional<FtpError> FileServer::open(Timestamp now, const FtpMessage& request, bool writes, Requester from,
                                         FtpMessage& reply) {
  if (const auto* taken = find(request, from); taken != nullptr && (writes || now - taken->used <= reuse_limit))
    return FtpError::fail;  // a file is open in it
  auto* session = session_of(now, request, from);
  if (session == nullptr) session = free_session(now);
  if (session == nullptr) return FtpError::no_session_free;
  const auto path = request.path();
  session->content.clear();
  if (writes && !files_.may_write(path)) return FtpError::protected_file;
  if (!writes && !files_.read(path, session->content)) return FtpError::not_found;
  session->is_open = true;
  session->number = request.session;
  session->writes = writes;
  session->owner = from;
  session->path = path;
  session->used = now;
  session->burst.reset();
  if (writes) return std::nullopt;
  std::array<std::byte, 4> size{};
  store_le(size.data(), static_cast<std::uint32_t>(session->content.size()));
  reply.set_bytes(size);
  return std::nullopt;
}

std::optional<FtpError> FileServer::read(const FtpMessage& request, const Session& session, FtpMessage& reply) const {
  if (session.writes) return FtpError::fail;
  if (request.size > FtpMessage::data_size_max) return FtpError::bad_size;
  if (request.offset >= session.content.size()) return FtpError::end_of_file;
  const std::size_t left = session.content.size() - request.offset;
  const std::size_t wanted = request.size == 0 ? FtpMessage::data_size_max : request.size;
  reply.set_bytes(Bytes{session.content}.subspan(request.offset, std::min(wanted, left)));
  return std::nullopt;
}

/// In any order, as far as the largest file reaches.
std::optional<FtpError> FileServer::write(const FtpMessage& request, Session& session) const {
  if (!session.writes) return FtpError::fail;
  const auto bytes = request.bytes();
  if (request.size > FtpMessage::data_size_max) return FtpError::bad_size;
  if (request.offset + bytes.size() > files_.largest()) return FtpError::fail;
  const auto end = request.offset + bytes.size();
  if (session.content.size() < end) session.content.resize(end);
  std::copy(bytes.begin(), bytes.end(), session.content.begin() + request.offset);
  return std::nullopt;
}

std::optional<FtpError> FileServer::close(Session& session) {
  session.is_open = false;
  if (session.writes && !files_.write(session.path, session.content)) return FtpError::fail;
  return std::nullopt;
}

std::optional<FtpError> FileServer::list(const FtpMessage& request, FtpMessage& reply) {
  const auto path = request.path();
  if (!files_.directory_exists(path)) return FtpError::not_found;
  scratch_.clear();
  for (std::size_t number = request.offset;; ++number) {
    const auto whole = scratch_.size();
    if (!files_.append_entry(path, number, scratch_)) break;
    scratch_.push_back(std::byte{0});
    if (scratch_.size() <= FtpMessage::data_size_max) continue;
    scratch_.resize(whole);
    break;
  }
  if (scratch_.empty()) return FtpError::end_of_file;
  reply.set_bytes(scratch_);
  return std::nullopt;
}

/// As MAVFTP defines it: nothing is done to the register before or after.
std::optional<FtpError> FileServer::checksum(const FtpMessage& request, FtpMessage& reply) {
  if (!files_.read(request.path(), scratch_)) return FtpError::not_found;
  boost::crc_optimal<32, 0x04C11DB7, 0, 0, true, true> crc;
  crc.process_bytes(scratch_.data(), scratch_.size());
  std::array<std::byte, 4> result{};
  store_le(result.data(), static_cast<std::uint32_t>(crc.checksum()));
  reply.set_bytes(result);
  return std::nullopt;
}

void FileServer::on_step(Timestamp now, Speaker& speaker) {
  for (auto& session : sessions_) {
    if (!session.is_open) continue;
    if (now - session.used >= idle_limit) {
      session.is_open = false;
      continue;
    }
    for (std::size_t i = 0; i < blocks_per_step && session.burst; ++i) {
      session.used = now;
      go_on(session, speaker);
    }
  }
}

/// Sends the next block of a burst. At the end of the file the burst ends with the refusal to read on.
void FileServer::go_on(Session& session, Speaker& speaker) {
  auto& burst = *session.burst;
  FtpMessage block{.sequence = burst.sequence++,
                   .session = burst.request.session,
                   .opcode = FtpOpcode::ack,
                   .request = FtpOpcode::burst_read_file,
                   .burst_complete = burst.blocks_left == 1,
                   .offset = burst.offset};
  auto wanted = burst.request;
  wanted.offset = burst.offset;
  if (const auto error = read(wanted, session, block)) {
    block.opcode = FtpOpcode::nak;
    const std::array reason{static_cast<std::byte>(*error)};
    block.set_bytes(reason);
    burst.blocks_left = 1;
  }
  send(block, session.owner, speaker);
  burst.offset += block.size;
  if (--burst.blocks_left == 0) session.burst.reset();
}

}  // namespace ponte::sim
