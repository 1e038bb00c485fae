#pragma once
// The node hierarchy of a glTF document, with the world transform of each mesh.

#include "io/gltf/document/json.hpp"
#include "mesh/scene.hpp"
#include "mesh/transform.hpp"

#include <array>
#include <functional>
#include <set>

namespace facetmill::io::gltf {

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
/// All nodes, by index. Throws malformed (E-NODES) for cycles, E-GLTF for invalid members. Warns (W-NODES)
/// about nodes with two parents.
[[nodiscard]] std::vector<NodeFrame> node_frames(const Json& document, const Warn& warn = {});
/// The node indices, parents before children.
[[nodiscard]] std::vector<std::size_t> parents_first(const std::vector<NodeFrame>& frames);

/// [nodes] true if the scene that viewers show (`scene`, or the first) contains the node, or if it is a level
/// of detail of such a node. All nodes if the document has no scenes. Invalid references are skipped.
[[nodiscard]] std::vector<bool> shown_nodes(const Json& document);

/// The nodes whose translation, rotation or scale an animation drives, also by KHR_animation_pointer.
[[nodiscard]] std::set<std::size_t> animated_nodes(const Json& document);

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
    std::string name; ///< the node's, else the mesh's, unique in the document
    int node = -1;    ///< -1 in a document without nodes: then each mesh is placed once, at the origin
    int mesh = -1;
    bool skinned = false;
    Transform world; ///< of the part: the node's, or its largest instance's (stand_at_largest_instances)
    std::size_t instances = 0;  ///< by EXT_mesh_gpu_instancing
    Transform largest_instance; ///< relative to the node
};
/// One for each node with a mesh of triangles or lines, in node order.
[[nodiscard]] std::vector<Placement> placements(const Json& document, const std::vector<NodeFrame>& frames);

/// The materials of these placements; all materials if there are no placements, as in a document of points.
[[nodiscard]] std::set<std::size_t> drawn_materials(const Json& document,
                                                    const std::vector<Placement>& placements);

/// True for primitives that make triangles (lists, strips and fans) of positions.
bool makes_triangles(const JsonCursor& primitive);
bool has_triangles(const JsonCursor& mesh);
/// True for primitives that make lines (lists, loops and strips) of positions.
bool makes_lines(const JsonCursor& primitive);
/// True for primitives of points that have positions.
bool makes_points(const JsonCursor& primitive);
/// True if a part consists of the mesh's lines: it has lines and no triangles.
bool is_of_lines(const JsonCursor& mesh);

/// The document of a scene that is written.
struct BaseDocument {
    int index = -1; ///< in Scene::documents; -1: there is none
    Json json{};
};
/// The first document of the scene with nodes or meshes. Documents that only hold materials of another format
/// have neither.
[[nodiscard]] BaseDocument base_document(const Scene& scene);

/// glTF's 16 numbers, column by column.
[[nodiscard]] Json matrix(const Transform& t);

} // namespace facetmill::io::gltf
