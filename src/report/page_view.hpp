#pragma once
// The contents of the 3D view of a run's page: the scene as loaded, and the outputs.

#include "report/page.hpp"
#include "report/viewer.hpp"

namespace facetmill::report {

/// Collects these scenes during a run. Calls throw the errors of picture_of (limit).
class PageView {
  public:
    /// expected: the approximate number of outputs. Uses the page's textures and references.
    PageView(std::size_t expected, Page& page) : viewed_(1 + expected), page_(page) {}

    /// Call it before a stage changes the scene. It shows the scene as loaded next to the outputs.
    void before(const Scene& scene);
    /// Adds a written scene; call it after the page has it. Shows its distances from the page's reference if
    /// they differ.
    void written(const Scene& scene, const std::string& path);
    /// Adds the scene at a failed check of that stage.
    void failed(const std::string& name, const Scene& scene);
    /// Adds the final scene if nothing was written.
    void at_end(const Scene& scene);
    /// See viewer_section.
    Json json() const { return viewed_.json(); }

  private:
    void add(const Scene& scene, const std::string& name, UpAxis file_up = UpAxis::unknown);
    std::shared_ptr<const ResolvedMaterials> materials(const Scene& scene);

    ViewedScenes viewed_;
    Page& page_;
    bool has_before_ = false, any_after_ = false;
};

} // namespace facetmill::report
