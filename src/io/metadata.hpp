#pragma once
// The metadata of a scene (title, copyright, licence, comments): the copyright and the extras of its
// documents' assets, as glTF has them.

#include "base/json.hpp"
#include "io/codec.hpp"

#include <set>

namespace facetmill::io {

/// The member of an asset's extras with the comments of a file that mean nothing to facetmill: a list of
/// texts.
inline constexpr const char* comments_key = "comments";

struct Metadata {
    std::string name; ///< "copyright", or a name in extras
    Json value;
};
/// The metadata of all documents, in their order. A name with several values occurs several times.
[[nodiscard]] std::vector<Metadata> metadata_of(const Scene& scene);

/// All metadata, each on a line of its own after `before`: "# Title: Gear". Comments have no name.
[[nodiscard]] std::string metadata_comments(const Scene& scene, std::string_view before);

/// Warns (W-LOST) once of contents that the format cannot hold: metadata, cameras, lights, other contents of
/// extensions, and extras. kept: metadata and extras that the format holds ("metadata": all, a name: its
/// first value).
void warn_of_lost(Written& written, const Scene& scene, const char* format,
                  const std::set<std::string>& kept);

} // namespace facetmill::io
