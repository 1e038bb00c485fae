#pragma once
// Distinguishes a deleted source from an unmounted disk. Outputs of the latter are not pruned.

#include <filesystem>
#include <string>

namespace facetmill::batch {

/// The mount point of a file's file system, with links resolved; empty if unknown.
std::string mount_point_of(const std::filesystem::path& file);

enum class Presence {
    there,        ///< or its presence cannot be determined
    out_of_reach, ///< its file system is not mounted, or a link above it is broken
    gone
};
/// source: absolute. mount_point: of the source when it was read; empty: unknown.
Presence presence_of(const std::filesystem::path& source, const std::string& mount_point);

} // namespace facetmill::batch
