#include "batch/reach.hpp"

#include "platform/file_status.hpp"

namespace facetmill::batch {

namespace fs = std::filesystem;

namespace {

std::optional<std::uint64_t> device_of(const fs::path& path) {
    const auto about = FileStamp::of(path);
    return about ? std::optional(about->device) : std::nullopt;
}

bool is_mount_point(const fs::path& folder) {
    const auto device = device_of(folder);
    return device && (folder == folder.root_path() || device != device_of(folder.parent_path()));
}

bool leads_nowhere(const fs::path& path) {
    std::error_code ignored;
    return fs::is_symlink(fs::symlink_status(path, ignored)) && !fs::exists(path, ignored);
}

} // namespace

std::string mount_point_of(const fs::path& file) {
    std::error_code error;
    fs::path folder = fs::canonical(file, error).parent_path();
    if (error) return {};
    while (!is_mount_point(folder) && folder.has_relative_path()) folder = folder.parent_path();
    return folder.generic_string();
}

Presence presence_of(const fs::path& source, const std::string& mount_point) {
    std::error_code ignored;
    if (source.empty() || fs::status(source, ignored).type() != fs::file_type::not_found)
        return Presence::there;
    if (!mount_point.empty() && !is_mount_point(mount_point)) return Presence::out_of_reach;
    for (fs::path above = source; above.has_relative_path(); above = above.parent_path())
        if (leads_nowhere(above)) return Presence::out_of_reach;
    return Presence::gone;
}

} // namespace facetmill::batch
