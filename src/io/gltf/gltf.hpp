#pragma once
// Other uses of glTF besides reading and writing, which the codec registry provides (io/codec.hpp). These are
// document contents other than meshes, animated parts, and position bits for Draco. Contents contain no
// indices into the document, so that two files can be compared. A texture is its sampler and its image's
// digest, an accessor its type and its numbers' digest. A node is its name, or its number if it has none.

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
    /// Null if the material belongs to no document. Throws malformed, like reading.
    Json of(const Material& material);

  private:
    const Scene& scene_;
    std::map<int, Json> parsed_; // by document number
};

/// One entry for each animation, skin, camera and light of the scene's first document with nodes:
/// {animations: [...], skins: [...], cameras: [...], lights: [...]}; null without a document. Throws
/// malformed, like reading.
[[nodiscard]] Json document_contents(const Scene& scene);

/// True if the scene is a document without meshes (nodes, cameras, animations): it has no part, and none was
/// dropped by a stage.
[[nodiscard]] bool is_without_meshes(const Scene& scene);

/// [parts] true if an animation of its document drives its node, or an ancestor. Such a node must keep its
/// transform, which is only valid for one moment. Morph weights do not count. Throws malformed when the
/// document's nodes or animations are invalid.
[[nodiscard]] std::vector<bool> animated_parts(const Scene& scene);

/// [parts] for parts at the largest of several instances (EXT_mesh_gpu_instancing): the distance by which
/// writing the instance may move its points, in the world. 0 for other parts. Instances are float32; with
/// meshopt's filters, rotations have 16 bits. Throws malformed when the document's nodes or instances are
/// invalid.
[[nodiscard]] std::vector<double> errors_of_instances(const Scene& scene, bool filters);

/// Calls visit for each part with several instances (EXT_mesh_gpu_instancing), with the transforms from its
/// space to the instances, as they would be written now. Of more than 65,536 instances it samples evenly;
/// each sample represents that many. Throws malformed as above.
void for_each_place_of_instances(
    const Scene& scene, const Function<void(std::size_t part, const Transform& place, double times)>& visit);

/// The smallest number of position bits, from `min_bits` to 24, that keeps distinct float32 vertex positions
/// distinct on the grid. None if 24 are not enough.
[[nodiscard]] std::optional<int> bits_that_keep_distinct(const Mesh& mesh, int min_bits);

} // namespace facetmill::io
