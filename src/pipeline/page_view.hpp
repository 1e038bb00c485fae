#pragma once
// What the 3D view of a run's page shows: the scene as loaded, and what was written.

#include "pipeline/page.hpp"
#include "report/viewer.hpp"

namespace facetmill::pipeline {

/// Collects it while a run goes on. Calls throw as pictures do (limit).
class PageView {
  public:
    /// The page's textures and its references are used, too.
    PageView(const Steps& steps, Page& page);

    /// Before a stage works on the scene: what has been loaded by then is shown beside the outputs.
    void before(const Step& step, const Scene& scene);
    /// After a stage, and after the page knows of it: what it wrote are the outputs of the record from that
    /// number on. Their distances from the page's reference are shown where they are off it.
    void after(const Step& step, const Scene& scene, const report::RunRecord& record,
               std::size_t first_output);
    /// Where the run ended at a check of the stage of that name.
    void failed(const std::string& name, const Scene& scene);
    /// Where nothing was written, the scene at the end is shown.
    void at_end(const Scene& scene);
    /// See report::viewer_section.
    Json json() const { return viewed_.json(); }

  private:
    void add(const Scene& scene, const std::string& name);
    std::shared_ptr<const ResolvedMaterials> materials(const Scene& scene);

    report::ViewedScenes viewed_;
    Page& page_;
    bool has_before_ = false, any_after_ = false;
};

} // namespace facetmill::pipeline
