#pragma once
// The 3D view of a page: scenes with few triangles, embedded in the page and drawn by viewer.js.

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

/// The reference surface for the distances of a scene.
struct ViewedFrom {
    const FaceTree* tree = nullptr; ///< null: no coloured distances
    std::string name{};
    std::optional<Index> last_cap{}; ///< see SignedDeviationSettings::last_cap
    /// The up axis of the file, for a scene without one: readers of the file assume it.
    UpAxis file_up = UpAxis::unknown;
};

/// Collects the scenes of a view: one before, and the scenes after it.
class ViewedScenes {
  public:
    /// expected: the approximate number of scenes, among which the triangles are divided.
    explicit ViewedScenes(std::size_t expected);

    /// Call it before adding scenes. Scenes with this up axis use the camera's orientation, as in the
    /// pictures next to the view. Otherwise all use the orientation of the first scene.
    void stand_as(const Camera& camera, UpAxis up);
    /// Adds the scene for comparison; call it first.
    void add_before(const Scene& scene, const std::string& name,
                    const std::shared_ptr<const ResolvedMaterials>& materials);
    /// Adds a scene after it. If it looks like the last scene at the same position, only its name is added,
    /// because nothing changed. from: reference for colouring vertices by signed distance.
    void add_after(const Scene& scene, const std::string& name,
                   const std::shared_ptr<const ResolvedMaterials>& materials, const ViewedFrom& from = {});
    /// The input of viewer_section(); null if there is nothing to show.
    Json json() const;

  private:
    std::optional<Json> packed(const Scene& scene, const std::string& name,
                               const std::shared_ptr<const ResolvedMaterials>& materials,
                               const ViewedFrom& from);
    Json group(const Scene& scene, const PreviewPaint& paint, std::size_t count, bool textures,
               const ResolvedMaterials* materials);
    Json texture(const Texture& texture, bool with_alpha);

    std::size_t faces_;           ///< faces per scene
    std::optional<Camera> first_; ///< orientation of the scenes
    UpAxis first_up_{};
    std::size_t bytes_ = 0, texture_bytes_ = 0, left_out_ = 0;
    Json scenes_ = Json::array(), textures_ = Json::array();
    using TextureKey = std::tuple<const TextureImage*, TextureWrap, TextureWrap, bool, bool>;
    std::map<TextureKey, Json> images_; ///< indices among the textures, or null
    std::vector<std::shared_ptr<const TextureImage>>
        kept_; ///< keeps images alive, so that addresses stay unique
};

/// The section of a page; empty for null.
[[nodiscard]] std::string viewer_section(const Json& viewed);

} // namespace facetmill::report
