#pragma once
// The parts of a scene put into a document under construction: meshes, nodes, transforms, materials.

#include "io/gltf/document/builder.hpp"
#include "io/gltf/document/nodes.hpp"

#include "io/codec.hpp"

namespace facetmill::io::gltf {

/// A scene being written.
struct Patch {
    const Scene& scene;
    const WriteSettings& settings;
    Builder& builder;
    Written& written;
    int base; ///< the document that is patched, or -1 when there is none
    const bool of_points = scene.face_count() == 0; ///< no part has faces: vertices are written as points

    std::vector<NodeFrame> frames{};          ///< of the document as read, moved skeletons where they are now
    std::map<std::size_t, Transform> above{}; ///< the matrices of new nodes above roots
    std::vector<Placement> placements{};      ///< its parts as read
    std::map<int, Transform> largest_instances{}; ///< of nodes that have several, seen from them
    std::vector<int> claimed{};                   ///< the part that stands at each placement, or -1
    std::map<std::size_t, int> bits_of_node{};    ///< of the positions of its mesh, where they are on a grid
    std::map<std::size_t, Lattice> lattice_of_node{}; ///< of those that have one
    std::map<Index, int> materials{};                 ///< document's index of each scene material used so far
    std::map<std::pair<int, std::size_t>, std::size_t>
        copied{};                                ///< textures, samplers, images of other documents
    std::map<int, Json> others{};                ///< other documents, parsed
    std::map<std::size_t, int> image_document{}; ///< where images come from, when not from the base

    void warn(const char* id, std::string message, std::string hint = {}) {
        written.warnings.push_back({Severity::warning, id, std::move(message), {}, std::move(hint)});
    }
};

/// The scene with skinned parts that have moved where they are now, their transforms the identity, since glTF
/// gives a skinned mesh none; and how far each skin of the base document has moved. A part whose skin, or a
/// skeleton that shares joints with it, has moved elsewhere already is skinned no longer (W-SKIN).
Scene in_bind_pose(Scene scene, int base, std::map<std::size_t, Transform>& skin_moves,
                   std::vector<Diagnostic>& warnings);
/// Moves skeletons along with their skins: a node above their roots has the move, the inverse bind matrices
/// take it off again, and joints and animations stay as they are. After claim_placements, before patch_nodes.
void move_skins(Patch& patch, const std::map<std::size_t, Transform>& skin_moves);
/// Gives a node a new one above it that has this matrix.
void move_from_above(Patch& patch, std::size_t node, const Transform& by);

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

/// Stores the attributes of all meshes as quantize says, and as meshopt's filters want them. The grid of a
/// mesh's positions goes into the transforms of its nodes, or of new nodes below them where an animation, a
/// camera, children or whatever else depends on the node itself; where the node has its mesh at many places
/// (EXT_mesh_gpu_instancing), the grid's origin goes into each of these. Positions of meshes with a skin or
/// without a node stay float32, which is said in the changes. After patch_nodes and patch_levels.
void store_meshes(Patch& patch);
/// Under meshopt: puts animations, instances and bind matrices into views that can be compressed, rotations
/// in 16 bits, translations and scales of animations in steps of 2^-16 of their greatest extent or less,
/// those of instances within a quarter of a step of their mesh's grid, or as float32 has the largest.
void store_streams(Patch& patch);

/// Where the settings say so, puts the attributes of each primitive into one view, a vertex after another;
/// into several where a vertex has more than 252 bytes. Primitives that share an attribute share the view.
/// Morph targets, sparse attributes and those of Draco stay as they are. After store_meshes.
void interleave_attributes(Patch& patch);

/// The document's index for a scene material, added when it is new; -1 for none.
int patch_material(Patch& patch, Index material);

/// Puts the images that the document names as files where the settings say: among the document's buffer
/// views, beside it under new names, or by their place. Returns those that go beside the output, whose stem
/// and whose own files are told.
std::vector<OutputFile> place_images(Patch& patch, const std::string& stem, Textures textures);

/// Same geometry, attributes and primitives, bit for bit; materials compared by `same_material`.
bool same_mesh(const Mesh& a, const Mesh& b, const std::function<bool(Index, Index)>& same_material);

} // namespace facetmill::io::gltf
