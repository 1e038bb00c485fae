#include "platform/file_bytes.hpp"

#include <algorithm>
#include <cerrno>
#include <fcntl.h>
#include <unistd.h>

namespace facetmill {

namespace {

constexpr std::size_t most_at_once = std::size_t{1} << 30;

/// Repeats the call while signals interrupt it.
template <class Call>
std::optional<std::size_t> uninterrupted(Call&& call) {
    while (true) {
        const ssize_t n = call();
        if (n >= 0) return static_cast<std::size_t>(n);
        if (errno != EINTR) return {};
    }
}

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

std::optional<std::size_t> read_some(const Descriptor& file, std::span<std::byte> to) {
    return uninterrupted([&] { return ::read(file.number(), to.data(), std::min(to.size(), most_at_once)); });
}

std::size_t read_whole(const Descriptor& file, std::span<std::byte> to) {
    return filled(to, [&](std::span<std::byte> rest, std::size_t) { return read_some(file, rest); });
}

std::size_t read_at(const Descriptor& file, std::uint64_t offset, std::span<std::byte> to) {
    return filled(to, [&](std::span<std::byte> rest, std::size_t done) {
        return uninterrupted([&] {
            return ::pread(file.number(), rest.data(), rest.size(), static_cast<off_t>(offset + done));
        });
    });
}

std::optional<std::size_t> write_some(const Descriptor& file, std::span<const std::byte> bytes) {
    return uninterrupted([&] { return ::write(file.number(), bytes.data(), bytes.size()); });
}

bool write_at(const Descriptor& file, std::uint64_t offset, std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const auto n = uninterrupted(
            [&] { return ::pwrite(file.number(), bytes.data(), bytes.size(), static_cast<off_t>(offset)); });
        if (!n) return false;
        bytes = bytes.subspan(*n);
        offset += *n;
    }
    return true;
}

void begin_sync([[maybe_unused]] const Descriptor& file) {
#ifdef SYNC_FILE_RANGE_WRITE
    ::sync_file_range(file.number(), 0, 0, SYNC_FILE_RANGE_WRITE);
#endif
}

bool synced(const Descriptor& file) {
    const bool done = uninterrupted([&] { return ::fsync(file.number()); }).has_value();
    return done || errno == EINVAL || errno == ENOTSUP || errno == EROFS;
}

} // namespace facetmill
