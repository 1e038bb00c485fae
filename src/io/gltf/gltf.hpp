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

/// [parts] true if an animation drives the part's node or an ancestor. Such a node must keep its transform,
/// because the transform is only valid at one time. Animations of morph weights do not count. Throws a
/// malformed-input error when the document's nodes or animations are invalid.
[[nodiscard]] std::vector<bool> animated_parts(const Scene& scene);

/// [parts] for parts with several instances (EXT_mesh_gpu_instancing): the largest distance, in the world,
/// by which writing moves points of the largest instance. 0 for other parts. Instances are float32; with
/// meshopt's filters, rotations have 16 bits. Throws a malformed-input error when the document's nodes or
/// instances are invalid.
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
