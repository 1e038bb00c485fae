#pragma once
// The release and its libraries, as CMake found them at build time (cmake/Versions.cmake).

#include <string_view>
#include <vector>

namespace facetmill::docs {

struct LibraryVersion {
    std::string_view name, version;
};

[[nodiscard]] std::string_view release();
const std::vector<LibraryVersion>& library_versions();

/// The Debian source packages that a static executable has parts of, with their versions; empty for a shared
/// one.
const std::vector<LibraryVersion>& linked_sources();

} // namespace facetmill::docs
