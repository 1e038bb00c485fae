#pragma once
// What the 3D view of a run's page shows: the scene as loaded, and what was written.

#include "io/gltf/looks.hpp"
#include "mesh/surface.hpp"
#include "pipeline/plan.hpp"
#include "report/viewer.hpp"

namespace facetmill::pipeline {

/// Collects it while a run goes on. Calls throw as pictures do (limit).
class PageView {
  public:
    explicit PageView(const Steps& steps);

    /// Before a stage works on the scene: what has been loaded by then is what outputs are compared with.
    void before(const Step& step, const Scene& scene);
    /// After a stage: what it wrote are the outputs of the record from that number on. Their deviation from
    /// what was loaded is shown where the run has measured one.
    void after(const Step& step, const Scene& scene, const report::RunRecord& record,
               std::size_t first_output);
    /// Where nothing was written, the scene at the end is shown.
    void at_end(const Scene& scene);
    /// See report::viewer_section.
    Json json() const { return viewed_.json(); }

  private:
    void add(const Scene& scene, const std::string& name, bool show_deviation);
    std::shared_ptr<const MaterialLooks> looks(const Scene& scene);

    report::ViewedScenes viewed_;
    io::LookReader reader_;
    bool has_before_ = false, any_after_ = false;
    std::optional<Surface> loaded_; ///< none: nothing was, or something more later on
    std::optional<FaceTree> tree_;  ///< of loaded_, once it is needed
};

} // namespace facetmill::pipeline
