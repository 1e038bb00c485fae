#pragma once
// The status of files.

#include "platform/descriptor.hpp"

#include <cstdint>
#include <optional>

namespace facetmill {

/// The identity of a file, its size and its times.
struct FileStamp {
    std::uint64_t bytes = 0, device = 0, inode = 0;
    std::int64_t modified = 0,
                 changed = 0; ///< times of its contents and of its metadata, in nanoseconds since 1970
    bool operator==(const FileStamp&) const = default;

    /// The stamp of a file; none if it does not exist.
    static std::optional<FileStamp> of(const std::filesystem::path& path);
    static std::optional<FileStamp> of(const Descriptor& file);
    bool is_same_file(const FileStamp& other) const { return device == other.device && inode == other.inode; }
    /// True if the contents are the same; the name, owner and number of links may differ.
    bool has_contents_of(const FileStamp& other) const;
    /// True if any write from this time on will change the file's times, even if the system counts in
    /// seconds.
    bool is_settled(std::int64_t now) const;
};

enum class FileKind { regular, folder, pipe, device, other };

struct FileStatus {
    FileKind kind = FileKind::other;
    FileStamp stamp;
    unsigned owner = 0, group = 0, permissions = 0;
    /// True if it belongs to the user of this process.
    bool is_own() const;
};

/// The status of a file; none, with errno, if it does not exist.
[[nodiscard]] std::optional<FileStatus> status_of(const std::filesystem::path& path);
[[nodiscard]] std::optional<FileStatus> status_of(const Descriptor& file);
/// The status of a link itself.
[[nodiscard]] std::optional<FileStatus> status_of_link(const std::filesystem::path& path);

/// Copies the permissions, and if allowed the owner, to an open file.
void take_permissions(const Descriptor& file, const FileStatus& from);

/// The current time of the clock that file times use: nanoseconds since 1970.
[[nodiscard]] std::int64_t nanoseconds_now();

} // namespace facetmill
