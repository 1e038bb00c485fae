#pragma once
// Materials of glTF as MTL statements.

#include "io/obj/library_images.hpp"
#include "io/obj/materials.hpp"

#include <set>

namespace facetmill::io::obj {

/// The features that MTL cannot express, with the materials that have them.
class LibraryLosses {
  public:
    /// what: for example "occlusionTexture" or "KHR_materials_clearcoat". why: the reason in the message.
    void add_texture(const std::string& what, const std::string& why, const std::string& material) {
        note(textures_, what, why, material);
    }
    void add(const std::string& what, const std::string& why, const std::string& material) {
        note(others_, what, why, material);
    }
    /// W-TEXTURES and W-MTL, at most once each.
    std::vector<Diagnostic> warnings() const;

  private:
    using Losses = std::vector<std::pair<std::string, std::vector<std::string>>>; ///< with their materials
    static void note(Losses& losses, const std::string& what, const std::string& why,
                     const std::string& material);
    Losses textures_, others_;
};

/// Extensions of materials that MTL can express at least in part; other extensions are recorded as lost.
const std::set<std::string>& extensions_of_library();
/// extensions_of_library(), and the other parts of a document that a library can express.
const std::set<std::string>& kept_by_library();

/// The MTL statements that a reader converts to the scene's material. Records losses and marks the images
/// that the statements name as used. A material without a document has only its colour.
[[nodiscard]] Description describe(const Material& material, LibraryImages& images, LibraryLosses& losses);

} // namespace facetmill::io::obj
