#pragma once
// A glTF document without what it says twice, and without what nothing uses. Who asks keeps the scene's parts
// and materials at its numbers.

#include "base/json.hpp"
#include "io/bytes.hpp"
#include "mesh/scene.hpp"

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <tuple>

namespace facetmill::io {

/// How many things of each kind a document lost.
struct TidyCounts {
    std::size_t nodes = 0, meshes = 0, materials = 0, textures = 0, samplers = 0, images = 0, accessors = 0,
                tracks = 0;
};

/// What the parts of a scene still name in a document.
struct TidyRequest {
    std::set<std::size_t> emptied;                   ///< nodes whose meshes have gone elsewhere
    std::map<std::size_t, std::size_t> equal_meshes; ///< meshes that are like another one, and that one
    std::set<std::size_t> meshes, materials;         ///< that parts have
    bool all = true; ///< also what nothing named in the first place; else only what is new
};

/// By the old number, the new one, or -1 for what is gone.
struct TidyNumbers {
    std::vector<int> nodes, meshes, materials;
};

/// What a material without textures says of its surface.
struct PlainLook {
    std::array<double, 4> colour = {1, 1, 1, 1}; ///< linear
    double metalness = 1, roughness = 1;
    std::array<double, 3> emission = {0, 0, 0}; ///< linear
    std::string kind{}; ///< all else: alpha mode, sides; equal for those that go together
    auto surface() const { return std::tie(colour, metalness, roughness, emission); }
};

/// What a material needs of the vertices that it is drawn on.
struct MaterialNeeds {
    std::set<int> uvs; ///< sets of texture coordinates
    bool normals = true, tangents = false;
    std::optional<int> normal_map_uvs{}; ///< the set that the map of normals reads, if there is one
};

/// A document on its way. Throws malformed when it is no JSON or its lists are none.
class DocumentOptimizer {
  public:
    explicit DocumentOptimizer(const Document& document);

    /// Makes one of equal images (by their bytes), samplers, textures and materials: nothing names the others
    /// any more. keep_names: materials of different names are different. Returns for each material the one
    /// that stands for it. Nothing where KHR_materials_variants names materials.
    std::vector<std::size_t> merge_equal(bool keep_names);

    /// Erases what nothing names: meshes, materials, textures, samplers, images, accessors, their views, and
    /// the nodes that were emptied, with those above them that have nothing else; not joints, nodes that are
    /// animated, or have a camera, extensions or extras. With an extension that may name things by numbers
    /// which are not known here, nothing is erased (numbers_are_known).
    TidyNumbers erase_unused(const TidyRequest& request);

    /// Makes one of equal accessors, by their bytes. Returns how many others stand for now.
    std::size_t merge_equal_accessors();

    /// Erases the tracks of animations that keep a node where it is without them: translations within a
    /// length, rotations and scales within 1e-5, where no other animation moves the same. An animation keeps
    /// its duration. Returns how many. Before erase_unused.
    std::size_t drop_resting_tracks(double length);

    /// Puts nodes at the top of their scene, where they stand in the world. `emptied` gets the nodes above
    /// that have no mesh. None of them may be bound (bound_parts). Returns how many were not there.
    std::size_t flatten(const std::set<std::size_t>& nodes, std::set<std::size_t>& emptied);

    /// One node at the top of the scene that the first of these nodes is in, with its mesh at all of their
    /// places in the world (EXT_mesh_gpu_instancing, required). Returns the node and where the largest of the
    /// places is, as float32 has it; none when a place cannot be told by a translation, a rotation and scales
    /// (within 1e-6).
    using NodeTransform = std::pair<std::size_t, Transform>;
    std::optional<NodeTransform> instance(const std::vector<NodeTransform>& nodes);

    /// What a material without textures, extensions (but KHR_materials_unlit) and extras says; none for
    /// others.
    std::optional<PlainLook> plain_look(std::size_t material) const;
    /// A material with the looks as pixels of its textures, from left to right, all of one kind. Look i is at
    /// the texture coordinates ((i + 0.5) / count, 0.5). Colours have 8 bits.
    std::size_t add_palette(const std::vector<PlainLook>& looks);
    /// All triangles of the mesh get the material.
    void set_material(std::size_t mesh, std::size_t material);
    MaterialNeeds needs_of(std::size_t material) const;

    bool numbers_are_known() const { return known_; }
    const TidyCounts& erased() const { return erased_; }
    /// The document now; the one that came when nothing has changed.
    std::shared_ptr<const Document> finish(const std::shared_ptr<const Document>& before);

  private:
    friend std::vector<bool> bound_parts(const Scene& scene, std::vector<DocumentOptimizer>& documents);
    using References = void (*)(Json& document, const std::function<void(Json&)>& visit);
    /// Items of a list that nothing names. `named`: by others than the document.
    std::set<std::size_t> unnamed(const char* list, References references,
                                  const std::set<std::size_t>& named);
    std::size_t erase(const char* list, References references, const std::set<std::size_t>& dead);
    std::set<std::size_t> empty_nodes(const std::set<std::size_t>& emptied);
    void drop_bounds();
    std::size_t add(const char* list, Json item);
    /// A view of a buffer of its own.
    std::size_t add_view(Bytes bytes);
    std::size_t add_floats(const std::vector<float>& numbers, int components);
    void put_at_top(std::size_t node, std::size_t like);

    const Document& document_;
    Json json_, before_;
    std::vector<Bytes> added_; ///< buffers behind the document's
    bool known_ = true, all_ = true;
    TidyCounts erased_;
};

/// For each part, whether its node is more than a place for its mesh: it is skinned, animated or a joint, it
/// has morph targets, a camera, or, as its mesh or a node above it does, extras or extensions; or the
/// document has several scenes, or extensions that may name nodes by numbers. documents: the scene's, as they
/// came.
std::vector<bool> bound_parts(const Scene& scene, std::vector<DocumentOptimizer>& documents);

} // namespace facetmill::io
