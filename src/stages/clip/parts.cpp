#include "stages/clip/parts.hpp"

#include "stage/both_sides.hpp"

#include <fmt/format.h>

namespace facetmill {

namespace {

/// What users should know of a clip: open contours, everything kept, nothing kept.
void warn(const Part& part, const ClipResult& r, bool had_faces, Context& context) {
    warn_of_open("clip", part, r.open, context);
    if (!r.changed && had_faces)
        context.warn("W-CLIP-ALL",
                     fmt::format("clip: no plane cuts part '{}'; all of it was kept", part.name),
                     "check the position and direction of the plane; info prints the bounds");
    if (had_faces && r.front.face_count() + r.back.face_count() == 0)
        context.warn("W-CLIP-NOTHING", fmt::format("clip: nothing of part '{}' was kept", part.name),
                     "check the position and direction of the plane; keep: back keeps the other side");
}

} // namespace

ClipReport clip_parts(Scene& scene, const Cutter& cutter, const PartsToClip& how, Context& context) {
    ClipSettings settings = how.settings;
    if (settings.cap) set_cap(settings, scene, how.cap_material);
    BothSides sides(scene);
    ClipReport report;
    if (!cutter.world().empty()) report.planes = cutter.world();
    context.for_each_part(scene, [&](Part& part) {
        const bool had_faces = part.mesh.face_count() > 0;
        settings.planes = cutter.planes_for(part);
        settings.memory = part.cuts ? *part.cuts : CutMemory{};
        ClipResult r = clip(std::move(part.mesh), settings);
        warn(part, r, had_faces, context);
        context.attribute_changes(part, r.changes);
        report.cut_faces += r.cut_faces;
        report.cap_faces += r.cap_faces;
        report.open_contours += r.open.size();
        report.on_plane += r.on_plane;
        report.snapped += r.snapped;
        report.remembered += r.remembered;
        if (!r.memory.entries.empty()) part.cuts = std::make_shared<const CutMemory>(std::move(r.memory));
        part.mesh = {};
        if (settings.keep == Keep::both) sides.part_in_two(part, how.front, how.back, std::move(r.back));
        part.mesh = std::move(settings.keep == Keep::back ? r.back : r.front);
    });
    if (report.cap_faces > 0) add_material(scene, how.cap_material);
    sides.insert();
    return report;
}

} // namespace facetmill
