#include "stages/clean/unit_vectors.hpp"

#include "mesh/face.hpp"

#include <algorithm>
#include <cmath>

namespace facetmill::clean_stage {

namespace {

bool is_direction(const Attribute& a) { return a.role == Role::normal || a.role == Role::tangent; }

/// The sums of the area vectors of the faces at each element of the attribute.
std::vector<Vec3> area_vectors(const Mesh& mesh, const Attribute& a) {
    std::vector<Vec3> sums(a.size());
    for (Index f = 0; f < mesh.face_count(); ++f) {
        const Vec3 area = area_vector(mesh, f);
        for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c)
            sums[a.domain == Domain::face     ? f
                 : a.domain == Domain::vertex ? mesh.vertex(c)
                                              : mesh.corners[c]] += area;
    }
    return sums;
}

/// The direction of v, which may be very long or short; none if it has no direction.
std::optional<Vec3> direction_of(Vec3 v) {
    const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    if (!(largest > 0) || !std::isfinite(largest)) return {};
    v = v / largest;
    return v / length(v);
}

std::size_t scale_directions(const Mesh& mesh, Attribute& a) {
    constexpr double step = 1.0 / 127; // of the check unit_normals
    std::size_t scaled = 0;
    std::vector<Vec3> of_faces;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const Vec3 v{a.value(i, 0), a.value(i, 1), a.value(i, 2)};
        if (std::abs(length(v) - 1) <= step) continue;
        auto unit = direction_of(v);
        if (!unit && a.role == Role::normal) {
            if (of_faces.empty()) of_faces = area_vectors(mesh, a);
            unit = direction_of(of_faces[i]);
        }
        if (!unit) unit = Vec3{1, 0, 0};
        for (int c = 0; c < 3; ++c) a.set_value(i, c, (*unit)[static_cast<std::size_t>(c)]);
        ++scaled;
    }
    return scaled;
}

std::size_t scale_weights(Mesh& mesh) {
    constexpr double step = 1.0 / 255; // of the check weights_normalized
    std::vector<Attribute*> sets;
    for (Attribute& a : mesh.attributes)
        if (a.role == Role::weights) sets.push_back(&a);
    std::size_t scaled = 0;
    for (std::size_t i = 0; !sets.empty() && i < sets.front()->size(); ++i) {
        double sum = 0;
        for (const Attribute* a : sets)
            for (int c = 0; c < a->components; ++c) sum += a->value(i, c);
        if (std::abs(sum - 1) <= step) continue;
        const bool usable = sum > 0 && std::isfinite(sum);
        for (Attribute* a : sets)
            for (int c = 0; c < a->components; ++c)
                a->set_value(i, c, usable ? a->value(i, c) / sum : a == sets.front() && c == 0 ? 1 : 0);
        ++scaled;
    }
    return scaled;
}

} // namespace

AttributeChanges scale_to_unit(Mesh& mesh, std::size_t& scaled) {
    AttributeChanges changes = kept_changes(mesh.attributes);
    const auto record = [&](bool (*concerns)(const Attribute&), std::size_t count) {
        scaled += count;
        for (std::size_t i = 0; count > 0 && i < changes.size(); ++i)
            if (concerns(mesh.attributes[i])) {
                changes[i].kind = AttributeChange::Kind::recomputed;
                changes[i].why = "scaled to unit length or sum";
            }
    };
    std::size_t directions = 0;
    for (Attribute& a : mesh.attributes)
        if (is_direction(a)) directions += scale_directions(mesh, a);
    record(is_direction, directions);
    record([](const Attribute& a) { return a.role == Role::weights; }, scale_weights(mesh));
    return changes;
}

} // namespace facetmill::clean_stage
