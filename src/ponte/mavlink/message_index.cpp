#include "ponte/mavlink/message_index.hpp"

namespace ponte::mavlink {

MessageIndex::MessageIndex(const Dialect& dialect) : dialect_{&dialect} {
  for (const auto* message : dialect.messages) {
    const auto id = message->id.value;
    if (id >= low_ids) break;
    present_[id / 64] |= std::uint64_t{1} << (id % 64);
  }
  for (std::size_t word = 1; word < present_.size(); ++word)
    before_[word] = static_cast<std::uint16_t>(before_[word - 1] + count_ones(present_[word - 1]));
}

}  // namespace ponte::mavlink
