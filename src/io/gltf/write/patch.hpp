#pragma once
// The parts of a scene put into a document under construction: meshes, nodes, transforms, materials.

#include "io/gltf/document/builder.hpp"
#include "io/gltf/document/nodes.hpp"

#include "io/codec.hpp"

namespace facetmill::io::gltf {

/// What all phases of writing share.
struct Patch {
    const Scene& scene;
    const WriteSettings& settings;
    Builder& builder;
    Written& written;
    int base; ///< the document that is patched, or -1 when there is none
    const bool of_points = scene.face_count() == 0; ///< no part has faces: vertices are written as points

    void warn(const char* id, std::string message, std::string hint = {}) {
        written.warnings.push_back({Severity::warning, id, std::move(message), {}, std::move(hint)});
    }
};

// Each phase takes the result of the phase before it.

/// The document as read, and which part has which place in it. Skeletons that move have moved.
struct Claims {
    std::vector<NodeFrame> frames{};
    std::map<std::size_t, Transform> above{};     ///< the matrices of new nodes above roots
    std::vector<Placement> placements{};          ///< its parts as read
    std::map<int, Transform> largest_instances{}; ///< of nodes that have several, seen from them
    std::vector<int> claimed{};                   ///< the part that has each placement, or -1
};

/// By image that was copied from another document, this document.
using ImageOwners = std::map<std::size_t, int>;

struct PartMeshes {
    Claims claims;
    std::vector<int> of_part; ///< -1 for parts without faces
    ImageOwners images;
};

struct PartNodes {
    std::vector<int> of_part; ///< -1 for parts of a document without nodes
    ImageOwners images;
};

/// All attributes have their final form.
struct StoredMeshes {
    ImageOwners images;
};

/// Materials and their textures that were copied into the document so far.
struct MaterialCopies {
    Patch& patch;
    std::map<Index, int> materials{}; ///< the document's index of each scene material
    std::map<std::pair<int, std::size_t>, std::size_t> copied{}; ///< textures, samplers, images
    std::map<int, Json> others{};                                ///< other documents, parsed
    ImageOwners images{};
};

/// The scene with skinned parts that have moved where they are now, their transforms the identity, since glTF
/// gives a skinned mesh none; and how far each skin of the base document has moved. A part whose skin, or a
/// skeleton that shares joints with it, has moved elsewhere already is skinned no longer (W-SKIN).
Scene in_bind_pose(Scene scene, int base, std::map<std::size_t, Transform>& skin_moves,
                   std::vector<Diagnostic>& warnings);
/// Moves skeletons along with their skins: a node above their roots has the move, the inverse bind matrices
/// take it off again, and joints and animations stay as they are.
void move_skins(Patch& patch, Claims& claims, const std::map<std::size_t, Transform>& skin_moves);
/// Gives a node a new one above it that has this matrix.
void move_from_above(Patch& patch, std::size_t node, const Transform& by);

/// Finds which part has which place in the document, and moves skeletons.
Claims claim_placements(Patch& patch, const std::map<std::size_t, Transform>& skin_moves);
/// Writes the meshes of all parts. Instances that still agree share a mesh; when they do not, each variant
/// gets its own.
PartMeshes patch_meshes(Patch& patch, Claims claims);
/// Points nodes at their meshes, adds nodes for new parts, renames, and moves what has moved. Makes the nodes
/// of parts X.lod1, X.lod2, ... levels of X's (MSFT_lod): out of the scene, under X's parent. Drops meshes
/// that no part uses any more.
PartNodes patch_nodes(Patch& patch, PartMeshes meshes);
/// Drops meshes that the document placed and that no part uses any more.
void drop_dead_meshes(Patch& patch, const PartMeshes& meshes);

/// Stores the attributes of all meshes as quantize says, and as meshopt's filters want them. The grid of a
/// mesh's positions goes into the transforms of its nodes, or of new nodes below them where an animation, a
/// camera, children or whatever else depends on the node itself; where the node has its mesh at many places
/// (EXT_mesh_gpu_instancing), the grid's origin goes into each of these. Positions of meshes with a skin or
/// without a node stay float32, which is said in the changes.
StoredMeshes store_meshes(Patch& patch, PartNodes nodes);
/// Under meshopt: puts animations, instances and bind matrices into views that can be compressed, rotations
/// in 16 bits, translations and scales of animations in steps of 2^-16 of their greatest extent or less,
/// those of instances within a quarter of a step of their mesh's grid, or as float32 has the largest.
void store_streams(Patch& patch, const StoredMeshes& meshes);

/// Where the settings say so, puts the attributes of each primitive into one view, a vertex after another;
/// into several where a vertex has more than 252 bytes. Primitives that share an attribute share the view.
/// Morph targets, sparse attributes and those of Draco stay as they are.
void interleave_attributes(Patch& patch, const StoredMeshes& meshes);

/// The document's index for a scene material, added when it is new; -1 for none.
int patch_material(MaterialCopies& copies, Index material);

/// Puts the images that the document names as files where the settings say: among the document's buffer
/// views, beside it under new names, or by their place. Returns those that go beside the output, whose stem
/// and whose own files are told.
std::vector<OutputFile> place_images(Patch& patch, const ImageOwners& owners, const std::string& stem,
                                     Textures textures);

/// Same geometry, attributes and primitives, bit for bit; materials compared by `same_material`.
bool same_mesh(const Mesh& a, const Mesh& b, const std::function<bool(Index, Index)>& same_material);

} // namespace facetmill::io::gltf
