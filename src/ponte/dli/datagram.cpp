#include "ponte/dli/datagram.hpp"

#include <algorithm>

namespace ponte::dli {

DatagramReader::DatagramReader(Bytes payload, const Profile& profile, DatagramCounters& counters)
    : payload_{payload}, profile_{&profile}, counters_{&counters} {
  ++counters_->datagrams;
  if (payload_.size() > datagram_size_max) ++counters_->too_long;
  compare_checksum_length();
}

void DatagramReader::compare_checksum_length() {
  if (payload_.size() < wrapper_size) return;
  const std::size_t length = u16_be(payload_, 2);
  const auto data_end = wrapper_size + length;
  // With more than a longest checksum behind the data there is another message, and the size tells nothing.
  if (payload_.size() < data_end || payload_.size() > data_end + size_of(Checksum::sum32)) return;
  const auto checksum = properties_from_word(u16_be(payload_, 14)).checksum;
  if (payload_.size() - data_end != size_of(checksum)) ++counters_->checksum_length_mismatch;
}

std::optional<Result<WrapperView, DatagramError>> DatagramReader::next() {
  if (at_end_) return std::nullopt;
  const auto start = offset_;
  const auto rest = payload_.subspan(start);
  const auto claimed = claimed_size(rest);
  const auto message = parse_message(rest, *profile_);
  offset_ += claimed;
  at_end_ = claimed == 0 || offset_ == payload_.size();
  if (!message) {
    const auto follows_a_message = start > 0 && message.error() == WrapperError::truncated;
    const auto reason = follows_a_message ? WrapperError::stray_bytes : message.error();
    ++counters_->errors[static_cast<std::size_t>(reason)];
    return fail(DatagramError{reason, start});
  }
  ++counters_->messages;
  if (message->properties.idd_version != profile_->idd_version) ++counters_->other_version;
  if (message->properties.checksum == Checksum::unassigned) ++counters_->unexamined;
  return *message;
}

DatagramWriter::DatagramWriter(MutableBytes buffer, const Profile& profile)
    : buffer_{buffer.first(std::min(buffer.size(), datagram_size_max))}, profile_{&profile} {}

MutableBytes DatagramWriter::room() const {
  const auto left = buffer_.subspan(size_);
  const auto around_data = wrapper_size + size_of(profile_->checksum);
  if (left.size() <= around_data) return {};
  return left.subspan(wrapper_size, std::min(left.size() - around_data, data_size_max));
}

Result<Bytes, WriteError> DatagramWriter::add(const Envelope& envelope, MessageNumber number, Bytes data) {
  return keep(write_message(buffer_.subspan(size_), envelope, number, data, *profile_));
}

Result<Bytes, WriteError> DatagramWriter::add_in_place(const Envelope& envelope, MessageNumber number,
                                                       std::size_t data_size) {
  return keep(wrap_in_place(buffer_.subspan(size_), envelope, number, data_size, *profile_));
}

Result<Bytes, WriteError> DatagramWriter::keep(Result<std::size_t, WriteError> written) {
  if (!written) {
    const auto fits_nowhere = written.error() == WriteError::no_room && empty();
    return fail(fits_nowhere ? WriteError::too_long : written.error());
  }
  const Bytes message = buffer_.subspan(size_, *written);
  size_ += *written;
  return message;
}

}  // namespace ponte::dli
