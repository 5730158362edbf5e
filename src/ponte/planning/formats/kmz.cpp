#include "ponte/core/assert.hpp"
#include "ponte/planning/formats/kml.hpp"
#include "ponte/planning/formats/refusal.hpp"
#include "ponte/planning/formats/text.hpp"

#include <fmt/format.h>
#include <zip.h>

#include <array>
#include <memory>
#include <utility>

namespace ponte::planning {
namespace {

constexpr zip_uint64_t largest_kml = 64U << 20U;

struct Closer {
  void operator()(zip_t* archive) const { zip_discard(archive); }
  void operator()(zip_file_t* file) const { zip_fclose(file); }
  void operator()(zip_source_t* source) const { zip_source_free(source); }
};
using Archive = std::unique_ptr<zip_t, Closer>;
using ArchivedFile = std::unique_ptr<zip_file_t, Closer>;
using Source = std::unique_ptr<zip_source_t, Closer>;

[[noreturn]] void refuse_zip(std::string what) { refuse({}, std::move(what), "a zip archive with a .kml file"); }

/// The archive takes the source over.
Archive open(Source source, int flags) {
  zip_error_t error{};
  Archive archive{zip_open_from_source(source.get(), flags, &error)};
  if (!archive) {
    std::string reason{zip_error_strerror(&error)};
    zip_error_fini(&error);
    refuse_zip(std::move(reason));
  }
  (void)source.release();
  return archive;
}

struct Entry {
  zip_uint64_t index{};
  std::string name;
  std::size_t others{};  ///< files beside it
};

Entry find_kml(zip_t* archive) {
  Entry found;
  bool is_found = false;
  const auto count = static_cast<zip_uint64_t>(zip_get_num_entries(archive, 0));
  for (zip_uint64_t index = 0; index < count; ++index) {
    const char* raw_name = zip_get_name(archive, index, 0);
    const std::string name{raw_name != nullptr ? raw_name : ""};
    if (!is_found && lower_case(name).ends_with(".kml")) {
      is_found = true;
      found.index = index;
      found.name = name;
    } else if (!name.ends_with('/')) {
      ++found.others;
    }
  }
  if (!is_found) refuse_zip(fmt::format("none of its {} entries is a .kml file", count));
  return found;
}

/// Its size is measured while unpacking, since what the archive says of it may be a lie.
std::vector<std::byte> unpack(zip_t* archive, const Entry& entry) {
  const ArchivedFile file{zip_fopen_index(archive, entry.index, 0)};
  if (!file) refuse_zip(fmt::format("{}: {}", entry.name, zip_strerror(archive)));
  std::vector<std::byte> bytes;
  std::array<std::byte, 1U << 16U> chunk{};
  while (true) {
    const auto count = zip_fread(file.get(), chunk.data(), chunk.size());
    if (count < 0) refuse_zip(fmt::format("{}: {}", entry.name, zip_file_strerror(file.get())));
    if (count == 0) return bytes;
    bytes.insert(bytes.end(), chunk.begin(), chunk.begin() + count);
    if (bytes.size() > largest_kml) refuse({}, fmt::format("{} unpacks to more than 64 MiB", entry.name), "less");
  }
}

std::vector<std::byte> zipped(const std::vector<std::byte>& kml) {
  zip_error_t error{};
  Source target{zip_source_buffer_create(nullptr, 0, 0, &error)};
  PONTE_ASSERT(target);
  zip_source_keep(target.get());
  auto archive = open(Source{target.get()}, ZIP_TRUNCATE);
  const auto index = zip_file_add(archive.get(), "doc.kml", zip_source_buffer(archive.get(), kml.data(), kml.size(), 0),
                                  ZIP_FL_ENC_UTF_8);
  PONTE_ASSERT(index >= 0);
  // The same content gives the same bytes: the file is of 1980-01-01, where the calendar of zip begins.
  constexpr zip_uint16_t first_date = (1U << 5U) + 1;
  zip_file_set_dostime(archive.get(), static_cast<zip_uint64_t>(index), 0, first_date, 0);
  const bool closed = zip_close(archive.get()) == 0;
  PONTE_ASSERT(closed);
  (void)archive.release();

  zip_stat_t stat{};
  PONTE_ASSERT(zip_source_stat(target.get(), &stat) == 0 && zip_source_open(target.get()) == 0);
  std::vector<std::byte> bytes(stat.size);
  PONTE_ASSERT(zip_source_read(target.get(), bytes.data(), bytes.size()) == static_cast<zip_int64_t>(bytes.size()));
  zip_source_close(target.get());
  return bytes;
}

}  // namespace

ReadingResult read_kmz(Bytes bytes, const ReadOptions& options) try {
  zip_error_t error{};
  Source source{zip_source_buffer_create(bytes.data(), bytes.size(), 0, &error)};
  PONTE_ASSERT(source);
  const auto archive = open(std::move(source), ZIP_RDONLY);
  const auto entry = find_kml(archive.get());
  auto reading = read_kml(unpack(archive.get(), entry), options);
  if (!reading) {
    reading.error().what = fmt::format("{}: {}", entry.name, reading.error().what);
    return reading;
  }
  if (entry.others > 0)
    reading->remarks.push_back(
        {{}, fmt::format("{} other files of the archive beside {} are not kept", entry.others, entry.name)});
  return reading;
} catch (const FormatError& error) {
  return fail(error);
}

Writing write_kmz(const MissionFile& content) {
  auto writing = write_kml(content);
  writing.bytes = zipped(writing.bytes);
  return writing;
}

}  // namespace ponte::planning
