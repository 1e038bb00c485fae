#include "io/threemf/zip.hpp"

#include "base/error.hpp"
#include "base/text/spelling.hpp"
#include "io/packing.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <zlib.h>

namespace facetmill::io::threemf {

namespace {

constexpr std::uint64_t local_magic = 0x04034b50, entry_magic = 0x02014b50, end_magic = 0x06054b50,
                        end64_magic = 0x06064b50, locator64_magic = 0x07064b50;
constexpr std::uint64_t local_size = 30, entry_size = 46, end_size = 22, end64_size = 56, locator64_size = 20;
constexpr std::uint64_t most16 = 0xffff, most32 = 0xffffffff;
constexpr unsigned stored = 0, deflated = 8;

std::uint32_t crc_of(Span bytes) {
    uLong crc = ::crc32(0, nullptr, 0);
    constexpr std::size_t at_once = std::size_t{1} << 30;
    for (std::size_t at = 0; at < bytes.size(); at += at_once)
        crc = ::crc32(crc, reinterpret_cast<const Bytef*>(bytes.data() + at),
                      static_cast<uInt>(std::min(at_once, bytes.size() - at)));
    return static_cast<std::uint32_t>(crc);
}

} // namespace

Archive::Archive(Span bytes, std::string name) : bytes_(bytes), name_(std::move(name)) {
    read_directory(find_end());
}

void Archive::fail(std::uint64_t at, const std::string& message) const {
    throw Error(ErrorKind::malformed, "E-ZIP", fmt::format("at byte {}: {}", at, message),
                "export it again, or download it again", file_mark(name_));
}

std::uint64_t Archive::number(std::uint64_t at, int bytes) const {
    if (at > bytes_.size() || bytes_.size() - at < static_cast<std::uint64_t>(bytes))
        fail(bytes_.size(), "the archive ends early");
    std::uint64_t value = 0;
    for (int i = bytes; i-- > 0;)
        value = value << 8 | std::to_integer<std::uint64_t>(bytes_[at + static_cast<std::uint64_t>(i)]);
    return value;
}

/// Finds the record after the directory. A comment of at most 64 KiB may follow it.
std::uint64_t Archive::find_end() const {
    if (bytes_.size() >= end_size) {
        const std::uint64_t last = bytes_.size() - end_size, first = last > most16 ? last - most16 : 0;
        for (std::uint64_t at = last + 1; at-- > first;)
            if (number(at, 4) == end_magic) return at;
    }
    fail(bytes_.size(), "the archive has no directory at its end");
}

void Archive::read_directory(std::uint64_t end) {
    std::uint64_t count = number(end + 10, 2), at = number(end + 16, 4);
    const bool is64 = (count == most16 || at == most32) && end >= locator64_size &&
                      number(end - locator64_size, 4) == locator64_magic;
    if (is64) {
        const std::uint64_t end64 = number(end - locator64_size + 8, 8);
        if (end64 > bytes_.size() || bytes_.size() - end64 < end64_size || number(end64, 4) != end64_magic)
            fail(end - locator64_size, "the directory of Zip64 is not where it should be");
        count = number(end64 + 32, 8);
        at = number(end64 + 48, 8);
    }
    if (at > end || count > (end - at) / entry_size)
        fail(end, fmt::format("a directory of {} entries does not fit before it", count));
    for (std::uint64_t i = 0; i < count; ++i) at = read_entry(at);
}

/// Returns the offset of the next entry.
std::uint64_t Archive::read_entry(std::uint64_t at) {
    if (number(at, 4) != entry_magic) fail(at, "expected an entry of the directory");
    Entry entry;
    entry.flags = static_cast<unsigned>(number(at + 8, 2));
    entry.method = static_cast<unsigned>(number(at + 10, 2));
    entry.crc = static_cast<std::uint32_t>(number(at + 16, 4));
    entry.packed = number(at + 20, 4);
    entry.size = number(at + 24, 4);
    entry.at = number(at + 42, 4);
    const std::uint64_t name = number(at + 28, 2), extra = number(at + 30, 2), comment = number(at + 32, 2);
    const std::uint64_t begin = at + entry_size, next = begin + name + extra + comment;
    if (next > bytes_.size()) fail(at, "an entry of the directory goes beyond the end");
    take_zip64(entry, begin + name, begin + name + extra);
    const std::string path(as_text(bytes_.subspan(begin, name)));
    entry.path = path;
    if (!entries_.emplace(lower_case(path), entry).second)
        fail(at, fmt::format("the entry '{}' occurs twice", path));
    return next;
}

/// Values that do not fit 32 bits are in extra field 1, in this order.
void Archive::take_zip64(Entry& entry, std::uint64_t at, std::uint64_t end) const {
    for (std::uint64_t size = 0; end - at >= 4; at += 4 + size) {
        size = number(at + 2, 2);
        if (size > end - at - 4) return;
        if (number(at, 2) != 1) continue;
        std::uint64_t from = at + 4;
        for (std::uint64_t* value : {&entry.size, &entry.packed, &entry.at}) {
            if (*value != most32 || at + 4 + size - from < 8) continue;
            *value = number(from, 8);
            from += 8;
        }
    }
}

std::vector<std::string> Archive::paths() const {
    std::vector<std::string> all;
    all.reserve(entries_.size());
    for (const auto& [key, entry] : entries_) all.push_back(entry.path);
    return all;
}

namespace {
std::string key_of(const std::string& path) {
    return lower_case(path.starts_with('/') ? path.substr(1) : path);
}
} // namespace

bool Archive::has(const std::string& path) const { return entries_.contains(key_of(path)); }

std::optional<Bytes> Archive::file(const std::string& path) {
    const auto found = entries_.find(key_of(path));
    if (found == entries_.end()) return {};
    const Entry& entry = found->second;
    if (number(entry.at, 4) != local_magic) fail(entry.at, fmt::format("expected the entry '{}'", path));
    const std::uint64_t at = entry.at + local_size + number(entry.at + 26, 2) + number(entry.at + 28, 2);
    if (at > bytes_.size() || entry.packed > bytes_.size() - at)
        fail(entry.at, fmt::format("the entry '{}' goes beyond the end", path));
    if ((entry.flags & 1) != 0) fail(entry.at, fmt::format("the entry '{}' is encrypted", path));
    if (entry.method != stored && entry.method != deflated)
        fail(entry.at,
             fmt::format("the entry '{}' is compressed by method {}, expected deflate", path, entry.method));
    const Span packed = bytes_.subspan(at, entry.packed);
    // The limit applies to all entries together, because several may share their bytes.
    const std::size_t most = most_unpacked(bytes_.size());
    if (unpacked_ >= most) too_large(name_, most);
    Bytes bytes = unpacked(packed, entry.method == stored ? Packing::none : Packing::deflate,
                           most - unpacked_, fmt::format("{}: {}", name_, path));
    if (bytes.size() != entry.size || crc_of(bytes) != entry.crc)
        fail(entry.at, fmt::format("the entry '{}' has a wrong size or checksum", path));
    unpacked_ += bytes.size();
    return bytes;
}

namespace {

void put(Bytes& out, std::uint64_t value, int bytes) {
    for (int i = 0; i < bytes; ++i) out.push_back(static_cast<std::byte>(value >> (8 * i) & 255));
}

/// The fields from the required version to the lengths of the name and the extra field. An entry and the
/// directory store the same fields. The time is the earliest that zip can hold: 1 January 1980.
void put_description(Bytes& out, const ArchiveFile& file, std::size_t packed_size, bool packs,
                     std::size_t extra) {
    constexpr std::uint64_t utf8 = 0x800;
    const bool is_ascii =
        std::all_of(file.path.begin(), file.path.end(), [](unsigned char c) { return c < 0x80; });
    put(out, 20, 2);                  // version 2.0
    put(out, is_ascii ? 0 : utf8, 2); // flags
    put(out, packs ? deflated : stored, 2);
    put(out, 0, 2);    // 0 o'clock
    put(out, 0x21, 2); // 1 January 1980
    put(out, crc_of(file.bytes), 4);
    put(out, packed_size, 4);
    put(out, file.bytes.size(), 4);
    put(out, file.path.size(), 2);
    put(out, extra, 2);
}

/// The bytes of an extra field that lets data after it begin at a multiple of the alignment. An extra field
/// has at least its head.
std::size_t padding(std::size_t end, std::size_t alignment) {
    constexpr std::size_t head = 4;
    const std::size_t gap = (alignment - end % alignment) % alignment;
    return gap == 0 || gap >= head ? gap : gap + alignment;
}

void put_bytes(Bytes& out, Span bytes) { out.insert(out.end(), bytes.begin(), bytes.end()); }

} // namespace

Bytes make_archive(const std::vector<ArchiveFile>& files, std::size_t alignment) {
    constexpr std::size_t local_size = 30, extra_head = 4;
    constexpr std::uint64_t extra_id = 0x1986; // not registered; the programs of OpenUSD use it
    const bool packs = alignment == 0;
    if (files.size() >= most16)
        throw Error(ErrorKind::limit, "E-SIZE", "a zip archive holds at most 65,534 files", "write a .tar");
    Bytes out, directory;
    for (const ArchiveFile& file : files) {
        const Bytes own = packs ? io::packed(file.bytes, Packing::deflate) : Bytes();
        const Bytes& packed = packs ? own : file.bytes;
        if (file.bytes.size() >= most32 || out.size() + packed.size() >= most32)
            throw Error(ErrorKind::limit, "E-SIZE", "a zip archive holds at most 4 GiB",
                        "write several files, or another format");
        const auto name = std::as_bytes(std::span(file.path));
        put(directory, entry_magic, 4);
        put(directory, 20, 2); // made by version 2.0
        put_description(directory, file, packed.size(), packs, 0);
        put(directory, 0, 2); // comment
        put(directory, 0, 2); // disk
        put(directory, 0, 2); // attributes
        put(directory, 0, 4);
        put(directory, out.size(), 4);
        put_bytes(directory, name);
        const std::size_t extra = packs ? 0 : padding(out.size() + local_size + name.size(), alignment);
        put(out, local_magic, 4);
        put_description(out, file, packed.size(), packs, extra);
        put_bytes(out, name);
        if (extra > 0) {
            put(out, extra_id, 2);
            put(out, extra - extra_head, 2);
            out.resize(out.size() + extra - extra_head);
        }
        put_bytes(out, packed);
    }
    const std::uint64_t at = out.size();
    put_bytes(out, directory);
    put(out, end_magic, 4);
    put(out, 0, 4); // disks
    put(out, files.size(), 2);
    put(out, files.size(), 2);
    put(out, directory.size(), 4);
    put(out, at, 4);
    put(out, 0, 2); // comment
    return out;
}

} // namespace facetmill::io::threemf
