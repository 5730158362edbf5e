#include "inspect/live_traffic.hpp"

#include "common/failure.hpp"
#include "vsm/link_log.hpp"

namespace ponte::app {
namespace {

/// The Sequence # of a DLI message is FFFF in Edition 3, 0 or 1 in Edition A.
bool begins_as_dli(Bytes datagram) {
  if (datagram.size() < dli::wrapper_size) return false;
  const auto sequence = u16_be(datagram, 0);
  return sequence == 0xFFFF || sequence <= 1;
}

}  // namespace

/// Gives what a parser finds the time, and its place in all that was received.
class LiveTraffic::Placed final : public mavlink::FrameSink {
 public:
  explicit Placed(LiveTraffic& owner) : owner_{owner} {}

  void on_frame(const mavlink::FrameView& frame, const mavlink::MessageInfo* message) override {
    owner_.mavlink_.on_frame(owner_.offset_, time_, frame, message);
    owner_.offset_ += frame.whole.size();
  }
  void on_overlap(std::size_t shared) override { owner_.offset_ -= shared; }
  void on_skipped(Bytes run, mavlink::SkipReason reason) override {
    owner_.mavlink_.on_damage(owner_.offset_, time_, run, name_of(reason));
    owner_.offset_ += run.size();
  }

 private:
  LiveTraffic& owner_;
  WallTime time_{transport::Loop::wall()};
};

LiveTraffic::LiveTraffic(transport::Loop& loop, const transport::Endpoint& endpoint, Log log,
                         const mavlink::Dialect& dialect, CaptureSink& mavlink, DliTraffic& dli, DliVisitor visitor)
    : loop_{loop},
      endpoint_{endpoint},
      log_{std::move(log)},
      dialect_{dialect},
      mavlink_{mavlink},
      dli_{dli},
      visitor_{std::move(visitor)},
      silence_{loop, [this](Timestamp now) {
                 Placed placed{*this};
                 for (const auto& [peer, parser] : parsers_)
                   if (parser->next_deadline() && *parser->next_deadline() <= now) parser->on_tick(now, placed);
                 wait_for_silence();
               }} {
  auto opened = transport::open_link(loop_, endpoint_, *this);
  if (!opened) throw Failure{transport::to_text(opened.error())};
  link_ = std::move(*opened);
}

mavlink::Parser& LiveTraffic::parser_of(transport::PeerId peer) {
  auto& parser = parsers_[peer];
  if (!parser) parser = std::make_unique<mavlink::Parser>(dialect_);
  return *parser;
}

void LiveTraffic::on_bytes(Timestamp now, Bytes bytes, transport::PeerId peer) {
  Placed placed{*this};
  parser_of(peer).on_bytes(now, bytes, placed);
  wait_for_silence();
}

void LiveTraffic::on_datagram(Timestamp, Bytes bytes, transport::PeerId peer) {
  if (begins_as_dli(bytes)) {
    const auto time = transport::Loop::wall();
    dli_.on_datagram(time, bytes, [&](const dli::WrapperView& message) { visitor_(time, message); });
    return;
  }
  Placed placed{*this};
  parser_of(peer).on_datagram(bytes, placed);
}

void LiveTraffic::on_peer(Timestamp, transport::PeerId peer, transport::PeerChange change, std::string_view name) {
  log_->info("{} {} {}", name, change == transport::PeerChange::joined ? "joined" : "left",
             transport::to_text(endpoint_));
  const auto found = parsers_.find(peer);
  if (change == transport::PeerChange::joined || found == parsers_.end()) return;
  Placed placed{*this};
  found->second->finish(placed);
  parsers_.erase(found);
}

void LiveTraffic::on_state(Timestamp, transport::LinkState state, std::string_view reason) {
  log_state(*log_, endpoint_, state, reason);
}

void LiveTraffic::wait_for_silence() {
  std::optional<Timestamp> due;
  for (const auto& [peer, parser] : parsers_)
    if (const auto deadline = parser->next_deadline(); deadline && (!due || *deadline < *due)) due = deadline;
  silence_.set(due);
}

}  // namespace ponte::app
