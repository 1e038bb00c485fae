#pragma once
// Writes buffer views with EXT_meshopt_compression and KHR_meshopt_compression.

#include "io/bytes.hpp"
#include "io/gltf/document/json.hpp"

#include <map>
#include <vector>

namespace facetmill::io::gltf {

/// How a view is compressed.
struct Packing {
    std::string mode;     ///< "ATTRIBUTES", "TRIANGLES" or "INDICES"
    std::string filter{}; ///< empty: none
    std::size_t stride = 0, count = 0;
    std::string kind{}; ///< non-empty: views of the same kind can be merged
};

/// [views] How each view can be compressed. Requires that only accessors of the same stride use the view.
/// TRIANGLES may rotate a triangle's corners, so it is not used if EXT_mesh_manifold counts corners.
[[nodiscard]] std::vector<std::optional<Packing>> packings(const Json& document,
                                                           const std::map<std::size_t, std::string>& filters);

/// Compresses the view's bytes to a stream. Attributes use this version: 0, or 1 (only in
/// KHR_meshopt_compression). Indices use version 1.
[[nodiscard]] Bytes encode_meshopt(Span bytes, const Packing& packing, int version);

/// The view's extension object, under either name; null if it has none.
[[nodiscard]] const Json* compression_of(const Json& view);

} // namespace facetmill::io::gltf
