#pragma once
// The scene's materials as the library of an OBJ file: their usemtl names and descriptions.

#include "io/obj/describe.hpp"

namespace facetmill::io::obj {

class SceneLibrary {
  public:
    SceneLibrary(const Scene& scene, const WriteSettings& settings);

    /// The library's file name; none if the scene has no materials.
    std::optional<std::string> file_name() const;
    /// The usemtl names, by the scene's material index.
    const std::vector<std::string>& names() const { return names_; }
    /// Adds the library, its images, and the warnings about losses. Call it once.
    void add_to(Written& written);

  private:
    void describe_used(const Scene& scene);
    void join_untextured(const Scene& scene);
    void keep_names(const Scene& scene);

    const WriteSettings& settings_;
    LibraryImages images_;
    LibraryLosses losses_;
    std::vector<std::string> names_;
    std::map<Index, Description> described_; ///< by material index; only materials that faces or lines use
    std::vector<bool> textured_;             ///< [materials] whether faces with texture coordinates use it
};

} // namespace facetmill::io::obj
