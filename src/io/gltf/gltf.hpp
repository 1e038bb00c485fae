#pragma once
// Uses of glTF other than reading and writing (see io/codec.hpp): document contents other than meshes,
// animated parts, and position bits for Draco. Contents contain no indices into the document, so that two
// files can be compared. A texture becomes its sampler and its image's digest. An accessor becomes its type
// and its numbers' digest. A node becomes its name, or its number if unnamed.

#include "base/function.hpp"
#include "base/json.hpp"
#include "mesh/scene.hpp"

#include <map>
#include <optional>

namespace facetmill::io {

/// The materials of a scene from their documents. Each document is parsed once, on first use, because it may
/// have thousands of materials.
class MaterialContents {
  public:
    /// The scene must outlive it.
    explicit MaterialContents(const Scene& scene) : scene_(scene) {}
    /// Null if the material belongs to no document. Throws a malformed-input error, like reading.
    Json of(const Material& material);

  private:
    const Scene& scene_;
    std::map<int, Json> parsed_; // parsed documents, by document number
};

/// One entry for each animation, skin, camera and light of the scene's first document with nodes:
/// {animations: [...], skins: [...], cameras: [...], lights: [...]}; null without a document. Throws a
/// malformed-input error, like reading.
[[nodiscard]] Json document_contents(const Scene& scene);

/// True if the scene is a document without meshes (nodes, cameras, animations): it has no part, and none was
/// dropped by a stage.
[[nodiscard]] bool is_without_meshes(const Scene& scene);

/// How viewers show a part of a document. Parts without a document are drawn unchanged.
struct PartView {
    bool animated =
        false;           ///< an animation moves or shows its node or an ancestor; morph weights do not count
    bool hidden = false; ///< outside the scene that viewers show, or invisible (KHR_node_visibility)
    bool lower_level = false; ///< a level of detail that replaces another node (MSFT_lod), or below one
    bool has_levels = false;  ///< its node or an ancestor has such levels
    bool instanced = false;   ///< several instances (EXT_mesh_gpu_instancing)
    bool shares_node = false; ///< its node also has a camera, a light or another extension
    Transform largest{};      ///< its space to the world, at the largest scale that an animation gives it

    bool is_drawn() const { return !hidden && !lower_level; }
};
/// [parts]. Throws malformed when the nodes or animations of a document are invalid.
[[nodiscard]] std::vector<PartView> part_views(const Scene& scene);
/// The world box of the drawn contents, with each part at its largest scale. Unused vertices of documents,
/// hidden parts and lower levels of detail do not count, unless nothing else is left.
[[nodiscard]] Box drawn_bounds(const Scene& scene, const std::vector<PartView>& views);
/// The same for the views of the scene; the bounds at rest if a document is invalid.
[[nodiscard]] Box drawn_bounds(const Scene& scene);

/// By how much lengths of a part have grown since its materials were made.
struct LengthGrowth {
    double mesh = 1;  ///< in the space of the mesh
    double world = 1; ///< in the world
};
/// The growth of lengths under a transform; the geometric mean if it differs by direction.
[[nodiscard]] double length_growth(const Transform& t);
/// Multiplies the lengths in the parts' materials (KHR_materials_volume: the thickness is in the space of the
/// mesh, the attenuation distance in the world). A material that parts need with different lengths gets
/// copies. growth: [parts].
void scale_material_lengths(Scene& scene, const std::vector<LengthGrowth>& growth);
/// Moves the cameras and lights of each document whose parts all move alike, and scales their lengths. moved:
/// [parts]. Returns false if KHR_animation_pointer animates such lengths, whose keys keep their numbers.
[[nodiscard]] bool move_cameras_and_lights(Scene& scene, const std::vector<bool>& moved, const Transform& by);
/// [parts] the thicknesses of the volumes (KHR_materials_volume) in the world, ascending.
[[nodiscard]] std::vector<std::vector<double>> thicknesses(const Scene& scene);

/// [parts] for parts at the largest of several instances (EXT_mesh_gpu_instancing): the distance by which
/// writing the instance may move its points, in the world. 0 for other parts. Instances are float32; with
/// meshopt's filters, rotations have 16 bits. Throws malformed when the document's nodes or instances are
/// invalid.
[[nodiscard]] std::vector<double> errors_of_instances(const Scene& scene, bool filters);

/// Calls visit for each part with several instances (EXT_mesh_gpu_instancing), with the transforms from its
/// space to the instances, as they would be written now. Beyond 65,536 instances it samples evenly, and each
/// sample represents several instances. Throws the errors of errors_of_instances.
void for_each_place_of_instances(
    const Scene& scene, const Function<void(std::size_t part, const Transform& place, double times)>& visit);

/// The smallest number of position bits, from `min_bits` to 24, that keeps distinct float32 vertex positions
/// distinct on the grid. None if 24 are not enough.
[[nodiscard]] std::optional<int> bits_that_keep_distinct(const Mesh& mesh, int min_bits);

} // namespace facetmill::io
