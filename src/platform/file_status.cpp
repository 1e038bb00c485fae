#include "platform/file_status.hpp"

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

} // namespace

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

} // namespace facetmill
