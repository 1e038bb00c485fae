#pragma once
// Data that only pages need: pictures, coloured distances, histograms.

#include "geometry/render/render.hpp"
#include "geometry/spatial/face_tree.hpp"
#include "io/gltf/contents/resolved_materials.hpp"
#include "report/record.hpp"

#include <functional>
#include <memory>

namespace facetmill::report {

/// The properties of a stage that a page needs.
struct PageStep {
    std::string name;
    bool loads = false, moves = false, checks = false; ///< see StageInfo
    bool measures = false;                             ///< the page shows how far it moved the surface
};

/// Collects this data during a run. Pictures become smaller, and are finally omitted, to keep the page below
/// 3 MB; the record notes it. Calls throw the errors of picture_of (limit).
class Page {
  public:
    /// digest: equal for equal scenes.
    Page(RunRecord& record, std::function<std::string(const Scene&)> digest)
        : record_(record), digest_(std::move(digest)) {}

    /// Call it first: then it collects only deviations, for Markdown, and no pictures or histograms.
    void leave_out_pictures() { with_pictures_ = false; }

    /// The surface of a scene in the pose of pictures, with its tree, built on first use.
    class Shown {
      public:
        explicit Shown(const Scene& scene);
        Shown(const Shown&) = delete; // the tree refers to the surface
        Shown& operator=(const Shown&) = delete;
        bool is_same(const Shown& other) const;
        const Surface& surface() const { return surface_; }
        const Box& bounds();
        const FaceTree& tree();

      private:
        Surface surface_;
        std::optional<Box> bounds_;
        std::optional<FaceTree> tree_;
    };
    /// A reference scene for distances. The arms of a branch share it.
    struct Reference {
        std::string name; ///< "the scene as loaded"
        std::shared_ptr<Shown> shown;
        Index last_cap = 0; ///< later caps are not measured
        ShapeHistograms shape{};
        std::size_t faces = 0;
    };
    static std::shared_ptr<Reference> reference_to(const Scene& scene, std::string name);
    /// The reference of results; an arm that moves the scene replaces it.
    std::shared_ptr<Reference> reference() const { return loaded_; }
    void set_reference(std::shared_ptr<Reference> reference) { loaded_ = std::move(reference); }

    /// Reads each texture once for all pictures.
    io::MaterialResolver& materials() { return materials_; }

    /// The camera of the latest picture, with its scene's up axis; null before the first.
    const Camera* camera() const { return camera_.seen.empty() ? nullptr : &camera_; }
    UpAxis camera_up() const { return camera_up_; }

    /// Call it before the stage changes the scene.
    void before(const PageStep& step, const Scene& scene);
    /// Call it after the stage. Adds its picture, its measured distances, and its written results: the
    /// outputs from first_output on.
    void after(const PageStep& step, const Scene& scene, StageRecord& stage, std::size_t first_output);
    /// True if measure() needs the scene.
    bool is_measured(const PageStep& step, std::size_t first_output) const;
    /// Replaces after() if pictures are omitted.
    void measure(const PageStep& step, const Scene& scene, std::size_t first_output);
    /// Adds pictures of the failed checks from first_check on, and the scene if the run ends with them.
    void failures(const std::string& step, const Scene& scene, std::size_t first_check);
    /// True if the result with this name, or the final scene, differs from the reference.
    bool differs(const std::string& name) const;
    /// Call it at the end if nothing was written.
    void at_end(const Scene& scene);

  private:
    bool is_full() const;
    PictureSettings sized_for_page(double part) const;
    const Camera& camera_for(const Scene& scene);
    void add_picture(const Scene& scene, StageRecord& stage);
    void set_loaded(const PageStep& step, const Scene& scene);
    void add_results(std::size_t first_output, const Scene& scene);
    void add_result(const std::string& name, const Scene& scene);
    DeviationView distances(const Scene& scene, Reference& from);
    std::string picture_of_failure(const Scene& scene, const Check& check);

    RunRecord& record_;
    std::function<std::string(const Scene&)> digest_;
    bool with_pictures_ = true;
    std::shared_ptr<Reference> loaded_, entering_;
    std::shared_ptr<const Shown> shown_, shown_from_; ///< the scene of the last distances, and its reference
    std::string shown_at_, shown_stage_; ///< where they are shown, and the stage's name if it is a stage
    std::string last_picture_;           ///< the last picture, in base64
    /// Vertices and faces of its scene, with the digest if it was computed.
    std::optional<std::pair<std::size_t, std::size_t>> pictured_size_;
    std::string pictured_;
    Camera camera_;
    UpAxis camera_up_{};             ///< up axis of its scene
    int cameras_ = 0;                ///< number of cameras so far
    io::MaterialResolver materials_; ///< decodes textures of pictures once
    std::size_t bytes_ = 0, measured_stages_ = 0, failures_shown_ = 0;
};

} // namespace facetmill::report
