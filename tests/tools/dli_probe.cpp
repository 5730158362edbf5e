// Prints random instances of every DLI message as JSON lines, each with its bytes, for the independent reader to judge.

#include "ponte/core/hex.hpp"
#include "ponte/core/json_text.hpp"
#include "ponte/dli/codec.hpp"
#include "ponte/dli/messages/all.hpp"
#include "ponte/core/random.hpp"

#include <CLI/CLI.hpp>

#include <array>
#include <cmath>
#include <concepts>
#include <cstdio>
#include <limits>
#include <optional>
#include <string>

namespace ponte::dli {
namespace {

/// Which fields an instance has. The instances of a message take turns.
enum class Presence { only_time, all, random };

std::int64_t random_integer(Random& random, IntegerRange range) {
  switch (random.below(4)) {
    case 0: return range.first;
    case 1: return range.last;
    default: {
      const auto count = static_cast<std::uint64_t>(range.last - range.first) + 1;
      return range.first + static_cast<std::int64_t>(random.next() % count);
    }
  }
}

float random_float(Random& random) {
  constexpr std::array extremes{
      0.0F,
      -0.0F,
      std::numeric_limits<float>::max(),
      std::numeric_limits<float>::lowest(),
      std::numeric_limits<float>::denorm_min(),
      std::numeric_limits<float>::infinity(),
      -std::numeric_limits<float>::infinity(),
      std::numeric_limits<float>::quiet_NaN(),
  };
  if (random.chance(0.5)) return extremes[random.below(extremes.size())];
  return static_cast<float>((random.unit() - 0.5) * 1e6);
}

/// Printable ASCII of `length_max` bytes at most.
std::string random_text(Random& random, std::size_t length_max) {
  const auto kind = random.below(4);
  const auto bound = static_cast<std::uint32_t>(length_max + 1);
  const auto length = kind == 0 ? 0 : kind == 1 ? length_max : std::size_t{random.below(bound)};
  std::string text(length, ' ');
  for (auto& c : text) c = static_cast<char>(' ' + static_cast<char>(random.below(95)));
  return text;
}

/// Fills a message with random values. A text of variable length gets its length field by a second visit.
template <Message M>
class Filler {
 public:
  Filler(Random& random, const Profile& profile, Presence presence)
      : random_{&random}, profile_{&profile}, presence_{presence} {}

  M fill() {
    M message;
    M::visit(message, [this](const FieldInfo& field, auto&& member) { this->set(field, member); });
    M::visit(message, [this](const FieldInfo& field, auto&& member) { this->set_length(field, member); });
    return message;
  }

 private:
  void set(const FieldInfo&, ExcludedField) {}

  template <class T>
  void set(const FieldInfo& field, std::optional<T>& member) {
    if (!is_wanted(field)) return;
    if constexpr (std::integral<T>) {
      member = static_cast<T>(random_integer(*random_, range_of(field)));
    } else if constexpr (std::floating_point<T>) {
      member = random_float(*random_);
    } else if (field.type == FieldType::text) {
      member.emplace(random_text(*random_, field.width - 1U));
    } else {
      const auto text = random_text(*random_, variable_text_max);
      member.emplace(text);
      length_field_ = field.length_from;
      length_ = text.size();
    }
  }

  template <class Member>
  void set_length(const FieldInfo& field, Member& member) {
    if constexpr (requires { member.emplace(length_); })
      if (field.number == length_field_) member.emplace(static_cast<typename Member::value_type>(length_));
  }

  bool is_wanted(const FieldInfo& field) {
    if (field.since_edition_a && profile_->edition == Edition::ed3) return false;
    if (presence_ == Presence::only_time) return field.number == 1;
    return presence_ == Presence::all || random_->chance(0.5);
  }

  Random* random_;
  const Profile* profile_;
  Presence presence_;
  std::optional<std::uint8_t> length_field_;
  std::size_t length_{};
};

/// The message with zeros for NaN, which would compare unequal to itself.
template <Message M>
M without_nan(M message) {
  M::visit(message, []<class Member>(const FieldInfo&, Member&& member) {
    if constexpr (std::same_as<std::remove_cvref_t<Member>, std::optional<float>>)
      if (member && std::isnan(*member)) member = 0.0F;
  });
  return message;
}

template <Message M>
bool survives(const M& message, Bytes datagram, const Profile& profile) {
  const auto wrapped = parse_message(datagram, profile);
  if (!wrapped || wrapped->whole.size() != datagram.size()) return false;
  const auto decoded = decode<M>(wrapped->data, profile);
  if (!decoded || without_nan(*decoded) != without_nan(message)) return false;
  std::array<std::byte, data_size_max> again{};
  const auto size = encode(*decoded, profile, again);
  return size && std::ranges::equal(Bytes{again}.first(*size), wrapped->data);
}

class Probe {
 public:
  Probe(std::uint64_t seed, unsigned count, Edition edition) : random_{seed}, count_{count}, edition_{edition} {}

