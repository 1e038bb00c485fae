#pragma once
// Buffer views under EXT_meshopt_compression and KHR_meshopt_compression, as they are written.

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
    std::string kind{}; ///< views of the same kind, not empty, can be one view
};

/// For each view of the document how it can be compressed: views that nothing but accessors of one stride
/// names. TRIANGLES may begin a triangle with another corner, so it is not used where EXT_mesh_manifold
/// counts corners.
std::vector<std::optional<Packing>> packings(const Json& document,
                                             const std::map<std::size_t, std::string>& filters);

/// The view's bytes as a stream: attributes in this version, 0 or 1 (KHR_meshopt_compression alone has 1),
/// indices in version 1.
Bytes encode_meshopt(Span bytes, const Packing& packing, int version);

/// The extension's object in a view, of either name; null when there is none.
const Json* compression_of(const Json& view);

} // namespace facetmill::io::gltf
