#pragma once
// What a page shows of a run and nothing else needs: pictures, distances as colours, histograms.

#include "geometry/render/render.hpp"
#include "geometry/spatial/face_tree.hpp"
#include "io/gltf/contents/resolved_materials.hpp"
#include "report/record.hpp"

#include <functional>
#include <memory>

namespace facetmill::report {

/// What a page has to know of a stage.
struct PageStep {
    std::string name;
    bool loads = false, moves = false, checks = false; ///< see StageInfo
    bool measures = false;                             ///< how far it moved the surface is shown
};

/// Collects it while a run goes on. Pictures become smaller, and are left out at last, before the page goes
/// beyond its 3 MB; the record says so. Calls throw as pictures do (limit).
class Page {
  public:
    /// digest: equal for scenes that are equal.
    Page(RunRecord& record, std::function<std::string(const Scene&)> digest)
        : record_(record), digest_(std::move(digest)) {}

    /// Before all else: collects no pictures and no histograms, but how far results are off, for Markdown.
    void leave_out_pictures() { with_pictures_ = false; }

    /// What a scene shows, in the pose that pictures show, and its tree, made when it is first needed.
    class Shown {
      public:
        explicit Shown(const Scene& scene);
        Shown(const Shown&) = delete; // the tree looks into the surface
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
    /// A scene that distances are taken from. Shared by the arms of a branch.
    struct Reference {
        std::string name; ///< "the scene as loaded"
        std::shared_ptr<Shown> shown;
        Index last_cap = 0; ///< what closes later cuts is not measured
        ShapeHistograms shape{};
        std::size_t faces = 0;
    };
    static std::shared_ptr<Reference> reference_to(const Scene& scene, std::string name);
    /// Of results; an arm that moves the scene has one of its own from there on.
    std::shared_ptr<Reference> reference() const { return loaded_; }
    void set_reference(std::shared_ptr<Reference> reference) { loaded_ = std::move(reference); }

    /// Reads textures once for all that is shown.
    io::MaterialResolver& materials() { return materials_; }

    /// Of the latest picture, and of which up axis its scene is; null before the first.
    const Camera* camera() const { return camera_.seen.empty() ? nullptr : &camera_; }
    UpAxis camera_up() const { return camera_up_; }

    /// Before the stage works on the scene.
    void before(const PageStep& step, const Scene& scene);
    /// After it: its picture, distances where it measured such, and the results that it wrote, which are the
    /// outputs from that number on.
    void after(const PageStep& step, const Scene& scene, StageRecord& stage, std::size_t first_output);
    /// Whether measure() looks at the scene.
    bool is_measured(const PageStep& step, std::size_t first_output) const;
    /// In the place of after(), where pictures are left out.
    void measure(const PageStep& step, const Scene& scene, std::size_t first_output);
    /// Pictures of the checks from that number on that did not hold; a run that ends there shows its scene.
    void failures(const std::string& step, const Scene& scene, std::size_t first_check);
    /// Whether the result of that name, or the scene where the run ends, is off the reference.
    bool differs(const std::string& name) const;
    /// When nothing was written.
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
    std::shared_ptr<const Shown> shown_, shown_from_; ///< of the last distances, and of what they were from
    std::string shown_at_, shown_stage_; ///< where these stand, and the name of the stage if it is one
    std::string last_picture_;           ///< its text
    /// Vertices and faces of its scene, and the digest of that where it was asked for.
    std::optional<std::pair<std::size_t, std::size_t>> pictured_size_;
    std::string pictured_;
    Camera camera_;
    UpAxis camera_up_{};             ///< of the scene that it is of
    int cameras_ = 0;                ///< so far
    io::MaterialResolver materials_; ///< textures of the pictures, decoded once
    std::size_t bytes_ = 0, measured_stages_ = 0, failures_shown_ = 0;
};

} // namespace facetmill::report
