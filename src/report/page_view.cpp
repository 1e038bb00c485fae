#include "report/page_view.hpp"

#include "io/codec.hpp"

#include <fmt/format.h>

namespace facetmill::report {

namespace {

/// Larger surfaces are not kept as references: each triangle takes about 150 bytes with the tree.
constexpr std::size_t most_to_compare = 8000000;

} // namespace

std::shared_ptr<const ResolvedMaterials> PageView::materials(const Scene& scene) {
    std::vector<Diagnostic> ignored; // textures that cannot be drawn are not errors of the run
    return page_.materials().materials(scene, ignored);
}

void PageView::before(const Scene& scene) {
    if (has_before_) return;
    has_before_ = true;
    if (scene.face_count() == 0 && scene.parts.empty()) return;
    if (page_.camera()) viewed_.stand_as(*page_.camera(), page_.camera_up());
    viewed_.add_before(scene, "the input", materials(scene));
}

void PageView::written(const Scene& scene, const std::string& path) {
    const io::Codec* codec = io::codec_for(path);
    add(scene, path, codec ? codec->up : UpAxis::unknown);
}

void PageView::add(const Scene& scene, const std::string& name, UpAxis file_up) {
    const auto from = page_.reference();
    const bool compared = from && page_.differs(name) && from->faces > 0 && from->faces <= most_to_compare;
    ViewedFrom seen_from;
    if (compared) seen_from = {&from->shown->tree(), from->name, from->last_cap};
    seen_from.file_up = file_up;
    viewed_.add_after(scene, name, materials(scene), seen_from);
    any_after_ = true;
}

void PageView::failed(const std::string& name, const Scene& scene) {
    add(scene, fmt::format("the scene at '{}'", name));
}

void PageView::at_end(const Scene& scene) {
    if (!any_after_) add(scene, "the final scene");
}

} // namespace facetmill::report
