#include "stages/load/lines.hpp"

#include "base/sort_unique.hpp"
#include "base/text/words.hpp"
#include "geometry/tubes/tubes.hpp"
#include "mesh/power_scale.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::load_stage {

namespace {

double thickness_of(const Length& given, const Scene& scene, const std::vector<Lines>& all,
                    Context& context) {
    Length length = given;
    if (given.kind ==
        Length::Kind::percent) { // refers to the file, because the scene does not contain it yet
        Box box = scene.bounds();
        for (const Lines& lines : all)
            for (const Vec3& p : lines.points) box.add(p);
        length.kind = Length::Kind::scene;
        length.amount = given.amount / 100 * diagonal(box);
    }
    const double thickness = context.resolve(length, scene, "lines");
    if (!(thickness > 0))
        throw Error(ErrorKind::stage, "E-LINES",
                    "the thickness of the lines is 0 because all lines are at one point",
                    "give the thickness in scene units");
    return thickness;
}

/// Makes a primitive for each material in use, in the scene's order.
void set_materials(Mesh& mesh, std::vector<Index> face_material) {
    std::vector<Index> used(face_material);
    sort_unique(used);
    if (used == std::vector{none}) return;
    for (const Index m : used) mesh.primitives.push_back({m, {}, {}});
    if (used.size() < 2) return;
    for (Index& m : face_material)
        m = static_cast<Index>(std::lower_bound(used.begin(), used.end(), m) - used.begin());
    mesh.attributes.push_back(
        {std::string(primitive_attribute), Domain::face, Role::index, 1, false, std::move(face_material)});
}

std::string name_of(const Lines& lines, const Scene& scene) {
    const bool taken = std::any_of(scene.parts.begin(), scene.parts.end(),
                                   [&](const Part& part) { return part.name == lines.name; });
    return taken ? lines.name + "_lines" : lines.name;
}

} // namespace

void add_tubes(Scene& scene, const std::vector<Lines>& all, const Length& thickness, int sides,
               Context& context) {
    if (all.empty()) {
        context.warn("W-LINES", "'lines' is given, but the file has no lines", "leave lines out");
        return;
    }
    const double diameter = thickness_of(thickness, scene, all, context);
    std::size_t sharp = 0, made = 0, segments = 0;
    for (const Lines& lines : all) {
        TubesResult r = tubes(lines, {diameter, sides});
        sharp += r.sharp;
        made += r.tubes;
        segments += r.segments;
        set_materials(r.mesh, std::move(r.face_material));
        Part part;
        part.name = name_of(lines, scene);
        part.mesh = std::move(r.mesh);
        scene.parts.push_back(std::move(part));
    }
    context.say(counted(segments, "line") + " became " + counted(made, "tube"));
    if (sharp > 0)
        context.warn(
            "W-LINES",
            fmt::format(
                "the tubes intersect themselves at {}, too sharp or with sides too short for their thickness",
                counted(sharp, "corner")),
            "use clean: {self_intersections: union} to turn them into a solid");
}

} // namespace facetmill::load_stage
