#include "stages/crumple/report.hpp"

#include "mesh/placement.hpp"

#include <fmt/format.h>

namespace facetmill {

namespace {

/// Where the face of the split mesh was, in world space: the mean of its corners.
Vec3 place_of(const CrumpledPart& work, Index face) {
    const Mesh& mesh = work.part->mesh;
    Vec3 sum;
    for (Index c = mesh.face_begin(face); c < mesh.face_end(face); ++c) sum += work.before[mesh.vertex(c)];
    return work.to_world.point(sum / mesh.face_size(face));
}

Box world_box(const Part& part) {
    Box box;
    for (const Vec3& p : part.mesh.positions) box.add(in_world(part, p));
    return box;
}

} // namespace

Json described(const AvoidResult& r) {
    Json shares = Json::object();
    for (std::size_t i = 0; i < r.shares.size(); ++i)
        shares[i == 0 ? "1" : i + 1 == r.shares.size() ? "0" : fmt::format("1/{}", 1 << i)] = r.shares[i];
    return {{"kept_apart", "faces of the same part"},
            {"before", r.exempt},
            {"found", r.found},
            {"rounds", r.rounds},
            {"vertices_by_share", shares}};
}

void refuse_intersections(const AvoidResult& r, std::span<const CrumpledPart> parts, std::int64_t grid) {
    const CrumpledPart& work = parts[r.first_sheet];
    const auto pieces = static_cast<Index>(grid * grid); // of each face, one after the other
    const Index a = r.first.first / pieces, b = r.first.second / pieces;
    const Vec3 p = place_of(work, r.first.first);
    throw Error(
        ErrorKind::stage, "E-INTERSECTS",
        fmt::format("crumple: {} pairs of {} would run into each other, first {} of part '{}', near "
                    "({:.6g}, {:.6g}, {:.6g})",
                    r.found, grid > 1 ? "pieces of faces" : "faces",
                    a == b ? fmt::format("in face {} itself", a) : fmt::format("faces {} and {}", a, b),
                    work.part->name, p.x, p.y, p.z),
        "use self_intersections: avoid, or a smaller amplitude");
}

void warn_of_tangles(const CrumpledPart& work, double amplitude, Context& context) {
    const double edge = mean_edge(work.part->mesh, work.to_world);
    if (!(amplitude > edge && edge > 0)) return;
    context.warn(
        "W-AMPLITUDE",
        fmt::format("crumple: the amplitude {:.3g} is larger than the mean edge {:.3g} of part '{}': faces "
                    "run into each other",
                    amplitude, edge, work.part->name),
        fmt::format("use self_intersections: avoid, or an amplitude below about {:.2g}", edge / 4));
}

void warn_of_folds(const CrumpledPart& work, Context& context) {
    if (work.pieces.folded > 0)
        context.warn("W-SPLIT-FOLDED",
                     fmt::format("in part '{}' {} faces are concave or cross themselves: their pieces lie "
                                 "over each other",
                                 work.part->name, work.pieces.folded),
                     "triangulate before it");
}

void warn_of_parts(const Scene& scene, Context& context) {
    std::vector<Box> boxes;
    for (const Part& part : scene.parts) boxes.push_back(world_box(part));
    const auto overlap = [&](const Box& a, const Box& b) {
        bool both = !a.empty() && !b.empty();
        for (std::size_t i = 0; i < 3; ++i) both = both && a.min[i] <= b.max[i] && b.min[i] <= a.max[i];
        return both;
    };
    for (std::size_t i = 0; i < boxes.size(); ++i)
        for (std::size_t j = i + 1; j < boxes.size(); ++j) {
            const Part &a = scene.parts[i], &b = scene.parts[j];
            if (!overlap(boxes[i], boxes[j])) continue;
            if (!context.selects(a, scene) && !context.selects(b, scene)) continue;
            return context.warn("W-CRUMPLE-PARTS",
                                fmt::format("crumple keeps faces of one part apart; the boxes of the parts "
                                            "'{}' and '{}' overlap, so faces of one may meet the other",
                                            a.name, b.name),
                                "merge before it makes one part of them");
        }
}

} // namespace facetmill
