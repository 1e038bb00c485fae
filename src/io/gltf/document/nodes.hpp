#pragma once
// The node hierarchy of a glTF document: where each mesh stands in the world.

#include "io/gltf/document/json.hpp"
#include "mesh/scene.hpp"
#include "mesh/transform.hpp"

#include <array>
#include <functional>
#include <set>

namespace facetmill::io::gltf {

/// A node as the hierarchy has it.
struct NodeFrame {
    Transform local, world;
    int parent = -1;
    int mesh = -1;
    bool skinned = false;
};

/// What is scaled first, then turned by a quaternion (x, y, z, w) of any length, one of zero turning nothing,
/// and then moved.
Transform transform_of(const Vec3& move, const std::array<double, 4>& turn, const Vec3& scale);

/// Takes a warning's id and message.
using Warn = std::function<void(const char*, std::string)>;
/// All nodes, by index. Throws malformed (E-NODES) for cycles, E-GLTF for bad members; warns (W-NODES) of
/// nodes with two parents.
std::vector<NodeFrame> node_frames(const Json& document, const Warn& warn = {});
/// The node indices so that parents come before children.
std::vector<std::size_t> parents_first(const std::vector<NodeFrame>& frames);

/// By node, whether the scene that viewers show (`scene`, or the first) has it, itself or as a level of
/// detail; all are where the document has no scenes. What refers to no node, or to no scene, is passed over.
std::vector<bool> shown_nodes(const Json& document);

/// The nodes whose translation, rotation or scale an animation drives.
std::set<std::size_t> animated_nodes(const Json& document);

/// A mesh that faces, or else lines, are read from, and where it stands: one part of the scene. The writer
/// asks for the same list, to see what has changed since.
struct Placement {
    std::string name; ///< the node's, else the mesh's, unique in the document
    int node = -1; ///< -1 when the document has no nodes at all: then each mesh is placed once, at the origin
    int mesh = -1;
    bool skinned = false;
    Transform
        world; ///< of the part: the node's, or that of its largest instance (stand_at_largest_instances)
    std::size_t instances = 0;  ///< by EXT_mesh_gpu_instancing
    Transform largest_instance; ///< seen from the node
};
/// One per node with a mesh that has triangles or lines, in node order.
std::vector<Placement> placements(const Json& document, const std::vector<NodeFrame>& frames);

/// The materials that these have; all of them, where nothing is placed, as in a document of points.
std::set<std::size_t> drawn_materials(const Json& document, const std::vector<Placement>& placements);

/// True for primitives that make triangles (lists, strips and fans) of positions.
bool makes_triangles(const JsonCursor& primitive);
bool has_triangles(const JsonCursor& mesh);
/// True for primitives that make lines (lists, loops and strips) of positions.
bool makes_lines(const JsonCursor& primitive);
/// True for primitives of points that have positions.
bool makes_points(const JsonCursor& primitive);
/// Whether a part is made of the mesh's lines: it has some, and no triangles.
bool is_of_lines(const JsonCursor& mesh);

/// A document of a scene.
struct BaseDocument {
    int index = -1; ///< in Scene::documents; -1: there is none
    Json json{};
};
/// The first document of the scene with nodes or meshes; those that only tell the materials of another format
/// have none.
BaseDocument base_document(const Scene& scene);

/// glTF's 16 numbers, column by column.
Json matrix(const Transform& t);

} // namespace facetmill::io::gltf
