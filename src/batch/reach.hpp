#pragma once
// Whether the source of an asset is gone, or only its disk: what is made of the latter is not pruned.

#include <filesystem>
#include <string>

namespace facetmill::batch {

/// Where the file system of a file is mounted, links resolved; empty when that cannot be told.
std::string mount_point_of(const std::filesystem::path& file);

enum class Presence {
    there,        ///< or it cannot be looked for
    out_of_reach, ///< what it was on is not mounted, or a link above it leads nowhere
    gone
};
/// source: absolute. mount_point: of the source when it was read; empty: not known.
Presence presence_of(const std::filesystem::path& source, const std::string& mount_point);

} // namespace facetmill::batch
