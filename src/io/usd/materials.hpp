#pragma once
// glTF materials as materials of UsdPreviewSurface, and their textures.

#include "base/json.hpp"
#include "io/gltf/document/accessor.hpp"
#include "io/usd/layer.hpp"

#include <map>
#include <set>

namespace facetmill::io::usd {

/// The vertex colours of a primitive that its material has to multiply.
struct VertexColours {
    bool colour = false, alpha = false;
    auto operator<=>(const VertexColours&) const = default;
};

/// A material as a primitive uses it.
struct MaterialUse {
    std::string path;                         ///< of the material's prim
    std::array<double, 4> factor{1, 1, 1, 1}; ///< to multiply into the primitive's vertex colours
    bool double_sided = false;
};

class Materials {
  public:
    /// root: the path of the prim around the materials. All must outlive it.
    Materials(gltf::Source& source, std::string root) : source_(source), layer_(2), root_(std::move(root)) {}

    /// Writes the material on first use. index: in the document.
    const MaterialUse& use(std::size_t index, const VertexColours& colours);

    const Layer& layer() const { return layer_; }
    /// The textures, named relative to the layer. Moves their bytes out.
    std::vector<OutputFile> take_files();
    /// Warnings about contents of materials that are lost.
    void tell(Written& written) const;

  private:
    friend class MaterialWriter;

    /// The name of the texture's image in the package; empty if its bytes are missing. Throws a stage error
    /// (E-FORMAT) for an image that USDZ cannot hold.
    std::string file_of(std::size_t texture);
    std::string add_image(std::size_t image);
    void lose(const std::string& what, const std::string& material) { lost_[what].insert(material); }

    gltf::Source& source_;
    Layer layer_;
    std::string root_;
    std::map<std::pair<std::size_t, VertexColours>, MaterialUse> uses_;
    std::map<std::size_t, std::string> image_names_;
    std::vector<OutputFile> files_;
    UniqueNames file_names_;
    std::map<std::string, std::set<std::string>> lost_; ///< what is lost, and the materials that lose it
    std::vector<Diagnostic> warnings_;
};

/// The extensions of materials and textures that have an equivalent.
[[nodiscard]] const std::set<std::string>& kept_extensions();

} // namespace facetmill::io::usd
