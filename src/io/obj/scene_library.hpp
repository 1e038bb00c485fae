#pragma once
// The materials of a scene as the library of an OBJ file: under which names, and what they are.

#include "io/obj/describe.hpp"

namespace facetmill::io::obj {

class SceneLibrary {
  public:
    SceneLibrary(const Scene& scene, const WriteSettings& settings);

    /// The name of its file; none where the scene has no materials, and so there is no library.
    std::optional<std::string> file_name() const;
    /// For usemtl, by the materials of the scene.
    const std::vector<std::string>& names() const { return names_; }
    /// Adds the library, its images, and what it cannot hold. Once.
    void add_to(Written& written);

  private:
    void describe_used(const Scene& scene);
    void join_untextured(const Scene& scene);
    void keep_names(const Scene& scene);

    const WriteSettings& settings_;
    LibraryImages images_;
    LibraryLosses losses_;
    std::vector<std::string> names_;
    std::map<Index, Description> described_; ///< of the materials that faces or lines use
    std::vector<bool> textured_;             ///< by the materials: faces with texture points use it
};

} // namespace facetmill::io::obj
