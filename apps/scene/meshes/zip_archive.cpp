#include "apps/scene/meshes/zip_archive.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <limits>
#include <string>

#include "geometry/mesh/binary_values.hpp"
#include "geometry/mesh/text_scanner.hpp"

namespace ashlar {
namespace {

[[noreturn]] void refuse(const std::string& what) {
  throw MeshFileError(what, 0, 0);
}

/// Fields of the archive, which may be missing.
template <class T>
T field(std::string_view bytes, std::uint64_t place) {
  if (place > bytes.size() || bytes.size() - place < sizeof(T)) refuse("zip archive is cut off or damaged");
  return read_binary<T>(bytes.substr(place), std::endian::little);
}

constexpr std::uint32_t entry_signature = 0x02014b50;
constexpr std::uint32_t local_signature = 0x04034b50;
constexpr std::uint32_t end_signature = 0x06054b50;
constexpr std::uint32_t end_64_signature = 0x06064b50;
constexpr std::uint32_t locator_signature = 0x07064b50;

struct Directory {
  std::uint64_t begin;
  std::uint64_t size;
  std::uint64_t entries;
};

/// The record at the end of the archive, followed only by its comment.
std::uint64_t end_record(std::string_view bytes) {
  constexpr std::uint64_t size = 22;
  constexpr std::uint64_t longest_comment = 65535;
  if (bytes.size() < size) refuse("file is no zip archive, which 3MF files are");
  const std::uint64_t last = bytes.size() - size;
  for (std::uint64_t back = 0; back <= std::min(last, longest_comment); ++back)
    if (field<std::uint32_t>(bytes, last - back) == end_signature &&
        field<std::uint16_t>(bytes, last - back + 20) == back)
      return last - back;
  refuse("file is no zip archive, which 3MF files are, or it is cut off");
}

Directory directory_of(std::string_view bytes) {
  const std::uint64_t end = end_record(bytes);
  Directory directory{field<std::uint32_t>(bytes, end + 16), field<std::uint32_t>(bytes, end + 12),
                      field<std::uint16_t>(bytes, end + 10)};
  constexpr std::uint64_t locator_size = 20;
  const bool is_64 =
      end >= locator_size && field<std::uint32_t>(bytes, end - locator_size) == locator_signature;
  if (is_64) {
    const auto place = field<std::uint64_t>(bytes, end - locator_size + 8);
    if (field<std::uint32_t>(bytes, place) != end_64_signature)
      refuse("zip archive is damaged: its ZIP64 record");
    directory = {field<std::uint64_t>(bytes, place + 48), field<std::uint64_t>(bytes, place + 40),
                 field<std::uint64_t>(bytes, place + 32)};
  }
  if (directory.begin > end || directory.size > end - directory.begin)
    refuse("zip archive is damaged: its directory is not in the file");
  return directory;
}

/// Values that do not fit into 32 bits are in an extra field, in this order.
void read_zip64(std::string_view extra, ZipArchive::Entry& entry) {
  constexpr std::uint32_t elsewhere = std::numeric_limits<std::uint32_t>::max();
  constexpr std::uint16_t zip64 = 1;
  for (std::uint64_t place = 0; place + 4 <= extra.size();) {
    const auto kind = field<std::uint16_t>(extra, place);
    const auto size = field<std::uint16_t>(extra, place + 2);
    place += 4;
    if (kind == zip64) {
      std::uint64_t at = place;
      for (std::uint64_t* value : {&entry.size, &entry.packed_size, &entry.header}) {
        if (*value != elsewhere) continue;
        *value = field<std::uint64_t>(extra, at);
        at += 8;
      }
    }
    place += size;
  }
}

/// zlib's state for one raw stream.
class Inflater {
 public:
  Inflater() {
    if (inflateInit2(&stream_, -MAX_WBITS) != Z_OK) throw std::bad_alloc();
  }
  ~Inflater() { inflateEnd(&stream_); }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;

  void take(std::string_view packed) {
    // zlib's pointer is not const, but it only reads.
    stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
    stream_.avail_in = static_cast<uInt>(packed.size());
  }

  /// The next bytes, empty at the end. @throws MeshFileError
  std::string_view give() {
    if (ended_) return {};
    stream_.next_out = reinterpret_cast<Bytef*>(piece_.data());
    stream_.avail_out = static_cast<uInt>(piece_.size());
    const int status = inflate(&stream_, Z_NO_FLUSH);
    if (status == Z_MEM_ERROR) throw std::bad_alloc();
    ended_ = status == Z_STREAM_END;
    if (status != Z_OK && !ended_) refuse("zip archive is damaged: an entry cannot be inflated");
    return {piece_.data(), piece_.size() - stream_.avail_out};
  }

