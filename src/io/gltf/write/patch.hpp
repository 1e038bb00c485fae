#pragma once
// Writes the parts of a scene into a document under construction: meshes, nodes, transforms, materials.

#include "io/gltf/document/builder.hpp"
#include "io/gltf/document/nodes.hpp"

#include "io/codec.hpp"

namespace facetmill::io::gltf {

/// State that all phases of writing share.
struct Patch {
    const Scene& scene;
    const WriteSettings& settings;
    Builder& builder;
    Written& written;
    int base; ///< the document being patched, or -1

    void warn(const char* id, std::string message, std::string hint = {}) {
        written.warnings.push_back({Severity::warning, id, std::move(message), {}, std::move(hint)});
    }
};

// Each phase takes the result of the phase before it.

/// The document as read, with moved skeletons, and the part at each placement.
struct Claims {
    std::vector<NodeFrame> frames{};
    std::map<std::size_t, Transform> above{}; ///< matrices of new nodes above roots
    std::vector<Placement> placements{};      ///< the parts as read
    std::map<int, Transform>
        largest_instances{};    ///< by node: the largest of several instances, relative to the node
    std::vector<int> claimed{}; ///< the part at each placement, or -1
};

/// For each image copied from another document, that document.
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

/// The meshes after all attributes have their final form.
struct StoredMeshes {
    ImageOwners images;
};

/// The materials and textures copied into the document so far.
struct MaterialCopies {
    Patch& patch;
    std::map<Index, int> materials{}; ///< by scene material, index in the document
    std::map<std::pair<int, std::size_t>, std::size_t>
        copied{};                 ///< indices of copied textures, samplers and images
    std::map<int, Json> others{}; ///< parsed JSON of other documents
    ImageOwners images{};
};

/// The scene with moved skinned parts in world space and identity transforms, because glTF ignores the
/// transform of a skinned mesh. skin_moves: how far each skin of the base document has moved. A part is no
/// longer skinned if its skin, or a skeleton with common joints, has already moved differently (W-SKIN).
[[nodiscard]] Scene in_bind_pose(Scene scene, int base, std::map<std::size_t, Transform>& skin_moves,
                                 std::vector<Diagnostic>& warnings);
/// Moves skeletons with their skins. A node above their roots gets the movement, and the inverse bind
/// matrices cancel it. Joints and animations stay unchanged.
void move_skins(Patch& patch, Claims& claims, const std::map<std::size_t, Transform>& skin_moves);
/// Inserts a node with this matrix above a node.
void move_from_above(Patch& patch, std::size_t node, const Transform& by);

/// Finds the part at each placement of the document, and moves skeletons.
[[nodiscard]] Claims claim_placements(Patch& patch, const std::map<std::size_t, Transform>& skin_moves);
/// Writes the meshes of all parts. Equal instances share a mesh; otherwise each variant gets a separate
/// mesh.
[[nodiscard]] PartMeshes patch_meshes(Patch& patch, Claims claims);
/// Assigns meshes to nodes, adds nodes for new parts, and updates names and transforms. Parts X.lod1, X.lod2,
/// ... become levels of X (MSFT_lod): outside the scene, under X's parent. Drops meshes that no part uses.
[[nodiscard]] PartNodes patch_nodes(Patch& patch, PartMeshes meshes);
/// Drops meshes that the document placed and that no part uses.
void drop_dead_meshes(Patch& patch, const PartMeshes& meshes);

/// With quantize or meshopt's filters, stores the attributes of all meshes in their rounded forms. The grid
/// of a mesh's positions goes into its nodes' transforms. If an animation, a camera, children or others
/// depend on a node, the grid goes into a new child node. For several instances (EXT_mesh_gpu_instancing),
/// the grid's origin goes into each of them. Positions of meshes with a skin or without a node stay float32,
/// which the changes record.
[[nodiscard]] StoredMeshes store_meshes(Patch& patch, PartNodes nodes);
/// For meshopt: moves animations, instances and bind matrices into views that can be compressed. Rotations
/// have 16 bits. Animated translations and scales have steps of at most 2^-16 of their largest extent. With
/// quantize, both may be coarser, as long as no vertex moves by more than the step of its grid.
/// Instances are exact to a quarter of a step of their mesh's grid, or to the float32 precision of the
/// largest instance.
void store_streams(Patch& patch, const StoredMeshes& meshes);

/// Without meshopt, stores morph targets as sparse accessors where that is smaller.
void store_sparse_targets(Patch& patch, const StoredMeshes& meshes);

/// If requested, interleaves the attributes of each primitive in a view, or in several views beyond 252
/// bytes per vertex. Primitives that share an attribute share the view. Morph targets, sparse attributes and
/// Draco's attributes stay unchanged.
void interleave_attributes(Patch& patch, const StoredMeshes& meshes);

/// The document's index of a scene material, which is added if new; -1 for none.
[[nodiscard]] int patch_material(MaterialCopies& copies, Index material);

/// KHR_materials_variants of a primitive with the document's numbers. Variants of another document follow
/// those of the document, by name. document: of the primitive's part. Null if no material is known.
[[nodiscard]] Json patch_variants(MaterialCopies& copies, const Primitive& primitive, int document,
                                  const Json& extension);

/// Places image files according to the settings: in the document's buffer views, next to it under new names,
/// or at their original location. Returns the files to write next to the output. stem: the output's stem;
/// new file names start with it.
[[nodiscard]] std::vector<OutputFile> place_images(Patch& patch, const ImageOwners& owners,
                                                   const std::string& stem, Textures textures);

/// True if geometry, attributes and primitives are equal, bit for bit; `same_material` compares materials.
bool same_mesh(const Mesh& a, const Mesh& b, const std::function<bool(Index, Index)>& same_material);

} // namespace facetmill::io::gltf
