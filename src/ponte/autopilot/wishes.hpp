#pragma once

#include "ponte/autopilot/command_client.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

/// What the clients that ask by single commands have in common.
namespace ponte::autopilot {

/// Names one wish of a client for as long as the program runs.
template <class Wish>
using WishId = Id<Wish, std::uint32_t>;

/// What became of a wish. Each ends in exactly one of these.
template <class Wish>
struct WishFact {
  enum class Kind : std::uint8_t {
    done,        ///< accepted; and where there is something to be seen of it, it was seen
    refused,     ///< with `result` and `reason`
    no_answer,   ///< whether it is done is not known
    no_effect,   ///< accepted, but nothing was seen of it
    superseded,  ///< by a newer wish
    rebooted,    ///< the vehicle has started anew meanwhile
  } kind{};
  WishId<Wish> request{};
  Wish wish{};
  std::uint8_t result{};  ///< MAV_RESULT of a refusal
  Text<159> reason{};     ///< of a refusal, as in `CommandFact`
  friend bool operator==(const WishFact&, const WishFact&) = default;
};

/// The wishes of one client that are under way.
template <class Wish>
class Wishes {
 public:
  using Fact = WishFact<Wish>;
  using Kind = typename Fact::Kind;

  /// The commands outlive it.
  explicit Wishes(CommandClient& commands) : commands_{commands} { pending_.reserve(CommandClient::capacity); }

  /// Nothing if too much is under way. `patience` is how long to look for the effect once the command is accepted.
  std::optional<WishId<Wish>> ask(Timestamp now, Wish wish, const Command& command, Duration patience, Voice& voice) {
    if (pending_.size() == pending_.capacity()) return std::nullopt;
    const auto request = commands_.request(now, command, voice);
    if (!request) return std::nullopt;
    pending_.push_back(
        {.id = WishId<Wish>{++last_id_}, .wish = wish, .command = *request, .since = now, .patience = patience});
    return pending_.back().id;
  }

  /// Those for which it holds are over.
  void supersede(Timestamp now, auto&& is_superseded) {
    for (auto& each : pending_) {
      if (each.phase == Phase::superseded || !is_superseded(each.wish)) continue;
      if (each.phase == Phase::asked) commands_.withdraw(now, each.command);
      each.phase = Phase::superseded;
      each.deadline = now;
    }
  }

  /// True: it was the answer to one of them. A refusal is told at once; what is accepted is left to `look`.
  bool on_answer(Timestamp now, const CommandFact& answer, Outbox<Fact>& facts) {
    const auto found = std::ranges::find_if(
        pending_, [&](const Pending& each) { return each.phase == Phase::asked && each.command == answer.request; });
    if (found == pending_.end()) return false;
    if (!answer.is_final()) return true;
    if (answer.kind == CommandFact::Kind::accepted) {
      found->phase = Phase::accepted;
      found->deadline = now + found->patience;
      return true;
    }
    Fact fact{.kind = Kind::no_answer, .request = found->id, .wish = found->wish};
    if (answer.kind == CommandFact::Kind::refused) {
      fact.kind = Kind::refused;
      fact.result = answer.result;
      fact.reason = answer.reason;
    }
    facts.push(fact);
    pending_.erase(found);
    return true;
  }

  /// Tells those that are done, as `is_seen(wish, since)` says of an accepted one, and those that nothing came of.
  void look(Timestamp now, auto&& is_seen, Outbox<Fact>& facts) {
    std::erase_if(pending_, [&](const Pending& each) {
      if (each.phase == Phase::asked) return false;
      auto kind = Kind::superseded;
      if (each.phase == Phase::accepted) kind = is_seen(each.wish, each.since) ? Kind::done : Kind::no_effect;
      if (kind != Kind::done && each.deadline > now) return false;
      tell(each, kind, facts);
      return true;
    });
  }

  [[nodiscard]] std::optional<Timestamp> next_deadline() const {
    std::optional<Timestamp> next;
    for (const auto& each : pending_)
      if (each.phase != Phase::asked && (!next || each.deadline < *next)) next = each.deadline;
    return next;
  }

  void on_reboot(Timestamp now, Outbox<Fact>& facts) {
    for (const auto& each : pending_) {
      if (each.phase == Phase::asked) commands_.withdraw(now, each.command);
      tell(each, each.phase == Phase::superseded ? Kind::superseded : Kind::rebooted, facts);
    }
    pending_.clear();
  }

 private:
  enum class Phase : std::uint8_t { asked, accepted, superseded };
  struct Pending {
    WishId<Wish> id{};
    Wish wish{};
    Phase phase{};
    CommandId command{};
    Timestamp since{};
    Duration patience{};
    Timestamp deadline{};  // but while asked
  };

  static void tell(const Pending& pending, Kind kind, Outbox<Fact>& facts) {
    facts.push({.kind = kind, .request = pending.id, .wish = pending.wish});
  }

  CommandClient& commands_;
  std::uint32_t last_id_{};
  std::vector<Pending> pending_;
};

}  // namespace ponte::autopilot
