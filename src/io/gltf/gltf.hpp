#pragma once
// What others may ask of glTF besides reading and writing, which the registry of codecs gives (io/codec.hpp):
// what a document says beside meshes, which parts move by themselves, and how many bits Draco needs. A
// document is told without indices into it, so that two files can be compared: a texture is its sampler and
// the digest of its image, an accessor its type and the digest of its numbers, a node its name (or its
// number where it has none).

#include "base/function.hpp"
#include "base/json.hpp"
#include "mesh/scene.hpp"

#include <map>
#include <optional>

namespace facetmill::io {

/// The materials of a scene as their documents have them. A document is parsed when a material of it is first
/// asked for, and once only: it may have thousands.
class MaterialContents {
  public:
    /// The scene has to outlive it.
    explicit MaterialContents(const Scene& scene) : scene_(scene) {}
    /// Null when the material is of no document. Throws malformed as reading does.
    Json of(const Material& material);

  private:
    const Scene& scene_;
    std::map<int, Json> parsed_; // by the number of the document
};

/// One entry for each animation, skin, camera and light of the scene's first document with nodes:
/// {animations: [...], skins: [...], cameras: [...], lights: [...]}; null when there is no document. Throws
/// malformed as reading does.
Json document_contents(const Scene& scene);

/// For each part, whether an animation of its document drives the node it stands at, or one above it. Such a
/// node has to keep its transform, which is that of one moment only. Morph weights do not count. Throws
/// malformed when the document's nodes or animations are.
std::vector<bool> animated_parts(const Scene& scene);

/// For each part that stands where the largest of several instances does (EXT_mesh_gpu_instancing), how far
/// writing that place may move its points, in the world; 0 for others. A place is float32; under meshopt's
/// filters its rotation has 16 bits. Throws malformed when the document's nodes or instances are.
std::vector<double> errors_of_instances(const Scene& scene, bool filters);

/// Calls visit for each part that its document has at many places (EXT_mesh_gpu_instancing), with the
/// transforms from its space to these, as it stands and is written now. Of more than 65,536 of them, every so
/// many-th, which stands for that many. Throws malformed as above.
void for_each_place_of_instances(
    const Scene& scene, const Function<void(std::size_t part, const Transform& place, double times)>& visit);

/// The fewest bits of position, from `min_bits` to 24, at which vertices of the mesh that are at different
/// places (in float32) stay at different places of its grid; none when 24 are not enough.
std::optional<int> bits_that_keep_distinct(const Mesh& mesh, int min_bits);

} // namespace facetmill::io
