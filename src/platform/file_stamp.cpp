#include "platform/file_status.hpp"

#include <algorithm>
#include <chrono>

namespace facetmill {

namespace {

std::optional<FileStamp> stamp_in(const std::optional<FileStatus>& status) {
    return status ? std::optional(status->stamp) : std::nullopt;
}

} // namespace

std::optional<FileStamp> FileStamp::of(const std::filesystem::path& path) {
    return stamp_in(status_of(path));
}

std::optional<FileStamp> FileStamp::of(const Descriptor& file) { return stamp_in(status_of(file)); }

bool FileStamp::has_contents_of(const FileStamp& other) const {
    FileStamp same = *this;
    same.changed = other.changed;
    return same == other;
}

bool FileStamp::is_settled(std::int64_t now) const {
    constexpr std::int64_t coarsest = 2'000'000'000; // the time resolution of FAT, in nanoseconds
    return std::max(modified, changed) + coarsest < now;
}

std::int64_t nanoseconds_now() {
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    return std::chrono::duration_cast<std::chrono::nanoseconds>(now).count();
}

} // namespace facetmill
