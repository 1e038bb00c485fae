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

} // namespace

std::optional<std::size_t> read_some(const Descriptor& file, std::span<std::byte> to) {
    return uninterrupted([&] { return ::read(file.number(), to.data(), std::min(to.size(), most_at_once)); });
}

std::optional<std::size_t> read_some_at(const Descriptor& file, std::uint64_t offset,
                                        std::span<std::byte> to) {
    return uninterrupted(
        [&] { return ::pread(file.number(), to.data(), to.size(), static_cast<off_t>(offset)); });
}

std::optional<std::size_t> write_some(const Descriptor& file, std::span<const std::byte> bytes) {
    return uninterrupted([&] { return ::write(file.number(), bytes.data(), bytes.size()); });
}

std::optional<std::size_t> write_some_at(const Descriptor& file, std::uint64_t offset,
                                         std::span<const std::byte> bytes) {
    return uninterrupted(
        [&] { return ::pwrite(file.number(), bytes.data(), bytes.size(), static_cast<off_t>(offset)); });
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
