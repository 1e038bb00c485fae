// Implements the properties of attributes.
#include "base/math/random.hpp"
#include "geometry/inspect/measures.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>

namespace facetmill::inspect_room {

namespace {

/// A truth property of the elements of some attributes.
struct AttributeCheck {
    bool (*concerns)(const Attribute& attribute);
    /// Whether element i violates the property.
    bool (*fails)(const Mesh& mesh, const Attribute& attribute, std::size_t i);
    bool together = false; ///< all of these attributes are judged together and reported with the first
    bool of_any = false; ///< true if it holds for a mesh without such attributes; otherwise it does not apply
};

bool outside_unit(const Mesh&, const Attribute& a, std::size_t i) {
    for (int c = 0; c < a.components; ++c)
        if (!(a.value(i, c) >= 0 && a.value(i, c) <= 1)) return true;
    return false;
}

bool not_finite(const Mesh&, const Attribute& a, std::size_t i) {
    for (int c = 0; c < a.components; ++c)
        if (!std::isfinite(a.value(i, c))) return true;
    return false;
}

bool not_unit(const Mesh&, const Attribute& a, std::size_t i) {
    double sum = 0;
    for (int c = 0; c < std::min(3, a.components); ++c) sum += a.value(i, c) * a.value(i, c);
    return !(std::abs(std::sqrt(sum) - 1) <= 1.0 / 127); // within a step of the coarsest type
}

/// Tests the sum over all sets of weights, within a step of the coarsest type.
bool sum_is_not_one(const Mesh& mesh, const Attribute&, std::size_t i) {
    double sum = 0;
    for (const auto& a : mesh.attributes)
        if (a.role == Role::weights)
            for (int c = 0; c < a.components; ++c) sum += a.value(i, c);
    return !(std::abs(sum - 1) <= 1.0 / 255);
}

bool is_uv(const Attribute& a) { return a.role == Role::uv; }
bool is_any(const Attribute&) { return true; }
bool is_direction(const Attribute& a) { return a.role == Role::normal || a.role == Role::tangent; }
bool is_weights(const Attribute& a) { return a.role == Role::weights; }
bool is_joints(const Attribute& a) { return a.role == Role::joints; }

constexpr AttributeCheck uv_range{.concerns = is_uv, .fails = outside_unit};
constexpr AttributeCheck finite{.concerns = is_any, .fails = not_finite, .of_any = true};
constexpr AttributeCheck unit_length{.concerns = is_direction, .fails = not_unit};
constexpr AttributeCheck weight_sum{.concerns = is_weights, .fails = sum_is_not_one, .together = true};

std::vector<Index> chosen(const Mesh& mesh, bool (*concerns)(const Attribute&), bool first_only = false) {
    std::vector<Index> list;
    for (Index a = 0; a < mesh.attributes.size(); ++a)
        if (concerns(mesh.attributes[a])) list.push_back(a);
    if (first_only && list.size() > 1) list.resize(1);
    return list;
}

std::optional<double> holds(const Mesh& mesh, const AttributeCheck& check) {
    const auto attributes = chosen(mesh, check.concerns, check.together);
    if (attributes.empty() && !check.of_any) return {};
    for (const Index a : attributes) {
        const int bad = parallel_reduce(
            mesh.attributes[a].size(), 0,
            [&](std::size_t begin, std::size_t end) {
                for (std::size_t i = begin; i < end; ++i)
                    if (check.fails(mesh, mesh.attributes[a], i)) return 1;
                return 0;
            },
            [](int x, int y) { return x | y; });
        if (bad != 0) return 0;
    }
    return 1;
}

/// The elements of the attributes for which fails(attribute, element) is true.
template <class Fails>
std::vector<Location> failing(const Mesh& mesh, const std::vector<Index>& attributes, std::size_t limit,
                              Fails&& fails) {
    const auto faces = faces_at_vertices(mesh);
    std::vector<Location> found;
    for (const Index index : attributes) {
        const Attribute& a = mesh.attributes[index];
        std::uint64_t name = 6;
        for (const char letter : a.name) name = hashed(name, static_cast<unsigned char>(letter));
        for (std::size_t i = 0; i < a.size() && found.size() < limit; ++i) {
            if (!fails(a, i)) continue;
            const auto element = static_cast<Index>(i);
            if (a.domain == Domain::face)
                found.push_back(location_of(mesh, element));
            else
                found.push_back(location_of_vertex(
                    mesh, a.domain == Domain::vertex ? element : mesh.vertex_of_wedge(element), faces));
            found.back().attribute = index;
            found.back().key = hashed(name, found.back().key);
        }
    }
    return found;
}

std::vector<Location> failing(const Mesh& mesh, const AttributeCheck& check, const LocationQuery& query) {
    return failing(mesh, chosen(mesh, check.concerns, check.together), query.limit,
                   [&](const Attribute& a, std::size_t i) { return check.fails(mesh, a, i); });
}

/// One more than the highest joint of the element.
double joints_of(const Attribute& a, std::size_t i) {
    double most = 0;
    for (int c = 0; c < a.components; ++c) most = std::max(most, a.value(i, c) + 1);
    return most;
}

} // namespace

std::optional<double> has_uvs_in_range(const Measured& mesh) { return holds(mesh.local, uv_range); }
std::optional<double> has_finite_attributes(const Measured& mesh) { return holds(mesh.local, finite); }
std::optional<double> has_unit_normals(const Measured& mesh) { return holds(mesh.local, unit_length); }
std::optional<double> has_normalized_weights(const Measured& mesh) { return holds(mesh.local, weight_sum); }

std::optional<double> joint_count(const Measured& mesh) {
    std::optional<double> most;
    for (const Index a : chosen(mesh.local, is_joints))
        for (std::size_t i = 0; i < mesh.local.attributes[a].size(); ++i)
            most = std::max(most.value_or(0), joints_of(mesh.local.attributes[a], i));
    return most;
}

std::vector<Location> uvs_out_of_range(const Mesh& mesh, const LocationQuery& query) {
    return failing(mesh, uv_range, query);
}
std::vector<Location> numbers_not_finite(const Mesh& mesh, const LocationQuery& query) {
    return failing(mesh, finite, query);
}
std::vector<Location> normals_not_unit(const Mesh& mesh, const LocationQuery& query) {
    return failing(mesh, unit_length, query);
}
std::vector<Location> weights_not_normalized(const Mesh& mesh, const LocationQuery& query) {
    return failing(mesh, weight_sum, query);
}
std::vector<Location> too_high_joints(const Mesh& mesh, const LocationQuery& query) {
    return failing(mesh, chosen(mesh, is_joints), query.limit, [&](const Attribute& a, std::size_t i) {
        return query.fails && query.fails(joints_of(a, i));
    });
}

} // namespace facetmill::inspect_room
