#include "io/tar.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <fmt/format.h>
#include <optional>

namespace facetmill::io {

namespace {

constexpr std::size_t block = 512;

[[noreturn]] void fail(const std::string& name, std::size_t at, const std::string& message) {
    throw Error(ErrorKind::malformed, "E-TAR", fmt::format("at byte {}: {}", at, message),
                "make the archive again, or download it again", file_mark(name));
}

/// A text field, which ends with NUL if it is shorter than its room.
std::string_view text_at(Span header, std::size_t at, std::size_t room) {
    const std::string_view field = as_text(header.subspan(at, room));
    return field.substr(0, field.find('\0'));
}

/// A number in octal digits, or in binary with the highest bit set (GNU). None if it is damaged.
std::optional<std::uint64_t> tar_number(Span header, std::size_t at, std::size_t room) {
    const auto first = std::to_integer<unsigned>(header[at]);
    if (first & 0x80U) {
        std::uint64_t value = first & 0x7FU;
        for (std::size_t i = 1; i < room; ++i) {
            if (value >> 56 != 0) return {};
            value = value << 8 | std::to_integer<std::uint64_t>(header[at + i]);
        }
        return value;
    }
    std::string_view digits = text_at(header, at, room);
    while (digits.starts_with(' ')) digits.remove_prefix(1);
    while (digits.ends_with(' ')) digits.remove_suffix(1);
    if (digits.empty()) return 0;
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value, 8);
    if (error != std::errc() || end != digits.data() + digits.size()) return {};
    return value;
}

constexpr std::size_t checksum_at = 148, checksum_room = 8;

/// The sum of the header's bytes, with its own field as blanks.
std::uint64_t checksum_of(Span header) {
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < block; ++i)
        sum += i >= checksum_at && i < checksum_at + checksum_room
                   ? ' '
                   : std::to_integer<std::uint64_t>(header[i]);
    return sum;
}

/// The value of a key in pax records: "30 path=a/b.obj\\n".
std::string_view pax_value(std::string_view records, std::string_view key) {
    while (!records.empty()) {
        std::size_t length = 0;
        const auto [end, error] = std::from_chars(records.data(), records.data() + records.size(), length);
        const auto digits = static_cast<std::size_t>(end - records.data());
        if (error != std::errc() || length <= digits + 1 || length > records.size()) return {};
        std::string_view record = records.substr(digits + 1, length - digits - 2); // without the line end
        if (record.starts_with(key) && record.substr(key.size()).starts_with('='))
            return record.substr(key.size() + 1);
        records.remove_prefix(length);
    }
    return {};
}

std::string path_of(Span header) {
    const std::string_view name = text_at(header, 0, 100), prefix = text_at(header, 345, 155);
    const bool ustar = as_text(header.subspan(257, 6)) == std::string_view("ustar\0", 6);
    return ustar && !prefix.empty() ? fmt::format("{}/{}", prefix, name) : std::string(name);
}

} // namespace

void read_tar(Span archive, const std::string& name,
              const std::function<void(const std::string& path, Span bytes)>& take) {
    std::string long_path;                  // for the next file
    std::optional<std::uint64_t> long_size; // the same
    std::size_t at = 0;
    while (at < archive.size()) {
        if (archive.size() - at < block) fail(name, at, "the archive ends within a header");
        const Span header = archive.subspan(at, block);
        if (std::all_of(header.begin(), header.end(), [](std::byte b) { return b == std::byte{0}; })) return;
        if (tar_number(header, checksum_at, checksum_room) != checksum_of(header))
            fail(name, at, "the checksum of the header is wrong");
        const char type = static_cast<char>(header[156]);
        const bool is_header = type == 'x' || type == 'g' || type == 'L' || type == 'K';
        auto size = tar_number(header, 124, 12);
        if (!is_header && long_size) size = long_size;
        at += block;
        if (!size || *size > archive.size() - at) fail(name, at - block, "the file goes beyond the end");
        const Span bytes = archive.subspan(at, static_cast<std::size_t>(*size));
        at += std::min<std::size_t>(archive.size() - at, (bytes.size() + block - 1) / block * block);
        if (type == 'x') {
            long_path = pax_value(as_text(bytes), "path");
            const std::string_view digits = pax_value(as_text(bytes), "size");
            std::uint64_t value = 0;
            const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), value);
            if (!digits.empty() && read.ec == std::errc()) long_size = value;
        } else if (type == 'L') {
            long_path = text_at(bytes, 0, bytes.size());
        } else if (!is_header) {
            if (type == '0' || type == '\0' || type == '7')
                take(long_path.empty() ? path_of(header) : long_path, bytes);
            long_path.clear();
            long_size.reset();
        }
    }
}

namespace {

void put_header(std::string_view path, std::uint64_t size, char type, const std::function<void(Span)>& put) {
    std::string header(block, '\0');
    const auto set = [&](std::size_t at, std::string_view text) {
        std::copy(text.begin(), text.end(), header.begin() + static_cast<std::ptrdiff_t>(at));
    };
    set(0, path.substr(0, 100));
    set(100, "0000644");
    set(108, "0000000");
    set(116, "0000000");
    set(124, fmt::format("{:011o}", size));
    set(136, "00000000000");
    header[156] = type;
    set(257, std::string_view("ustar\00000", 8));
    const std::uint64_t sum = checksum_of(std::as_bytes(std::span(header)));
    set(checksum_at, fmt::format("{:06o}", sum) + std::string("\0 ", 2));
    put(std::as_bytes(std::span(header)));
}

void put_padded(Span bytes, const std::function<void(Span)>& put) {
    put(bytes);
    const Bytes padding((block - bytes.size() % block) % block);
    put(padding);
}

/// A pax record counts its own digits.
std::string pax_record(const std::string& key, const std::string& value) {
    std::size_t length = key.size() + value.size() + 3;
    std::string record;
    do {
        record = fmt::format("{} {}={}\n", length, key, value);
        length = record.size();
    } while (!record.starts_with(fmt::format("{} ", length)));
    return record;
}

} // namespace

void put_tar_file(const std::string& path, Span bytes, const std::function<void(Span)>& put) {
    constexpr std::uint64_t most = 0777777777777ULL; // 11 octal digits
    std::string pax;
    if (path.size() > 100) pax += pax_record("path", path);
    if (bytes.size() > most) pax += pax_record("size", std::to_string(bytes.size()));
    if (!pax.empty()) {
        put_header("pax", pax.size(), 'x', put);
        put_padded(std::as_bytes(std::span(pax)), put);
    }
    put_header(path, std::min<std::uint64_t>(bytes.size(), most), '0', put);
    put_padded(bytes, put);
}

void put_tar_end(const std::function<void(Span)>& put) { put(Bytes(2 * block)); }

} // namespace facetmill::io