 private:
  z_stream stream_{};
  bool ended_ = false;
  std::array<char, 1U << 16U> piece_;
};

}  // namespace

ZipArchive::ZipArchive(std::string_view bytes) : bytes_(bytes) {
  const Directory directory = directory_of(bytes);
  const std::string_view list = bytes.substr(directory.begin, directory.size);
  std::uint64_t place = 0;
  for (std::uint64_t i = 0; i < directory.entries; ++i) {
    constexpr std::uint64_t head = 46;
    if (field<std::uint32_t>(list, place) != entry_signature) refuse("zip archive is damaged: its directory");
    const auto name = field<std::uint16_t>(list, place + 28);
    const auto extra = field<std::uint16_t>(list, place + 30);
    const auto comment = field<std::uint16_t>(list, place + 32);
    Entry entry{{},
                field<std::uint32_t>(list, place + 20),
                field<std::uint32_t>(list, place + 24),
                field<std::uint32_t>(list, place + 42),
                field<std::uint32_t>(list, place + 16),
                field<std::uint16_t>(list, place + 10),
                field<std::uint16_t>(list, place + 8)};
    place += head;
    if (list.size() - place < std::uint64_t{name} + extra + comment)
      refuse("zip archive is damaged: its directory");
    entry.name = list.substr(place, name);
    read_zip64(list.substr(place + name, extra), entry);
    place += std::uint64_t{name} + extra + comment;
    entries_.push_back(entry);
  }
}

const ZipArchive::Entry* ZipArchive::find(std::string_view name) const {
  const auto found = std::find_if(entries_.begin(), entries_.end(),
                                  [&](const Entry& entry) { return equal_ignoring_case(entry.name, name); });
  return found == entries_.end() ? nullptr : &*found;
}

std::string_view ZipArchive::packed(const Entry& entry) const {
  constexpr std::uint64_t head = 30;
  if (field<std::uint32_t>(bytes_, entry.header) != local_signature)
    refuse("zip archive is damaged: an entry is not where its directory says");
  const std::uint64_t begin = entry.header + head + field<std::uint16_t>(bytes_, entry.header + 26) +
                              field<std::uint16_t>(bytes_, entry.header + 28);
  if (begin > bytes_.size() || entry.packed_size > bytes_.size() - begin)
    refuse(fmt::format("zip entry {} claims {} bytes, the file ends before", printable(entry.name),
                       entry.packed_size));
  return bytes_.substr(begin, entry.packed_size);
}

void ZipArchive::read(const Entry& entry, std::uint64_t most,
                      const std::function<void(std::string_view)>& use) const {
  constexpr std::uint16_t encrypted = 1;
  constexpr std::uint16_t stored = 0;
  constexpr std::uint16_t deflated = 8;
  if ((entry.flags & encrypted) != 0)
    refuse(fmt::format("zip entry {} is encrypted, allowed are plain ones", printable(entry.name)));
  if (entry.method != stored && entry.method != deflated)
    refuse(fmt::format("zip entry {} is packed by method {}, allowed are 0 (stored) and 8 (deflated)",
                       printable(entry.name), entry.method));
  std::string_view rest = packed(entry);
  std::uint64_t size = 0;
  uLong checksum = crc32(0, nullptr, 0);
  const auto hand_over = [&](std::string_view piece) {
    size += piece.size();
    if (size > most)
      refuse(fmt::format(
          "zip entry {} inflates to more than {} bytes, which is what is allowed of a file of this size",
          printable(entry.name), most));
    checksum = crc32(checksum, reinterpret_cast<const Bytef*>(piece.data()), static_cast<uInt>(piece.size()));
    use(piece);
  };
  if (entry.method == stored) {
    constexpr std::size_t piece = 1U << 16U;
    for (; !rest.empty(); rest.remove_prefix(std::min(rest.size(), piece))) hand_over(rest.substr(0, piece));
  } else {
    Inflater inflater;
    inflater.take(rest);
    for (std::string_view piece = inflater.give(); !piece.empty(); piece = inflater.give()) hand_over(piece);
  }
  if (size != entry.size || checksum != entry.checksum)
    refuse(fmt::format("zip entry {} is damaged (its size or checksum)", printable(entry.name)));
}

}  // namespace ashlar
