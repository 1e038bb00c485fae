#pragma once
// A glTF document without what it says twice, and without what nothing uses. Who asks keeps the scene's parts
// and materials at its numbers.

#include "base/json.hpp"
#include "mesh/scene.hpp"

#include <functional>
#include <map>
#include <set>

namespace facetmill::io {

/// How many things of each kind a document lost.
struct TidyCounts {
    std::size_t nodes = 0, meshes = 0, materials = 0, textures = 0, samplers = 0, images = 0, accessors = 0;
};

/// What the parts of a scene still name in a document.
struct TidyRequest {
    std::set<std::size_t> emptied;                   ///< nodes whose meshes have gone elsewhere
    std::map<std::size_t, std::size_t> equal_meshes; ///< meshes that are like another one, and that one
    std::set<std::size_t> meshes, materials;         ///< that parts have
    bool all = true; ///< also what nothing named in the first place; else only what is new
};

/// By the old number, the new one, or -1 for what is gone.
struct TidyNumbers {
    std::vector<int> nodes, meshes, materials;
};

/// A document on its way. Throws malformed when it is no JSON or its lists are none.
class DocumentTidy {
  public:
    explicit DocumentTidy(const Document& document);

    /// Makes one of equal images (by their bytes), samplers, textures and materials: nothing names the others
    /// any more. keep_names: materials of different names are different. Returns for each material the one
    /// that stands for it. Nothing where KHR_materials_variants names materials.
    std::vector<std::size_t> merge_equal(bool keep_names);

    /// Erases what nothing names: meshes, materials, textures, samplers, images, accessors, their views, and
    /// the nodes that were emptied, with those above them that have nothing else; not joints, nodes that are
    /// animated, or have a camera, extensions or extras. With an extension that may name things by numbers
    /// which are not known here, nothing is erased (numbers_are_known).
    TidyNumbers erase_unused(const TidyRequest& request);

    bool numbers_are_known() const { return known_; }
    const TidyCounts& erased() const { return erased_; }
    /// The document now; the one that came when nothing has changed.
    std::shared_ptr<const Document> finish(const std::shared_ptr<const Document>& before);

  private:
    friend std::vector<bool> bound_parts(const Scene& scene, std::vector<DocumentTidy>& documents);
    using References = void (*)(Json& document, const std::function<void(Json&)>& visit);
    /// Items of a list that nothing names. `named`: by others than the document.
    std::set<std::size_t> unnamed(const char* list, References references,
                                  const std::set<std::size_t>& named);
    std::size_t erase(const char* list, References references, const std::set<std::size_t>& dead);
    std::set<std::size_t> empty_nodes(const std::set<std::size_t>& emptied);

    const Document& document_;
    Json json_, before_;
    bool known_ = true, all_ = true;
    TidyCounts erased_;
};

/// For each part, whether its node is more than a place for its mesh: it is skinned, animated or a joint, it
/// has morph targets, a camera, or, as its mesh or a node above it does, extras or extensions; or the
/// document has several scenes, or extensions that may name nodes by numbers. documents: the scene's, as they
/// came.
std::vector<bool> bound_parts(const Scene& scene, std::vector<DocumentTidy>& documents);

} // namespace facetmill::io
