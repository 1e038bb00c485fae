#pragma once
// The parts of a scene put into a document under construction: meshes, nodes, transforms, materials.

#include "io/gltf/builder.hpp"
#include "io/gltf/nodes.hpp"

#include "io/codec.hpp"

namespace facetmill::io::gltf {

/// A scene being written.
struct Patch {
    const Scene& scene;
    const WriteSettings& settings;
    Builder& builder;
    Written& written;
    int base; ///< the document that is patched: 0, or -1 when there is none

    std::vector<NodeFrame> frames{};     ///< of the document as read
    std::vector<Placement> placements{}; ///< its parts as read
    std::vector<int> claimed{};          ///< the part that stands at each placement, or -1
    std::map<Index, int> materials{};    ///< document's index of each scene material used so far
    std::map<std::pair<int, std::size_t>, std::size_t>
        copied{};                         ///< textures, samplers, images of other documents
    std::map<int, Json> others{};         ///< other documents, parsed
    std::map<std::string, Bytes> files{}; ///< images beside the output, by URI

    void warn(const char* id, std::string message, std::string hint = {}) {
        written.warnings.push_back({Severity::warning, id, std::move(message), {}, std::move(hint)});
    }
};

/// Finds which part stands where the document has one. Call it first.
void claim_placements(Patch& patch);
/// Writes the meshes of all parts. Returns each part's mesh index, -1 for parts without faces. Instances that
/// still agree share a mesh; when they do not, each variant gets its own.
std::vector<int> patch_meshes(Patch& patch);
/// Points nodes at their meshes, adds nodes for new parts, renames, and moves what has moved. Returns each
/// part's node, -1 for those of a document without nodes.
std::vector<int> patch_nodes(Patch& patch, const std::vector<int>& mesh_of_part);
/// Makes the nodes of parts X.lod1, X.lod2, ... levels of X's (MSFT_lod): out of the scene, under X's parent.
void patch_levels(Patch& patch, const std::vector<int>& node_of_part);
/// Drops meshes that the document placed and that no part uses any more.
void drop_dead_meshes(Patch& patch, const std::vector<int>& mesh_of_part);

/// The document's index for a scene material, added when it is new; -1 for none.
int patch_material(Patch& patch, Index material);

/// Same geometry, attributes and primitives, bit for bit; materials compared by `same_material`.
bool same_mesh(const Mesh& a, const Mesh& b, const std::function<bool(Index, Index)>& same_material);

} // namespace facetmill::io::gltf
