#include "stages/write/fit.hpp"

#include "base/text/words.hpp"
#include "geometry/clean/clean.hpp"
#include "io/flatten.hpp"
#include "stage/read_written.hpp"

#include <fmt/format.h>

namespace facetmill::write_stage {

namespace {

CleanSettings settings_for(const Purpose& purpose) {
    CleanSettings s;
    s.single = true;
    if (purpose.is_solid) {
        s.apart = true;
        s.self_intersections = Untangle::all;
    } else {
        s.weld = s.t_junctions = Nearness::off;
        s.non_manifold = false;
    }
    return s;
}

/// A way to a file that fits.
std::string way_out(const io::Codec& codec, const Scene& scene, const io::WriteSettings& settings) {
    if (!codec.can.transforms && scene.parts.size() > 1)
        return fmt::format("{} joins the parts: put merge and clean: {{self_intersections: union}} before "
                           "the check, or write 3MF",
                           codec.name);
    if (settings.draco.on || settings.quantize.on)
        return "write without draco, quantize and meshopt, or with more bits of positions";
    return "write PLY or OBJ with precision: full, which keep the coordinates that were checked";
}

} // namespace

std::vector<std::optional<Mesh>> make_fit(Scene& scene, const Purpose& purpose, const io::Codec& codec,
                                          Context& context) {
    std::vector<std::optional<Mesh>> replaced(scene.parts.size());
    UntangleBudget budget;
    for (std::size_t k = 0; k < scene.parts.size(); ++k) {
        Part& part = scene.parts[k];
        if (part.mesh.face_count() == 0) continue;
        CleanSettings settings = settings_for(purpose);
        settings.budget = budget;
        CleanResult r = clean(codec.can.transforms ? part.mesh : *io::WorldMesh(part), settings);
        budget = r.budget;
        const std::size_t repairs = r.counts.total() - r.counts.rounded_vertices;
        if (repairs == 0) continue;
        context.say(fmt::format("'{}' made fit for {} in 32-bit floats by {}", part.name, purpose.name,
                                counted(repairs, "repair")));
        context.attribute_changes(part, r.changes);
        replaced[k] = std::exchange(part.mesh, std::move(r.mesh));
        part.changed = true;
        if (!codec.can.transforms) part.transform = {};
    }
    return replaced;
}

bool check_fit(const WrittenScene& file, const Purpose& purpose, const Scene& scene,
               const io::WriteSettings& settings, Context& context) {
    const Scene there = read_written(file, scene, context);
    const Assertions& assertions = purpose.assertions;
    bool fits = true;
    for (auto& check : evaluate(assertions, inspect(there, assertions.settings()), context.name())) {
        if (check.passed) continue;
        fits = false;
        check.file = file.path;
        check.hint = way_out(*io::codec_named(file.format), scene, settings);
        context.check(std::move(check));
    }
    return fits;
}

} // namespace facetmill::write_stage
