#include "pipeline/between_stages.hpp"

#include "base/error.hpp"
#include "base/words.hpp"
#include "mesh/invariants.hpp"

#include <algorithm>
#include <bit>
#include <fmt/format.h>

namespace facetmill::pipeline {

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
        throw Error(ErrorKind::stage, "E-RANGE",
                    fmt::format("{} came out beyond 1.8e308, the largest number", *what),
                    "bring the scene near 1 in size first: transform: {scale: ...}");
}

void check_invariants(const Step& step, const Scene& scene) {
    const auto broken = broken_invariants(scene);
    if (!broken.empty())
        throw Error(ErrorKind::bug, "E-INVARIANT",
                    fmt::format("'{}' left a scene that breaks an invariant: {}", step.name, broken.front()));
}

void check_left(const Step& step, const Flow::Left& left, const Scene& scene) {
    const auto same = [](const PartSurface& a, const PartSurface& b) {
        const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x); }; // it may be no number
        return a.name == b.name && a.faces == b.faces && bits(a.area) == bits(b.area);
    };
    const auto surfaces = left.surfaces ? surfaces_of_parts(scene) : std::vector<PartSurface>();
    const report::Brief brief = report::brief_of(scene);
    if (left.brief.parts == brief.parts && left.brief.vertices == brief.vertices &&
        left.brief.faces == brief.faces && left.brief.bounds.min == brief.bounds.min &&
        left.brief.bounds.max == brief.bounds.max &&
        (!left.surfaces ||
         std::equal(surfaces.begin(), surfaces.end(), left.surfaces->begin(), left.surfaces->end(), same)))
        return;
    throw Error(ErrorKind::bug, "E-INVARIANT",
                fmt::format("before '{}' the scene is no longer as the stage before left it", step.name));
}

} // namespace facetmill::pipeline
