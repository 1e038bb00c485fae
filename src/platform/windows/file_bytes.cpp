#include "platform/file_bytes.hpp"

#include "platform/windows/handle.hpp"
#include "platform/windows/last_error.hpp"

#include <algorithm>
#include <cerrno>

namespace facetmill {

namespace {

DWORD at_once(std::size_t bytes) {
    constexpr std::size_t most = std::size_t{1} << 30;
    return static_cast<DWORD>(std::min(bytes, most));
}

OVERLAPPED position(std::uint64_t offset) {
    OVERLAPPED at{};
    at.Offset = static_cast<DWORD>(offset);
    at.OffsetHigh = static_cast<DWORD>(offset >> 32);
    return at;
}

std::optional<std::size_t> read_from(const Descriptor& file, std::span<std::byte> to, OVERLAPPED* at) {
    DWORD got = 0;
    if (::ReadFile(handle_of(file), to.data(), at_once(to.size()), &got, at)) return got;
    const DWORD error = ::GetLastError();
    if (error == ERROR_HANDLE_EOF || error == ERROR_BROKEN_PIPE) return 0;
    failed_by_last_error();
    return {};
}

std::optional<std::size_t> write_to(const Descriptor& file, std::span<const std::byte> bytes,
                                    OVERLAPPED* at) {
    DWORD put = 0;
    if (::WriteFile(handle_of(file), bytes.data(), at_once(bytes.size()), &put, at)) return put;
    failed_by_last_error();
    return {};
}

} // namespace

std::optional<std::size_t> read_some(const Descriptor& file, std::span<std::byte> to) {
    return read_from(file, to, nullptr);
}

std::optional<std::size_t> read_some_at(const Descriptor& file, std::uint64_t offset,
                                        std::span<std::byte> to) {
    OVERLAPPED at = position(offset);
    return read_from(file, to, &at);
}

std::optional<std::size_t> write_some(const Descriptor& file, std::span<const std::byte> bytes) {
    return write_to(file, bytes, nullptr);
}

std::optional<std::size_t> write_some_at(const Descriptor& file, std::uint64_t offset,
                                         std::span<const std::byte> bytes) {
    OVERLAPPED at = position(offset);
    return write_to(file, bytes, &at);
}

void begin_sync(const Descriptor&) {}

bool synced(const Descriptor& file) {
    if (::FlushFileBuffers(handle_of(file))) return true;
    // Names in folders need no sync: NTFS keeps a journal of them, and a folder cannot be flushed.
    failed_by_last_error();
    return errno == EACCES || errno == EINVAL || errno == ENOTSUP || errno == EROFS;
}

} // namespace facetmill
