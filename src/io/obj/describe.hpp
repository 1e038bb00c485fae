#pragma once
// Materials of glTF in the words of MTL.

#include "io/obj/library_images.hpp"
#include "io/obj/materials.hpp"

#include <set>

namespace facetmill::io::obj {

/// What MTL has no words for, and which materials have it.
class LibraryLosses {
  public:
    /// what: "occlusionTexture", "KHR_materials_clearcoat"; why: what is in the way, for people.
    void add_texture(const std::string& what, const std::string& why, const std::string& material) {
        note(textures_, what, why, material);
    }
    void add(const std::string& what, const std::string& why, const std::string& material) {
        note(others_, what, why, material);
    }
    /// W-TEXTURES and W-MTL, each once.
    std::vector<Diagnostic> warnings() const;

  private:
    using Losses = std::vector<std::pair<std::string, std::vector<std::string>>>; ///< with their materials
    static void note(Losses& losses, const std::string& what, const std::string& why,
                     const std::string& material);
    Losses textures_, others_;
};

/// Extensions of materials that MTL has words for, wholly or in part; of others all is noted as lost.
const std::set<std::string>& extensions_of_library();
/// Those, and what else of a document a library has words for.
const std::set<std::string>& kept_by_library();

/// The words that are read as the material of the scene: what they cannot say is noted, and images that they
/// name are marked as used. Of a material that no document has, the colour.
Description describe(const Material& material, LibraryImages& images, LibraryLosses& losses);

} // namespace facetmill::io::obj