  template <Message M>
  void operator()() {
    if (!Profile{edition_}.has_fields(M::info)) return;
    for (unsigned i = 0; i < count_; ++i) print_instance<M>(static_cast<Presence>(i % 3));
  }

  [[nodiscard]] bool failed() const { return failed_; }

 private:
  template <Message M>
  void print_instance(Presence presence) {
    Profile profile{edition_};
    profile.checksum = static_cast<Checksum>(random_.below(3));
    const Envelope envelope = random_envelope();
    const M message = Filler<M>{random_, profile, presence}.fill();
    std::array<std::byte, datagram_size_max> buffer{};
    DatagramWriter writer{buffer, profile};
    const auto datagram = add_message(writer, envelope, message);
    if (!datagram || !survives(message, *datagram, profile)) {
      std::fprintf(stderr, "message %u is not the same after encoding and decoding: %s\n", M::info.number.value,
                   to_hex(datagram.value_or(Bytes{})).c_str());
      failed_ = true;
      return;
    }
    json_.clear();
    json_.begin_object().member("number", unsigned{M::info.number.value}).member("edition", name_of(edition_));
    json_.member("hex", std::string_view{to_hex(*datagram)});
    json_.member("source", to_text(envelope.source).view());
    json_.member("destination", to_text(envelope.destination).view());
    json_.member("ack", envelope.acknowledgement_wanted);
    json_.member("checksum", static_cast<unsigned>(size_of(profile.checksum)));
    json_.key("fields").begin_object();
    M::visit(message, [&](const FieldInfo& field, const auto& member) {
      append(field, member, profile.scale_of(M::info, field));
    });
    json_.end_object().end_object();
    std::puts(json_.text().c_str());
  }

  Envelope random_envelope() {
    const EntityId vehicle{20, EntityType::vsm, 2};
    const EntityId station{20, EntityType::cucs, 2};
    switch (random_.below(4)) {
      case 0: return {vehicle, broadcast_id, false};
      case 1: return {null_id, not_applicable_id, true};
      case 2: return {vehicle, station, random_.chance(0.5)};
      default: break;
    }
    const EntityId source{static_cast<std::uint32_t>(random_.next())};
    const EntityId destination{static_cast<std::uint32_t>(random_.next())};
    return {source, destination, random_.chance(0.5)};
  }

  void append(const FieldInfo&, ExcludedField, double) {}

  template <class T>
  void append(const FieldInfo& field, const std::optional<T>& member, double scale) {
    if (!member) return;
    json_.key(std::to_string(field.number)).begin_object().key("raw");
    if constexpr (std::floating_point<T>) {
      json_.value(*member);
    } else if constexpr (std::integral<T>) {
      json_.value(static_cast<std::int64_t>(*member));
    } else {
      json_.value(member->view());
    }
    if constexpr (std::integral<T> || std::floating_point<T>)
      if (scale != 0) json_.member("value", static_cast<double>(*member) * scale);
    json_.end_object();
  }

  Random random_;
  unsigned count_;
  Edition edition_;
  JsonText json_;
  bool failed_{};
};

int run(int argc, char** argv) {
  std::uint64_t seed = 1;
  unsigned count = 3;
  std::string edition = "3";
  CLI::App app{"Random instances of every DLI message as JSON lines"};
  app.add_option("--seed", seed, "Same seed, same lines")->capture_default_str();
  app.add_option("--count", count, "Instances per message")->capture_default_str();
  app.add_option("--edition", edition, "3 or A")->check(CLI::IsMember({"3", "A"}))->capture_default_str();
  CLI11_PARSE(app, argc, argv);

  Probe probe{seed, count, edition == "3" ? Edition::ed3 : Edition::ed_a};
  messages::for_each_message(probe);
  return probe.failed() ? 1 : 0;
}

}  // namespace
}  // namespace ponte::dli

int main(int argc, char** argv) { return ponte::dli::run(argc, argv); }
