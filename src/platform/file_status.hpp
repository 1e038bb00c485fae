#pragma once
// What the system says of a file.

#include "platform/descriptor.hpp"

#include <cstdint>
#include <optional>

namespace facetmill {

/// Which file it is, its size and its times.
struct FileStamp {
    std::uint64_t bytes = 0, device = 0, inode = 0;
    std::int64_t modified = 0, changed = 0; ///< nanoseconds since 1970, of its contents and of anything of it
    bool operator==(const FileStamp&) const = default;

    /// None where there is no such file.
    static std::optional<FileStamp> of(const std::filesystem::path& path);
    static std::optional<FileStamp> of(const Descriptor& file);
    bool is_same_file(const FileStamp& other) const { return device == other.device && inode == other.inode; }
    /// Whether it tells of the same contents; another name, owner or number of links is no other.
    bool has_contents_of(const FileStamp& other) const;
    /// Whether a file that is written to at that time, or later, gets other times, also where the system
    /// counts in seconds.
    bool is_settled(std::int64_t now) const;
};

enum class FileKind { regular, folder, pipe, device, other };

struct FileStatus {
    FileKind kind = FileKind::other;
    FileStamp stamp;
    unsigned owner = 0, group = 0, permissions = 0;
    /// Whether it belongs to the user whose rights this process has.
    bool is_own() const;
};

/// None, with errno, where there is no such file.
std::optional<FileStatus> status_of(const std::filesystem::path& path);
std::optional<FileStatus> status_of(const Descriptor& file);
/// ... of a link itself.
std::optional<FileStatus> status_of_link(const std::filesystem::path& path);

/// Gives an open file the permissions, and as far as allowed the owner, of another.
void take_permissions(const Descriptor& file, const FileStatus& from);

/// By the clock that files have their times from: nanoseconds since 1970.
std::int64_t nanoseconds_now();

} // namespace facetmill
