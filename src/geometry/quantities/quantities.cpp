#include "geometry/quantities/quantities.hpp"

#include "geometry/deviation/deviation.hpp"
#include "geometry/inspect/inspect.hpp"
#include "geometry/measure/measure.hpp"
#include "geometry/spatial/signed_distances.hpp"
#include "mesh/placement.hpp"
#include "mesh/unit_text.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <limits>

namespace facetmill {

namespace {

constexpr double not_there = std::numeric_limits<double>::quiet_NaN();

Measure measure_of(PropertyKind kind) {
    switch (kind) {
    case PropertyKind::angle:
        return Measure::degrees;
    case PropertyKind::length:
        return Measure::length;
    case PropertyKind::area:
        return Measure::area;
    default:
        return Measure::number;
    }
}

std::vector<double> values_of_property(const Quantity& q, const Mesh& world, const FaceTree*) {
    return face_values(world, *property_named(q.name));
}

std::vector<double> areas(const Quantity&, const Mesh& world, const FaceTree*) {
    return measure_faces(world).areas;
}

std::vector<double> mean_curvatures(const Quantity&, const Mesh& world, const FaceTree*) {
    return measure_curvature(world).mean;
}

std::vector<double> gaussian_curvatures(const Quantity&, const Mesh& world, const FaceTree*) {
    return measure_curvature(world).gaussian;
}

std::vector<double> distances(const Quantity&, const Mesh& world, const FaceTree* other) {
    std::vector<double> values(world.vertex_count(), not_there);
    if (!other || other->empty()) return values;
    const auto found = signed_distances(*other, world.positions);
    parallel_for(values.size(), [&](std::size_t v) {
        const Vec3& p = world.positions[v];
        if (!is_finite(p)) return;
        values[v] = told_from_zero(std::abs(found[v]), p) > 0 ? found[v] : 0;
    });
    return values;
}

struct OfProperty {
    std::string_view name, missing;
    std::vector<std::string_view> other_names;
};

/// Details that are missing in the rows of properties.
const std::vector<OfProperty>& of_properties() {
    static const std::vector<OfProperty> all{
        {"min_angle", "", {"smallest_angle", "minimum_angle"}},
        {"max_angle", "", {"largest_angle", "maximum_angle"}},
        {"aspect_ratio", "for faces without area", {"aspect"}},
        {"detail", "if no face is in front of or behind the face", {"feature_size"}},
        {"gap", "if no face is in front of the face", {"gap_width", "clearance"}},
        {"wall_thickness", "if no face is behind the face", {"thickness", "wall"}},
    };
    return all;
}

std::vector<Quantity> all_quantities() {
    std::vector<Quantity> all;
    for (const Property& p : property_table()) {
        if (!p.of_faces) continue;
        Quantity q{.name = p.name, .measure = measure_of(p.kind), .help = p.help, .of = values_of_property};
        for (const OfProperty& more : of_properties())
            if (more.name == p.name) {
                q.missing = more.missing;
                q.other_names = more.other_names;
            }
        all.push_back(std::move(q));
    }
    all.push_back({.name = "area", .measure = Measure::area, .help = "The area of the face.", .of = areas});
    constexpr std::string_view rims = "at boundary vertices and non-manifold vertices";
    all.push_back({.name = "mean_curvature",
                   .domain = Domain::vertex,
                   .measure = Measure::per_length,
                   .help = "The mean curvature, positive where the surface bulges outward.",
                   .missing = rims,
                   .other_names = {"curvature"},
                   .is_signed = true,
                   .of = mean_curvatures});
    all.push_back({.name = "gaussian_curvature",
                   .domain = Domain::vertex,
                   .measure = Measure::per_area,
                   .help = "The Gaussian curvature, negative at saddles.",
                   .missing = rims,
                   .other_names = {"gauss_curvature"},
                   .is_signed = true,
                   .of = gaussian_curvatures});
    all.push_back({.name = "deviation",
                   .domain = Domain::vertex,
                   .measure = Measure::length,
                   .help = "The distance to the nearest point of another surface (with, or the scene as "
                           "loaded). Negative inside, which means behind the nearest face.",
                   .missing = "if the other surface is empty",
                   .other_names = {"distance", "signed_distance"},
                   .is_signed = true,
                   .compares = true,
                   .of = distances});
    return all;
}

} // namespace

const std::vector<Quantity>& quantities() {
    static const std::vector<Quantity> all = all_quantities();
    return all;
}

std::vector<std::string> quantity_names() {
    std::vector<std::string> names;
    for (const Quantity& q : quantities()) names.emplace_back(q.name);
    return names;
}

std::vector<std::string> quantity_words() {
    std::vector<std::string> words = quantity_names();
    for (const Quantity& q : quantities())
        words.insert(words.end(), q.other_names.begin(), q.other_names.end());
    return words;
}

const Quantity* quantity_named(std::string_view name) {
    for (const Quantity& q : quantities())
        if (q.name == name) return &q;
    return nullptr;
}

const Quantity* quantity_called(std::string_view word) {
    if (const Quantity* q = quantity_named(word)) return q;
    for (const Quantity& q : quantities())
        if (std::find(q.other_names.begin(), q.other_names.end(), word) != q.other_names.end()) return &q;
    return nullptr;
}

std::string unit_of(const Quantity& quantity, Unit unit) {
    const std::string many = unit_text(unit), one = unit == Unit::unknown ? "scene unit" : many;
    switch (quantity.measure) {
    case Measure::degrees:
        return "degrees";
    case Measure::length:
        return many;
    case Measure::area:
        return many + "^2";
    case Measure::per_length:
        return "1/" + one;
    case Measure::per_area:
        return "1/" + one + "^2";
    case Measure::number:
        break;
    }
    return {};
}

std::vector<double> values_of(const Quantity& quantity, const Part& part, const FaceTree* other) {
    const Mesh world = in_world(part);
    std::vector<double> values = quantity.of(quantity, world, other);
    values.resize(world.count(quantity.domain),
                  not_there); // curvature also has values at vertices where faces cross
    for (double& x : values)
        if (!std::isfinite(x)) x = not_there;
    return values;
}

void give_attribute(Part& part, const Quantity& quantity, std::vector<double> values,
                    std::optional<double> none) {
    for (double& x : values)
        if (none && std::isnan(x)) x = *none;
    for (const Domain domain : {Domain::vertex, Domain::wedge, Domain::face})
        part.mesh.drop(quantity.name, domain);
    part.mesh.attributes.push_back(
        {std::string(quantity.name), quantity.domain, Role::generic, 1, false, std::move(values)});
}

} // namespace facetmill
