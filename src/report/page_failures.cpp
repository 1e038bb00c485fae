#include "report/page_failures.hpp"

#include "geometry/edit/surgery.hpp"
#include "geometry/spatial/rays.hpp"
#include "mesh/face.hpp"

#include <algorithm>
#include <cmath>

namespace facetmill::report {

namespace {

constexpr double close_zoom = 10;

bool is_failing(const Mesh& mesh, Index face) {
    const Attribute* failing = mesh.find(failing_attribute, Domain::face);
    return failing && failing->value(face, 0) > 0;
}

/// The part of the first entry, if it has the face.
const Part* part_of_first(const Scene& scene, const EvidenceEntry& first) {
    const auto found = std::find_if(scene.parts.begin(), scene.parts.end(), [&](const Part& part) {
        return part.name == first.name && first.face && *first.face < part.mesh.face_count();
    });
    return found == scene.parts.end() ? nullptr : &*found;
}

/// A position on a face, and the viewing direction.
struct Sight {
    Vec3 place, towards; ///< a unit vector
    double beyond = 0;   ///< points farther than this in front of the position are not on the face

    double ahead(const Vec3& p) const { return dot(p - place, towards); }
};

/// True if the face is between the position and the viewer.
bool is_on_the_way(const Part& part, Index face, const Sight& sight) {
    const Mesh& mesh = part.mesh;
    const Index begin = mesh.face_begin(face), end = mesh.face_end(face);
    const Vec3 a = part.transform.point(mesh.point(begin));
    for (Index c = begin + 1; c + 1 < end; ++c) {
        const Vec3 b = part.transform.point(mesh.point(c)), d = part.transform.point(mesh.point(c + 1));
        if (passes(sight.place, sight.place + sight.towards, a, b, d) == 0) continue;
        const Vec3 normal = cross(b - a, d - a);
        if (dot(normal, a - sight.place) / dot(normal, sight.towards) > sight.beyond) return true;
    }
    return false;
}

/// True if the whole face is in front of the position.
bool is_before(const Part& part, Index face, const Sight& sight) {
    for (Index c = part.mesh.face_begin(face); c < part.mesh.face_end(face); ++c)
        if (!(sight.ahead(part.transform.point(part.mesh.point(c))) > sight.beyond)) return false;
    return true;
}

bool is_hidden(const Scene& scene, const Sight& sight) {
    return std::any_of(scene.parts.begin(), scene.parts.end(), [&](const Part& part) {
        for (Index f = 0; f < part.mesh.face_count(); ++f)
            if (!is_failing(part.mesh, f) && is_on_the_way(part, f, sight)) return true;
        return false;
    });
}

/// Removes the faces in front of the position, except faces of the check.
Scene without_what_hides(Scene scene, const Sight& sight) {
    for (Part& part : scene.parts) {
        std::vector<Index> kept;
        for (Index f = 0; f < part.mesh.face_count(); ++f)
            if (is_failing(part.mesh, f) || (!is_before(part, f, sight) && !is_on_the_way(part, f, sight)))
                kept.push_back(f);
        if (kept.size() < part.mesh.face_count()) part.mesh = keep_faces(part.mesh, kept);
    }
    return scene;
}

} // namespace

Scene with_failing_faces(const Scene& scene, const Check& check) {
    Scene out = scene;
    for (Part& part : out.parts) {
        std::vector<float> failing(part.mesh.face_count());
        for (const auto& entry : *check.evidence)
            if (entry.name == part.name)
                for (const auto& face : {entry.face, entry.with})
                    if (face && *face < failing.size()) failing[*face] = 1;
        std::erase_if(part.mesh.attributes, [](const Attribute& a) { return a.name == failing_attribute; });
        part.mesh.attributes.push_back(
            {failing_attribute, Domain::face, Role::generic, 1, false, std::move(failing)});
    }
    return out;
}

CloseView close_view(const Scene& marked, const Check& check, PictureSettings settings) {
    const EvidenceEntry& first = check.evidence->front();
    const double whole = marked.bounds().diagonal();
    settings.zoom = close_zoom;
    const Part* part = whole > 0 ? part_of_first(marked, first) : nullptr;
    if (!part) return {marked, settings};
    const auto f = static_cast<Index>(*first.face);
    Box box;
    for (Index c = part->mesh.face_begin(f); c < part->mesh.face_end(f); ++c)
        box.add(part->transform.point(part->mesh.point(c)));
    const double zoom = whole / (6 * box.diagonal());
    if (std::isfinite(zoom)) settings.zoom = std::clamp(zoom, 3.0, 400.0);
    const Vec3 normal = area_vector(part->mesh, f, part->transform);
    if (!is_finite(normal) || !(length(normal) > 0)) return {marked, settings};
    settings.from = normal;
    const Sight sight{part->transform.point(corner_mean(part->mesh, f)), normalised(normal), 1e-6 * whole};
    if (!is_hidden(marked, sight)) return {marked, settings};
    return {without_what_hides(marked, sight), settings};
}

} // namespace facetmill::report
