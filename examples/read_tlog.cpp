// read_tlog FILE: which messages a recording holds, what is damaged in it, and what got lost on the way.
#include "ponte/mavlink/autopilots/dialect.hpp"
#include "ponte/mavlink/link_statistics.hpp"
#include "ponte/mavlink/tlog.hpp"

#include <cstdio>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <variant>
#include <vector>

int main(int argc, char** argv) {
  using namespace ponte;
  if (argc != 2) return 2;
  std::ifstream file{argv[1], std::ios::binary};
  const std::vector<char> content{std::istreambuf_iterator{file}, {}};

  std::map<std::string, int> counts;
  mavlink::LinkStatistics link;
  mavlink::TlogReader reader{bytes_of(content), mavlink::autopilots::dialect};
  while (const auto part = reader.next()) {
    if (const auto* record = std::get_if<mavlink::TlogRecord>(&*part)) {
      ++counts[record->message == nullptr ? "unknown" : std::string{record->message->name}];
      link.on_frame(record->frame.system, record->frame.component, record->frame.sequence);
    } else {
      const auto& damage = std::get<mavlink::TlogDamage>(*part);
      std::printf("%zu bytes at offset %zu are damaged\n", damage.length, damage.offset);
    }
  }
  for (const auto& [name, count] : counts) std::printf("%6d %s\n", count, name.c_str());
  for (const auto& sender : link.senders())
    std::printf("system %d component %d: %llu received, %llu lost\n", sender.system.value, sender.component.value,
                static_cast<unsigned long long>(sender.received), static_cast<unsigned long long>(sender.lost()));
}
