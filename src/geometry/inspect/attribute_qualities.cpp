#include "geometry/inspect/attribute_qualities.hpp"

#include "base/parallel.hpp"
#include "base/random.hpp"
#include "geometry/edit/faces_at_vertices.hpp"
#include "geometry/inspect/place_keys.hpp"

#include <algorithm>
#include <cmath>

namespace facetmill {

namespace {

bool is_chosen(const Attribute& a, Quality q) {
    switch (q) {
    case Quality::uvs_in_range:
        return a.role == Role::uv;
    case Quality::unit_normals:
        return a.role == Role::normal || a.role == Role::tangent;
    case Quality::weights_sum:
        return a.role == Role::weights;
    case Quality::joints:
        return a.role == Role::joints;
    default:
        return true;
    }
}

bool outside_unit(const Attribute& a, std::size_t i) {
    for (int c = 0; c < a.components; ++c)
        if (!(a.value(i, c) >= 0 && a.value(i, c) <= 1)) return true;
    return false;
}

bool not_finite(const Attribute& a, std::size_t i) {
    for (int c = 0; c < a.components; ++c)
        if (!std::isfinite(a.value(i, c))) return true;
    return false;
}

bool not_unit(const Attribute& a, std::size_t i) {
    double sum = 0;
    for (int c = 0; c < std::min(3, a.components); ++c) sum += a.value(i, c) * a.value(i, c);
    return !(std::abs(std::sqrt(sum) - 1) <= 1.0 / 127); // a step of the coarsest type
}

/// Over all sets of weights, to a step of the coarsest type.
bool sum_is_not_one(const Mesh& mesh, std::size_t i) {
    double sum = 0;
    for (const auto& a : mesh.attributes)
        if (a.role == Role::weights)
            for (int c = 0; c < a.components; ++c) sum += a.value(i, c);
    return !(std::abs(sum - 1) <= 1.0 / 255);
}

/// The highest joint that the element names, and one.
double joints_of(const Attribute& a, std::size_t i) {
    double most = 0;
    for (int c = 0; c < a.components; ++c) most = std::max(most, a.value(i, c) + 1);
    return most;
}

bool is_bad(const Mesh& mesh, const Attribute& a, Quality q, std::size_t i,
            const std::function<bool(double)>& fails) {
    switch (q) {
    case Quality::uvs_in_range:
        return outside_unit(a, i);
    case Quality::unit_normals:
        return not_unit(a, i);
    case Quality::weights_sum:
        return sum_is_not_one(mesh, i);
    case Quality::joints:
        return fails && fails(joints_of(a, i));
    default:
        return not_finite(a, i);
    }
}

/// The attributes that are looked at; of the sets of weights, which are judged together, the first.
std::vector<Index> chosen(const Mesh& mesh, Quality q) {
    std::vector<Index> list;
    for (Index a = 0; a < mesh.attributes.size(); ++a)
        if (is_chosen(mesh.attributes[a], q)) list.push_back(a);
    if (q == Quality::weights_sum && list.size() > 1) list.resize(1);
    return list;
}

std::optional<double> joints(const Mesh& mesh) {
    std::optional<double> most;
    for (const Index a : chosen(mesh, Quality::joints))
        for (std::size_t i = 0; i < mesh.attributes[a].size(); ++i)
            most = std::max(most.value_or(0), joints_of(mesh.attributes[a], i));
    return most;
}

} // namespace

bool is_of_attributes(Quality q) {
    return q == Quality::uvs_in_range || q == Quality::finite_attributes || q == Quality::unit_normals ||
           q == Quality::weights_sum || q == Quality::joints;
}

std::optional<double> measure_attributes(const Mesh& mesh, Quality q) {
    if (q == Quality::joints) return joints(mesh);
    const auto looked_at = chosen(mesh, q);
    if (looked_at.empty() && q != Quality::finite_attributes) return {};
    for (const Index a : looked_at) {
        const int bad = parallel_reduce(
            mesh.attributes[a].size(), 0,
            [&](std::size_t begin, std::size_t end) {
                for (std::size_t i = begin; i < end; ++i)
                    if (is_bad(mesh, mesh.attributes[a], q, i, {})) return 1;
                return 0;
            },
            [](int x, int y) { return x | y; });
        if (bad != 0) return 0;
    }
    return 1;
}

std::vector<Place> places_against_attributes(const Mesh& mesh, Quality q, std::size_t limit,
                                             const std::function<bool(double)>& fails) {
    const auto faces = faces_at_vertices(mesh);
    std::vector<Place> places;
    for (const Index index : chosen(mesh, q)) {
        const Attribute& a = mesh.attributes[index];
        std::uint64_t name = 6;
        for (const char letter : a.name) name = hashed(name, static_cast<unsigned char>(letter));
        for (std::size_t i = 0; i < a.size() && places.size() < limit; ++i) {
            if (!is_bad(mesh, a, q, i, fails)) continue;
            const auto element = static_cast<Index>(i);
            if (a.domain == Domain::face)
                places.push_back(place_of(mesh, element));
            else {
                const Index v = a.domain == Domain::vertex ? element : mesh.vertex_of_wedge(element);
                places.push_back(
                    {.face = faces[v], .at = mesh.positions[v], .key = key_of_point(mesh.positions[v])});
            }
            places.back().attribute = index;
            places.back().key = hashed(name, places.back().key);
        }
    }
    return places;
}

} // namespace facetmill
