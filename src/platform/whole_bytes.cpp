#include "platform/file_bytes.hpp"

namespace facetmill {

namespace {

/// Repeats take until the span is full, or it returns no more bytes.
template <class Take>
std::size_t filled(std::span<std::byte> to, Take&& take) {
    std::size_t done = 0;
    while (done < to.size()) {
        const auto n = take(to.subspan(done), done);
        if (!n || *n == 0) break;
        done += *n;
    }
    return done;
}

} // namespace

std::size_t read_whole(const Descriptor& file, std::span<std::byte> to) {
    return filled(to, [&](std::span<std::byte> rest, std::size_t) { return read_some(file, rest); });
}

std::size_t read_at(const Descriptor& file, std::uint64_t offset, std::span<std::byte> to) {
    return filled(to, [&](std::span<std::byte> rest, std::size_t done) {
        return read_some_at(file, offset + done, rest);
    });
}

bool write_at(const Descriptor& file, std::uint64_t offset, std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const auto n = write_some_at(file, offset, bytes);
        if (!n) return false;
        bytes = bytes.subspan(*n);
        offset += *n;
    }
    return true;
}

} // namespace facetmill
