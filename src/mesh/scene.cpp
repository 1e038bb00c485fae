#include "mesh/scene.hpp"

#include "parallel/parallel.hpp"

namespace facetmill {

namespace {
struct UnitEntry {
    Unit unit;
    const char* name;
    double metres;
};
constexpr UnitEntry units[] = {
    {Unit::unknown, "unknown", 0}, {Unit::um, "um", 1e-6},     {Unit::mm, "mm", 1e-3},
    {Unit::cm, "cm", 1e-2},        {Unit::m, "m", 1},          {Unit::km, "km", 1e3},
    {Unit::inch, "in", 0.0254},    {Unit::foot, "ft", 0.3048},
};
} // namespace

double metres(Unit unit) { return units[static_cast<std::size_t>(unit)].metres; }

const char* to_string(Unit unit) { return units[static_cast<std::size_t>(unit)].name; }

const char* to_string(UpAxis up) { return up == UpAxis::y ? "y" : up == UpAxis::z ? "z" : "unknown"; }

std::optional<Unit> unit_named(std::string_view text) {
    for (const auto& u : units)
        if (text == u.name) return u.unit;
    if (text == "inch") return Unit::inch;
    if (text == "foot") return Unit::foot;
    return {};
}

Box Scene::bounds() const {
    Box all;
    for (const auto& part : parts) {
        if (part.transform.identity()) {
            all.add(part.mesh.bounds());
            continue;
        }
        const auto& positions = part.mesh.positions;
        all.add(parallel_reduce(
            positions.size(), Box{},
            [&](std::size_t begin, std::size_t end) {
                Box box;
                for (std::size_t v = begin; v < end; ++v) box.add(part.transform.point(positions[v]));
                return box;
            },
            [](Box a, const Box& b) {
                a.add(b);
                return a;
            }));
    }
    return all;
}

std::size_t Scene::face_count() const {
    std::size_t sum = 0;
    for (const auto& part : parts) sum += part.mesh.face_count();
    return sum;
}

} // namespace facetmill
