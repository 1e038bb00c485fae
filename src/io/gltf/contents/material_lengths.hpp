#pragma once
// Lengths in materials. KHR_materials_volume gives thicknessFactor in the space of the mesh and
// attenuationDistance in the world.

#include "io/gltf/document/json.hpp"
#include "io/gltf/gltf.hpp"

#include <map>
#include <tuple>
#include <vector>

namespace facetmill::io::gltf {

/// Scales materials of a document. A material that is needed with different lengths gets copies.
class MaterialScaler {
  public:
    /// The document must outlive it.
    explicit MaterialScaler(Json& document) : document_(document) {}

    /// The material with its lengths multiplied: the same index for the first growth, else a copy's.
    /// Materials without lengths stay.
    std::size_t scaled(std::size_t material, LengthGrowth by);
    /// Scales the materials that KHR_materials_variants names in a primitive.
    void scale_variants(Json& primitive, LengthGrowth by);
    bool changed() const { return changed_; }

  private:
    Json& document_;
    std::map<std::size_t, Json> original_;
    std::map<std::tuple<std::size_t, double, double>, std::size_t> made_; // by material and growth
    bool changed_ = false;
};

/// Multiplies the thickness in the materials of each mesh. factors: [meshes] 1 for meshes that stay.
void scale_thickness(Json& document, const std::vector<double>& factors);

} // namespace facetmill::io::gltf
