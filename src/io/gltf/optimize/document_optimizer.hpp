#pragma once
// Removes duplicates and unused items from a glTF document. The caller updates the indices in the scene's
// parts and materials.

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

/// The number of removed items of each kind.
struct TidyCounts {
    std::size_t nodes = 0, meshes = 0, materials = 0, textures = 0, samplers = 0, images = 0, accessors = 0,
                tracks = 0;
};

/// The number of keys of animations before and after.
struct KeyCounts {
    std::size_t before = 0, after = 0;
};

/// The items of a document that the scene's parts use.
struct TidyRequest {
    std::set<std::size_t> emptied;                   ///< nodes whose meshes were moved elsewhere
    std::map<std::size_t, std::size_t> equal_meshes; ///< meshes equal to another mesh, and that mesh
    std::set<std::size_t> meshes, materials;         ///< meshes and materials that parts use
    bool all = true; ///< erases items that were unused from the start too, not only newly unused items
};

/// By the old number: the new number, or -1 for removed items.
struct TidyNumbers {
    std::vector<int> nodes, meshes, materials;
};

/// Gives the parts and the materials of a document their new numbers.
void renumber(Scene& scene, int document, const TidyNumbers& numbers);

/// The appearance of a material without textures.
struct PlainLook {
    std::array<double, 4> colour = {1, 1, 1, 1}; ///< linear
    double metalness = 1, roughness = 1;
    std::array<double, 3> emission = {0, 0, 0}; ///< linear
    std::string kind{}; ///< alpha mode, sides etc.; equal for materials that can share a palette
    auto surface() const { return std::tie(colour, metalness, roughness, emission); }
};

/// The vertex data that a material needs.
struct MaterialNeeds {
    std::set<int> uvs; ///< sets of texture coordinates
    bool normals = true, tangents = false;
    std::optional<int> normal_map_uvs{}; ///< set used by the normal map, if any
};

/// A document being optimised. Throws a malformed-input error when it is not JSON or its lists are not
/// arrays.
class DocumentOptimizer {
  public:
    explicit DocumentOptimizer(const Document& document);

    /// Merges equal images (by their bytes), samplers, textures and materials; the duplicates become unused.
    /// keep_names: materials with different names stay separate. Returns the representative of each material.
    /// Does nothing if KHR_materials_variants refers to materials.
    std::vector<std::size_t> merge_equal(bool keep_names);

    /// Erases unused items: meshes, materials, textures, samplers, images, accessors and their views. It
    /// also erases emptied nodes, and ancestors without other contents. Joints, animated nodes, and nodes
    /// with a camera, extensions or extras stay. Erases nothing if an extension may refer to items in an
    /// unknown way (numbers_are_known).
    TidyNumbers erase_unused(const TidyRequest& request);

    /// Merges equal accessors, by their bytes. keep_names: accessors with names stay. Returns the number of
    /// duplicates.
    std::size_t merge_equal_accessors(bool keep_names);

    /// Erases animation tracks that never move a node away from its rest transform, unless another track
    /// moves the same property. Other tracks with the same value at all times get a single key.
    /// Translations are compared within a length in the world, rotations and scales within 1e-5. An
    /// animation keeps its duration. Returns the number of erased tracks. Call it before
    /// merge_equal_accessors and erase_unused.
    std::size_t drop_resting_tracks(double length);

    /// Drops keys that interpolation gives within a limit, such that no vertex moves by more than a ratio of
    /// the document's size (MotionLimits). With a rate, first writes linear keys at so many times a second.
    /// Cubic keys stay. An animation keeps its duration. Call it before erase_unused.
    KeyCounts drop_keys(double ratio, std::optional<double> rate);

    /// Moves nodes to the top of their scene, keeping their world transforms. `emptied` receives their
    /// ancestors without a mesh. None of the nodes may be bound (bound_parts). Returns the number of nodes
    /// that were not at the top.
    std::size_t flatten(const std::set<std::size_t>& nodes, std::set<std::size_t>& emptied);

    /// Creates a node at the top of the first node's scene. It instances its mesh at the world transforms of
    /// all these nodes (EXT_mesh_gpu_instancing, required). Returns the node and the float32 transform of
    /// the largest instance. None if a transform is not a translation, a rotation and scales (within 1e-6).
    using NodeTransform = std::pair<std::size_t, Transform>;
    std::optional<NodeTransform> instance(const std::vector<NodeTransform>& nodes);

    /// The appearance of a material without textures, extensions (except KHR_materials_unlit) and extras;
    /// none for other materials.
    std::optional<PlainLook> plain_look(std::size_t material) const;
    /// Adds a material with textures that hold the looks as pixels, from left to right; all looks must have
    /// the same kind. Look i is at the texture coordinates ((i + 0.5) / count, 0.5). Colours have 8 bits.
    std::size_t add_palette(const std::vector<PlainLook>& looks);
    /// Removes the materials from all primitives of the meshes. Call erase_unused to erase them.
    void forget_materials(const std::set<std::size_t>& meshes, const std::set<std::size_t>& materials);
    /// Assigns the material to all triangles of the mesh.
    void set_material(std::size_t mesh, std::size_t material);
    MaterialNeeds needs_of(std::size_t material) const;
    /// Lets the textures of a material use the next higher set of texture coordinates, from set `first` on.
    void move_uvs_up(std::size_t material, int first);

    bool numbers_are_known() const { return known_; }
    const TidyCounts& erased() const { return erased_; }
    /// The resulting document; `before` if nothing has changed.
    std::shared_ptr<const Document> finish(const std::shared_ptr<const Document>& before);

  private:
    friend std::vector<bool> bound_parts(const Scene& scene, std::vector<DocumentOptimizer>& documents);
    using References = void (*)(Json& document, const std::function<void(Json&)>& visit);
    /// Items of a list without references. `named`: items referenced from outside the document.
    std::set<std::size_t> unnamed(const char* list, References references,
                                  const std::set<std::size_t>& named);
    std::size_t erase(const char* list, References references, const std::set<std::size_t>& dead);
    void drop_bounds();
    /// The document's buffers, then the added ones. Valid until the next call.
    const std::vector<Bytes>& buffers();
    std::size_t add(const char* list, Json item);
    /// Adds a view with a separate buffer.
    std::size_t add_view(Bytes bytes);
    std::size_t add_floats(const std::vector<float>& numbers, int components);
    /// Appends numbers to the bytes of the next view. Returns their accessor.
    std::size_t add_keys(Bytes& bytes, const std::vector<float>& numbers, int components);
    void put_at_top(std::size_t node, std::size_t like);

    const Document& document_;
    Json json_, before_;
    std::vector<Bytes> added_;       ///< buffers after the document's
    std::vector<Bytes> all_buffers_; ///< of buffers()
    bool known_ = true, all_ = true;
    TidyCounts erased_;
};

/// [parts] True if the node is more than a transform for its mesh: it is skinned, animated or a joint, or
/// has morph targets or a camera. Extras or extensions of the node, its mesh or an ancestor also count. So
/// do several scenes, and extensions that may refer to nodes by number. documents: the documents of the
/// scene, unchanged.
[[nodiscard]] std::vector<bool> bound_parts(const Scene& scene, std::vector<DocumentOptimizer>& documents);

} // namespace facetmill::io
