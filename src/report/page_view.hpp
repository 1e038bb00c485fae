#pragma once
// What the 3D view of a run's page shows: the scene as loaded, and what was written.

#include "report/page.hpp"
#include "report/viewer.hpp"

namespace facetmill::report {

/// Collects it while a run goes on. Calls throw as pictures do (limit).
class PageView {
  public:
    /// expected: about how many outputs there will be. The page's textures and its references are used, too.
    PageView(std::size_t expected, Page& page) : viewed_(1 + expected), page_(page) {}

    /// Before a stage works on the scene: what has been loaded by then is shown beside the outputs.
    void before(const Scene& scene);
    /// Of a scene that was written to this path, after the page knows of it: its distances from the page's
    /// reference are shown where it is off that.
    void written(const Scene& scene, const std::string& path) { add(scene, path); }
    /// Where the run ended at a check of the stage of that name.
    void failed(const std::string& name, const Scene& scene);
    /// Where nothing was written, the scene at the end is shown.
    void at_end(const Scene& scene);
    /// See viewer_section.
    Json json() const { return viewed_.json(); }

  private:
    void add(const Scene& scene, const std::string& name);
    std::shared_ptr<const ResolvedMaterials> materials(const Scene& scene);

    ViewedScenes viewed_;
    Page& page_;
    bool has_before_ = false, any_after_ = false;
};

} // namespace facetmill::report
