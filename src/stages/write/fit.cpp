#include "stages/write/fit.hpp"

#include "base/text/words.hpp"
#include "geometry/clean/clean.hpp"
#include "io/flatten.hpp"
#include "stage/read_written.hpp"

#include <cmath>
#include <fmt/format.h>

namespace facetmill::write_stage {

namespace {

/// The steps that keep a mesh fit. on_grid: for a file with a grid, on which new points cannot be placed.
CleanSettings settings_for(const Purpose& purpose, bool on_grid) {
    CleanSettings s;
    s.single = !on_grid;
    if (!purpose.is_solid) {
        s.t_junctions = Nearness::off;
        s.non_manifold = false;
    } else if (!on_grid) {
        s.apart = true;
        s.self_intersections = Untangle::all;
    }
    return s;
}

/// Moves vertices to the nearest points of the grid, as the file will. The file may round ties differently.
void round_to_grid(Mesh& mesh, const io::WriteSettings& settings, std::size_t part) {
    const Box box = mesh.bounds();
    if (box.empty()) return;
    io::Lattice grid = settings.lattice(part);
    if (!(grid.step > 0)) {
        const auto steps = static_cast<double>((std::int64_t{1} << settings.grid_bits(part)) - 1);
        grid = {box.min, box.longest_side() / steps};
    }
    if (!(grid.step > 0)) return;
    for (Vec3& p : mesh.positions)
        for (std::size_t axis = 0; axis < 3; ++axis)
            p[axis] = grid.origin[axis] + std::round((p[axis] - grid.origin[axis]) / grid.step) * grid.step;
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
                                          const io::WriteSettings& write, Context& context) {
    std::vector<std::optional<Mesh>> replaced(scene.parts.size());
    UntangleBudget budget;
    for (std::size_t k = 0; k < scene.parts.size(); ++k) {
        Part& part = scene.parts[k];
        if (part.mesh.face_count() == 0) continue;
        Mesh mesh = codec.can.transforms ? part.mesh : *io::WorldMesh(part);
        const bool on_grid = write.grid_bits(k) > 0;
        if (on_grid) round_to_grid(mesh, write, k);
        CleanSettings settings = settings_for(purpose, on_grid);
        settings.budget = budget;
        CleanResult r = clean(std::move(mesh), settings);
        budget = r.budget;
        const std::size_t repairs = r.counts.total() - r.counts.rounded_vertices;
        if (repairs == 0) continue;
        context.say(fmt::format("'{}' fits {} with the file's rounding after {}", part.name, purpose.name,
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
