#pragma once
// Distinguishes a deleted source from a missing disk: outputs of the latter are not pruned.

#include <filesystem>
#include <string>

namespace facetmill::batch {

/// The mount point of a file's file system, with links resolved; empty if unknown.
[[nodiscard]] std::string mount_point_of(const std::filesystem::path& file);

enum class Presence {
    there,        ///< also if it cannot be checked
    out_of_reach, ///< its disk is not mounted, or a link in its path is broken
    gone
};
/// source: absolute. mount_point: of the source when it was read; empty: unknown.
[[nodiscard]] Presence presence_of(const std::filesystem::path& source, const std::string& mount_point);

} // namespace facetmill::batch
