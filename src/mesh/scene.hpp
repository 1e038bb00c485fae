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
/// "mm", "in", "unknown", ...
[[nodiscard]] const char* to_string(Unit unit);
[[nodiscard]] const char* to_string(UpAxis up);
/// The unit of that spelling, or none.
[[nodiscard]] std::optional<Unit> unit_named(std::string_view text);

/// A glTF file as it was: the parsed document is the truth, and writing patches meshes, accessors,
/// bufferViews and buffers in it and leaves all else alone.
struct Document {
    std::string json;                                    ///< the whole JSON text
    std::vector<std::vector<std::byte>> buffers;         ///< by buffer index, loaded
    std::map<std::string, std::vector<std::byte>> files; ///< external images, by their uri as spelled
    std::string name;                                    ///< the file's name, for messages
};

struct CutMemory; // mesh/cut_memory.hpp

struct Material {
    std::string name{};
    double base_colour[4] = {1, 1, 1, 1}; ///< linear RGBA
    bool double_sided = false;
    int document = -1; ///< index into Scene::documents, or -1
    int index = -1;    ///< its index in that document's materials
};

/// A mesh in its own space and its transform to the world.
struct Part {
    std::string name{};
    Mesh mesh{};
    Transform transform{}; ///< part space -> world
    int document = -1;     ///< index into Scene::documents, or -1
    int node = -1;         ///< its node in the document
    int source_mesh = -1;  ///< its mesh in the document
    bool skinned =
        false; ///< in bind pose; its transform is the identity, as glTF has it, until a stage moves it
    bool changed =
        false; ///< set by every stage that gives the part another mesh: extensions of it are then dropped
    std::shared_ptr<const CutMemory> cuts{}; ///< points that clips made on planes, in part space; or nothing
};

struct Scene {
    std::vector<Part> parts;
    std::vector<Material> materials;
    Unit unit = Unit::unknown;
    UpAxis up = UpAxis::unknown;
    std::vector<std::shared_ptr<const Document>> documents;

    Box bounds() const; ///< world space, over all parts
    std::size_t face_count() const;
};

} // namespace facetmill

// Compiled once, in instantiated.cpp.
extern template class std::vector<facetmill::Part>;
extern template class std::vector<facetmill::Material>;
