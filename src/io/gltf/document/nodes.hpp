#pragma once
// The node hierarchy of a glTF document, with the world transform of each mesh.

#include "io/gltf/document/json.hpp"
#include "mesh/scene.hpp"
#include "mesh/transform.hpp"

#include <array>
#include <functional>
#include <set>

namespace facetmill::io::gltf {

inline constexpr const char* instancing_extension = "EXT_mesh_gpu_instancing";

/// A node of the hierarchy.
struct NodeFrame {
    Transform local, world;
    int parent = -1;
    int mesh = -1;
    bool skinned = false;
};

/// Scales, then rotates by a quaternion (x, y, z, w) of any length (zero: no rotation), then translates.
[[nodiscard]] Transform transform_of(const Vec3& move, const std::array<double, 4>& turn, const Vec3& scale);

/// The transform of a node relative to its parent. Throws malformed (E-GLTF).
[[nodiscard]] Transform local_transform(const JsonCursor& node);

/// Takes a warning's id and message.
using Warn = std::function<void(const char*, std::string)>;
/// All nodes, by index. Throws a malformed-input error (E-NODES) for cycles, E-GLTF for invalid members.
/// Warns (W-NODES) about nodes with two parents.
[[nodiscard]] std::vector<NodeFrame> node_frames(const Json& document, const Warn& warn = {});
/// The node indices, parents before children.
[[nodiscard]] std::vector<std::size_t> parents_first(const std::vector<NodeFrame>& frames);

/// Leaves nodes with several parents under the first only, as node_frames does. Returns true if the document
/// has changed.
bool drop_further_parents(Json& document, const std::vector<NodeFrame>& frames);

/// [nodes] true if the scene that viewers show (`scene`, or the first) contains the node, or if it is a level
/// of detail of such a node. All nodes if the document has no scenes. Invalid references are skipped.
[[nodiscard]] std::vector<bool> shown_nodes(const Json& document);

/// The nodes whose translation, rotation or scale an animation drives, also by KHR_animation_pointer.
[[nodiscard]] std::set<std::size_t> animated_nodes(const Json& document);

/// The target of a channel of KHR_animation_pointer: "/cameras/0/perspective/yfov". Empty for other channels.
[[nodiscard]] std::string animation_pointer(const JsonCursor& channel);

/// A property that a channel of an animation drives: "scale" or, with KHR_animation_pointer, another one.
struct AnimatedProperty {
    std::size_t node;
    std::string path;
};
/// None for channels that drive no node. Throws malformed (E-GLTF).
[[nodiscard]] std::optional<AnimatedProperty> animated_property(const JsonCursor& channel, std::size_t nodes);

/// A mesh with faces, or else lines, and its transform: one part of the scene. The writer builds the same
/// list to find changes.
struct Placement {
    std::string name; ///< the name of the node, otherwise of the mesh; unique in the document
    int node = -1;    ///< -1 in a document without nodes, whose meshes are placed at the origin
    int mesh = -1;
    bool skinned = false;
    Transform world; ///< the transform of the node, or of its largest instance (stand_at_largest_instances)
    std::size_t instances = 0;  ///< number of instances by EXT_mesh_gpu_instancing
    Transform largest_instance; ///< relative to the node
};
/// One for each node with a mesh that has positions, in node order.
[[nodiscard]] std::vector<Placement> placements(const Json& document, const std::vector<NodeFrame>& frames);

/// The materials of these placements; all materials if there are no placements, as in a document of points.
[[nodiscard]] std::set<std::size_t> drawn_materials(const Json& document,
                                                    const std::vector<Placement>& placements);

/// The kinds of primitives with positions, also of lists, strips and fans; none: without positions.
enum class Drawn { none, points, lines, triangles };
[[nodiscard]] Drawn kind_of(const JsonCursor& primitive);
/// The kind of primitives that a part takes from a mesh: triangles if there are any, else lines, else points.
[[nodiscard]] Drawn kind_of_mesh(const JsonCursor& mesh);
bool makes_triangles(const JsonCursor& primitive);
bool has_triangles(const JsonCursor& mesh);

/// The document on which a written scene is based.
struct BaseDocument {
    int index = -1; ///< index in Scene::documents; -1: no document
    Json json{};
};
/// The first document of the scene with nodes or meshes. Documents that only hold materials of another format
/// have neither.
[[nodiscard]] BaseDocument base_document(const Scene& scene);

/// glTF's 16 numbers, column by column.
[[nodiscard]] Json matrix(const Transform& t);

} // namespace facetmill::io::gltf
