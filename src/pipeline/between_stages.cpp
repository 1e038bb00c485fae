#include "pipeline/between_stages.hpp"

#include "base/error.hpp"
#include "base/text/words.hpp"
#include "mesh/invariants.hpp"

#include <algorithm>
#include <bit>
#include <fmt/format.h>

namespace facetmill::pipeline {

namespace {

bool same_bits(double a, double b) { // the values may be NaN
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

} // namespace

std::string names_hint(const Scene& scene) {
    std::string names;
    for (const auto& part : scene.parts) append_item(names, part.name);
    return names.empty() ? "the scene is empty" : "their names: " + names.substr(0, 300);
}

void warn_of_empty_selection(const Step& step, const Scene& scene, Context& context) {
    for (const auto& part : scene.parts)
        if (step.only.selects(part, scene)) return;
    context.warn("W-ONLY", fmt::format("'only' selects none of the {} parts", scene.parts.size()),
                 names_hint(scene));
}

void require_finite(const Scene& scene) {
    if (const auto what = not_finite(scene))
        throw Error(ErrorKind::stage, "E-RANGE", fmt::format("{} exceeds 1.8e308, the largest number", *what),
                    "bring the scene near 1 in size before: transform: {scale: 1e-150}");
}

void check_invariants(const Step& step, const Scene& scene) {
    const auto broken = broken_invariants(scene);
    if (!broken.empty())
        throw Error(ErrorKind::bug, "E-INVARIANT",
                    fmt::format("'{}' left a scene that breaks an invariant: {}", step.name, broken.front()));
}

void check_left(const Step& step, const SceneState::Left& left, const Scene& scene) {
    const auto same = [](const PartSurface& a, const PartSurface& b) {
        return a.name == b.name && a.faces == b.faces && same_bits(a.area, b.area);
    };
    const auto surfaces = left.surfaces ? surfaces_of_parts(scene) : std::vector<PartSurface>();
    const auto is_right = [&](const Part& part, const PartSurface& known) {
        if (!known.size) return true;
        const SurfaceSize size = surface_size(part.mesh, part.transform);
        return same_bits(size.area, known.size->area) &&
               size.volume.has_value() == known.size->volume.has_value() &&
               same_bits(size.volume.value_or(0), known.size->volume.value_or(0));
    };
    const report::Brief brief = report::brief_of(scene);
    if (left.brief.parts == brief.parts && left.brief.vertices == brief.vertices &&
        left.brief.faces == brief.faces && left.brief.bounds.min == brief.bounds.min &&
        left.brief.bounds.max == brief.bounds.max &&
        (!left.surfaces ||
         (std::equal(surfaces.begin(), surfaces.end(), left.surfaces->begin(), left.surfaces->end(), same) &&
          std::equal(scene.parts.begin(), scene.parts.end(), left.surfaces->begin(), is_right))))
        return;
    throw Error(ErrorKind::bug, "E-INVARIANT",
                fmt::format("the scene has changed between '{}' and the stage before it", step.name));
}

} // namespace facetmill::pipeline
