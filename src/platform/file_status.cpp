#include "platform/file_status.hpp"

#include <algorithm>
#include <chrono>
#include <sys/stat.h>
#include <unistd.h>

namespace facetmill {

namespace {

constexpr std::int64_t nanoseconds = 1'000'000'000; // nanoseconds in a second

std::int64_t time_in(const timespec& time) {
    return std::int64_t{time.tv_sec} * nanoseconds + std::int64_t{time.tv_nsec};
}

FileKind kind_of(mode_t mode) {
    return S_ISREG(mode)                    ? FileKind::regular
           : S_ISDIR(mode)                  ? FileKind::folder
           : S_ISFIFO(mode)                 ? FileKind::pipe
           : S_ISCHR(mode) || S_ISBLK(mode) ? FileKind::device
                                            : FileKind::other;
}

FileStatus status_in(const struct stat& about) {
    return {kind_of(about.st_mode),
            {static_cast<std::uint64_t>(about.st_size), about.st_dev, about.st_ino, time_in(about.st_mtim),
             time_in(about.st_ctim)},
            about.st_uid,
            about.st_gid,
            about.st_mode & 07777U};
}

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
    constexpr std::int64_t coarsest = 2 * nanoseconds; // the time resolution of FAT
    return std::max(modified, changed) + coarsest < now;
}

bool FileStatus::is_own() const { return owner == ::geteuid(); }

std::optional<FileStatus> status_of(const std::filesystem::path& path) {
    struct stat about {};
    return ::stat(path.c_str(), &about) == 0 ? std::optional(status_in(about)) : std::nullopt;
}

std::optional<FileStatus> status_of(const Descriptor& file) {
    struct stat about {};
    return ::fstat(file.number(), &about) == 0 ? std::optional(status_in(about)) : std::nullopt;
}

std::optional<FileStatus> status_of_link(const std::filesystem::path& path) {
    struct stat about {};
    return ::lstat(path.c_str(), &about) == 0 ? std::optional(status_in(about)) : std::nullopt;
}

void take_permissions(const Descriptor& file, const FileStatus& from) {
    const bool owned =
        (from.is_own() && from.group == ::getegid()) || ::fchown(file.number(), from.owner, from.group) == 0;
    ::fchmod(file.number(), from.permissions & (owned ? 07777U : 0777U));
}

std::int64_t nanoseconds_now() {
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    return std::chrono::duration_cast<std::chrono::nanoseconds>(now).count();
}

} // namespace facetmill
