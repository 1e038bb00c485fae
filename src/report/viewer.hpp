#pragma once
// The 3D view of a page: scenes reduced to few triangles, embedded in the page and drawn by viewer.js.

#include "base/json.hpp"
#include "geometry/preview/preview.hpp"
#include "geometry/render/render.hpp"
#include "geometry/spatial/face_tree.hpp"
#include "mesh/scene.hpp"

#include <map>
#include <optional>
#include <string>
#include <tuple>

namespace facetmill::report {

/// A surface that the distances of a scene are taken from.
struct ViewedFrom {
    const FaceTree* tree = nullptr; ///< null: there are no such colours
    std::string name{};
    std::optional<Index> last_cap{}; ///< SignedDeviationSettings::last_cap
};

/// Gathers the scenes that one view shows: one before, and those after it.
class ViewedScenes {
  public:
    /// expected: about how many there will be, before which each gets its share of the triangles.
    explicit ViewedScenes(std::size_t expected);

    /// Before all scenes: those whose up axis is that one stand as in a picture by this camera, which are the
    /// pictures beside the view. Otherwise they stand as the first of them does.
    void stand_as(const Camera& camera, UpAxis up);
    /// The scene that the others are compared with, first of all.
    void add_before(const Scene& scene, const std::string& name,
                    const std::shared_ptr<const ResolvedMaterials>& materials);
    /// A scene after it; one that looks as the last, at the same place, only adds its name to that, as it
    /// does where nothing has changed. from: coloured by the signed distances of its vertices from this, too.
    void add_after(const Scene& scene, const std::string& name,
                   const std::shared_ptr<const ResolvedMaterials>& materials, const ViewedFrom& from = {});
    /// The input of viewer_section(); null for an empty view.
    Json json() const;

  private:
    std::optional<Json> packed(const Scene& scene, const std::string& name,
                               const std::shared_ptr<const ResolvedMaterials>& materials,
                               const ViewedFrom& from);
    Json group(const Scene& scene, const PreviewPaint& paint, std::size_t count, bool textures,
               const ResolvedMaterials* materials);
    Json texture(const Texture& texture, bool with_alpha);

    std::size_t faces_;           ///< of each scene
    std::optional<Camera> first_; ///< which way the scenes stand
    UpAxis first_up_{};
    std::size_t bytes_ = 0, texture_bytes_ = 0, left_out_ = 0;
    Json scenes_ = Json::array(), textures_ = Json::array();
    using TextureKey = std::tuple<const TextureImage*, TextureWrap, TextureWrap, bool, bool>;
    std::map<TextureKey, Json> images_;                     ///< their places among the textures, or null
    std::vector<std::shared_ptr<const TextureImage>> kept_; ///< so that their addresses stay theirs
};

/// The section of a page; empty for null.
std::string viewer_section(const Json& viewed);

} // namespace facetmill::report
