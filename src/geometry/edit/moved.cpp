#include "geometry/edit/moved.hpp"

#include "parallel/parallel.hpp"

#include <algorithm>

namespace facetmill {

namespace {

/// Removes the component along the normal from each tangent; a tangent parallel to the normal stays
/// unchanged.
template <class Number>
void straighten(std::vector<Number>& tangents, const Attribute& normals) {
    parallel_for(tangents.size() / 4, [&](std::size_t i) {
        const Vec3 n{normals.value(i, 0), normals.value(i, 1), normals.value(i, 2)};
        Number* t = &tangents[4 * i];
        const Vec3 old{double(t[0]), double(t[1]), double(t[2])};
        const Vec3 flat = old - n * dot(n, old);
        const double size = length(flat);
        if (!(size > 1e-6 * length(old))) return;
        for (std::size_t c = 0; c < 3; ++c) t[c] = static_cast<Number>(flat[c] / size);
    });
}

bool straighten(Attribute& tangent, const Attribute& normals) {
    if (auto* floats = std::get_if<std::vector<float>>(&tangent.data)) {
        straighten(*floats, normals);
        return true;
    }
    if (auto* doubles = std::get_if<std::vector<double>>(&tangent.data)) {
        straighten(*doubles, normals);
        return true;
    }
    return false;
}

} // namespace

MoveSize move_size(const std::vector<Vec3>& before, const std::vector<Vec3>& after,
                   const Transform& to_world) {
    struct Sums {
        double largest = 0, all = 0; ///< largest square, and sum of squares
        std::size_t count = 0;
    };
    const Sums sums = parallel_reduce(
        before.size(), Sums{},
        [&](std::size_t begin, std::size_t end) {
            Sums s;
            for (std::size_t v = begin; v < end; ++v) {
                if (after[v] == before[v]) continue;
                const Vec3 d = to_world.vector(after[v] - before[v]);
                s.largest = std::max(s.largest, dot(d, d));
                s.all += dot(d, d);
                ++s.count;
            }
            return s;
        },
        [](const Sums& a, const Sums& b) {
            return Sums{std::max(a.largest, b.largest), a.all + b.all, a.count + b.count};
        });
    const double n = static_cast<double>(before.size());
    return {std::sqrt(sums.largest), n > 0 ? std::sqrt(sums.all / n) : 0, sums.count};
}

bool straighten_tangents(Mesh& mesh) {
    const Attribute* normals = mesh.find("NORMAL", Domain::wedge);
    bool any = false;
    for (auto& a : mesh.attributes)
        if (normals && a.role == Role::tangent && a.domain == Domain::wedge && a.components == 4)
            any |= straighten(a, *normals);
    return any;
}

AttributeChanges settle_moved(Mesh& mesh) {
    const auto normals = recompute_normals(mesh);
    const Attribute* normal = normals ? mesh.find("NORMAL", Domain::wedge) : nullptr;
    AttributeChanges changes;
    for (auto& a : mesh.attributes) {
        AttributeChange change{a.name, a.domain, AttributeChange::Kind::kept, ""};
        if (normals && a.name == normals->attribute && a.domain == normals->domain)
            change = *normals;
        else if (normal && a.role == Role::tangent && a.domain == Domain::wedge && a.components == 4 &&
                 straighten(a, *normal))
            change = {a.name, a.domain, AttributeChange::Kind::recomputed,
                      "made perpendicular to the new normals"};
        changes.push_back(std::move(change));
    }
    return changes;
}

} // namespace facetmill
