#pragma once
// The data of a pipeline: named parts with a node transform, materials, a unit and an up axis, and the rest
// of the document if it came from glTF.

#include "mesh/mesh.hpp"

#include <cstddef>
#include <map>
#include <optional>

namespace facetmill {

enum class Unit { unknown, um, mm, cm, m, km, inch, foot };
enum class UpAxis { unknown, y, z };

/// Metres per unit; 0 for unknown.
[[nodiscard]] double metres(Unit unit);
/// The unit as text: "mm", "in", "unknown" ...
[[nodiscard]] const char* to_string(Unit unit);
[[nodiscard]] const char* to_string(UpAxis up);
/// The unit with this spelling, or none.
[[nodiscard]] std::optional<Unit> unit_named(std::string_view text);

/// A glTF file as read. Writing patches meshes, accessors, bufferViews and buffers in the document, and
/// leaves the rest unchanged.
struct Document {
    std::string json;                                    ///< the whole JSON text
    std::vector<std::vector<std::byte>> buffers;         ///< loaded buffers, by index
    std::map<std::string, std::vector<std::byte>> files; ///< external images, by their URI as spelled
    std::string name;                                    ///< the file's name, for messages
};

struct CutMemory;

struct Material {
    std::string name{};
    double base_colour[4] = {1, 1, 1, 1}; ///< linear RGBA
    bool double_sided = false;
    int document = -1; ///< index into Scene::documents, or -1
    int index = -1;    ///< index in that document's materials
};

/// A mesh in its own space and its transform to the world.
struct Part {
    std::string name{};
    Mesh mesh{};
    Transform transform{}; ///< from part space to the world
    int document = -1;     ///< index into Scene::documents, or -1
    int node = -1;         ///< node in the document, or -1
    int source_mesh = -1;  ///< mesh in the document, or -1
    bool skinned =
        false; ///< in bind pose; as in glTF, the transform is the identity until a stage moves the part
    bool changed =
        false; ///< set by every stage that changes the part's mesh; extensions of the mesh are then dropped
    std::shared_ptr<const CutMemory> cuts{}; ///< points that clips made on planes, in part space; may be null
};

struct Scene {
    std::vector<Part> parts;
    std::vector<Material> materials;
    Unit unit = Unit::unknown;
    UpAxis up = UpAxis::unknown;
    std::vector<std::shared_ptr<const Document>> documents;

    Box bounds() const; ///< the box of all parts in world space
    std::size_t face_count() const;
};

} // namespace facetmill

// Compiled once, in instantiated.cpp.
extern template class std::vector<facetmill::Part>;
extern template class std::vector<facetmill::Material>;
