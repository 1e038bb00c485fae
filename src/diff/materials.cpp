#include "base/progress.hpp"
#include "diff/line_shape.hpp"
#include "diff/lines.hpp"
#include "geometry/triangulate/crossing_faces.hpp"
#include "io/gltf/gltf.hpp"
#include "mesh/lines.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <map>

namespace facetmill::report {

namespace {

Json colour_of(const Material& m) {
    const double* c = m.base_colour;
    return fmt::format("{:.6g} {:.6g} {:.6g} {:.6g}", c[0], c[1], c[2], c[3]);
}

/// Different entries of two descriptions, by path.
std::map<std::string, std::pair<Json, Json>> different_entries(const Json& a, const Json& b) {
    std::map<std::string, std::pair<Json, Json>> entries;
    const auto flat = [](const Json& json) { return json.empty() ? Json::object() : json.flatten(); };
    const Json x = flat(a), y = flat(b);
    for (const auto& [path, value] : x.items()) entries[path].first = value;
    for (const auto& [path, value] : y.items()) entries[path].second = value;
    std::erase_if(entries, [](const auto& entry) { return entry.second.first == entry.second.second; });
    return entries;
}

/// A structured value as text.
Json in_short(const Json& value) { return value.is_structured() ? Json(value.dump()) : value; }

/// Removes data that is compared elsewhere, and default values.
Json beside_basics(Json material) {
    for (const char* key : {"name", "doubleSided"}) material.erase(key);
    const Json::json_pointer volume("/extensions/KHR_materials_volume");
    if (material.contains(volume) && material[volume].is_object())
        material[volume].erase("thicknessFactor"); // its meaning depends on the scale of the mesh
    if (const auto pbr = material.find("pbrMetallicRoughness"); pbr != material.end()) {
        pbr->erase("baseColorFactor");
        if (pbr->empty()) material.erase("pbrMetallicRoughness");
    }
    return material;
}

/// True if no other data is left; other formats write materials as non-metallic.
bool is_plain(const Json& material) {
    const Json left = beside_basics(material);
    return left.empty() || left == Json{{"pbrMetallicRoughness", {{"metallicFactor", 0}}}};
}

/// Compares the data of a material that only glTF has.
void compare_contents(const Comparing& with, io::MaterialContents& of_a, io::MaterialContents& of_b,
                      std::size_t i) {
    const std::string name = fmt::format("{}", i);
    try {
        const Json a = of_a.of(with.a.materials[i]);
        const Json b = of_b.of(with.b.materials[i]);
        if (a.is_null() != b.is_null()) {
            if (!is_plain(a.is_null() ? b : a))
                with.leave("materials", name + " as glTF", !a.is_null(), !b.is_null(),
                           "only one file is glTF");
            return;
        }
        if (a.is_null()) return;
        const auto entries = different_entries(beside_basics(a), beside_basics(b));
        for (const auto& [path, values] : entries)
            with.add("materials", name + path, in_short(values.first), in_short(values.second), false);
        if (entries.empty()) with.add("materials", name + " as glTF", true, true);
    } catch (const Error& e) {
        with.leave("materials", name + " as glTF", nullptr, nullptr, e.what());
    }
}

/// The material of every face, in the order of parts and faces.
std::vector<Index> materials_of_faces(const Scene& scene) {
    std::vector<Index> all;
    for (const Part& part : scene.parts)
        for (Index f = 0; f < part.mesh.face_count(); ++f) {
            const Index p = part.mesh.primitive_of(f);
            all.push_back(p < part.mesh.primitives.size() ? part.mesh.primitives[p].material : none);
        }
    return all;
}

/// The part of a surface with a given material.
Surface of_material(const Surface& surface, const std::vector<Index>& materials, Index material) {
    Surface out;
    out.positions = surface.positions;
    for (std::size_t t = 0; t < surface.size(); ++t)
        if (materials[surface.face(t)] == material) {
            out.corners.insert(out.corners.end(),
                               surface.corners.begin() + static_cast<std::ptrdiff_t>(3 * t),
                               surface.corners.begin() + static_cast<std::ptrdiff_t>(3 * t + 3));
            out.faces.push_back(surface.face(t));
        }
    return out;
}

/// The materials of both, if there are several; otherwise none.
std::set<Index> materials_to_compare(const std::vector<Index>& a, const std::vector<Index>& b) {
    if (a == b || a.empty() || b.empty()) return {};
    std::set<Index> all(a.begin(), a.end());
    all.insert(b.begin(), b.end());
    return all.size() < 2 ? std::set<Index>{} : all;
}

/// The allowed distance between a material's positions, in a scene of these bounds.
double farthest_allowed(const Comparing& with, const Box& bounds) {
    const auto limit = maximum_of(with.settings);
    return !limit           ? std::numeric_limits<double>::max()
           : limit->percent ? limit->amount / 100 * bounds.diagonal()
                            : limit->amount;
}

/// "the faces of 'paint'".
std::string elements_of(const Comparing& with, const char* elements, Index material) {
    if (material == none) return fmt::format("the {} without a material", elements);
    const auto& materials = material < with.a.materials.size() ? with.a.materials : with.b.materials;
    const std::string name = material < materials.size() ? materials[material].name : "";
    return name.empty() ? fmt::format("the {} of material {}", elements, material)
                        : fmt::format("the {} of '{}'", elements, name);
}

/// Compares the faces of each material: by number if the faces are the same, otherwise by position.
void compare_places(const Comparing& with) {
    const auto a = materials_of_faces(with.a), b = materials_of_faces(with.b);
    const std::set<Index> all = materials_to_compare(a, b);
    if (all.empty()) return;
    const Surface x = surface_of(with.a, filled_surface), y = surface_of(with.b, filled_surface);
    const double most = farthest_allowed(with, x.bounds());
    DeviationSettings settings = with.settings.deviation; // shared by all materials
    settings.samples = settings.samples / all.size() + 1;
    settings.certify = false;
    ProgressSteps steps(std::vector<double>(all.size(), 1));
    for (const Index material : all) {
        const auto d = deviation(of_material(x, a, material), of_material(y, b, material), settings);
        with.add("materials", material == none ? "faces of none" : fmt::format("{} faces", material),
                 finite_or_null(d.forward.maximum), finite_or_null(d.backward.maximum), d.maximum() <= most,
                 fmt::format("distance of {} from the same material in the other file",
                             elements_of(with, "faces", material)));
        with.result.lines.back().of_places = true;
        steps.next();
    }
}

/// The material of every line, in the order of parts and lines.
std::vector<Index> materials_of_lines(const Scene& scene) {
    std::vector<Index> all;
    for (const Part& part : scene.parts)
        for (const auto& segment : lines_of(part).segments) all.push_back(segment.material);
    return all;
}

/// Compares the lines of each material, in the same way.
void compare_places_of_lines(const Comparing& with) {
    const std::set<Index> all = materials_to_compare(materials_of_lines(with.a), materials_of_lines(with.b));
    if (all.empty()) return;
    auto of_a = lines_by_material(with.a), of_b = lines_by_material(with.b);
    Box bounds;
    for (const auto& [material, shape] : of_a) bounds.add(shape.lines.bounds());
    const double most = farthest_allowed(with, bounds);
    for (const Index material : all) {
        const LineShape &x = of_a[material], &y = of_b[material];
        const double forward = x.distance_to(y), backward = y.distance_to(x);
        with.add("materials", material == none ? "lines of none" : fmt::format("{} lines", material),
                 finite_or_null(forward), finite_or_null(backward), std::max(forward, backward) <= most,
                 fmt::format("distance of {} from the same material in the other file",
                             elements_of(with, "lines", material)));
        with.result.lines.back().of_places = true;
    }
}

std::string text_of(const std::vector<double>& lengths) {
    std::string text;
    for (const double x : lengths) text += fmt::format("{}{:.6g}", text.empty() ? "" : " ", x);
    return text;
}

/// True if every length has a counterpart within a millionth.
bool same_lengths(const std::vector<double>& a, const std::vector<double>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](double x, double y) {
        return std::abs(x - y) <= 1e-6 * std::max(std::abs(x), std::abs(y));
    });
}

/// All lengths, ascending, each once.
std::vector<double> in_one(const std::vector<std::vector<double>>& parts) {
    std::vector<double> all;
    for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end(), [](double x, double y) { return y - x <= 1e-6 * y; }),
              all.end());
    return all;
}

/// Compares the thickness that light passes in the world, part by part if both have the same number of parts.
void compare_thickness(const Comparing& with) {
    try {
        const auto a = io::thicknesses(with.a), b = io::thicknesses(with.b);
        if (a.size() != b.size()) {
            const auto x = in_one(a), y = in_one(b);
            if (!x.empty() || !y.empty())
                with.add("materials", "thickness", text_of(x), text_of(y), same_lengths(x, y));
            return;
        }
        for (std::size_t i = 0; i < a.size(); ++i)
            if (!a[i].empty() || !b[i].empty())
                with.add("materials", fmt::format("thickness in part {}", i), text_of(a[i]), text_of(b[i]),
                         same_lengths(a[i], b[i]));
    } catch (const Error& e) {
        with.leave("materials", "thickness", nullptr, nullptr, e.what());
    }
}

} // namespace

void compare_materials(const Comparing& with) {
    const auto &a = with.a.materials, &b = with.b.materials;
    compare_names(with, "materials", a, b);
    io::MaterialContents of_a(with.a), of_b(with.b);
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
        const std::string name = fmt::format("{}", i);
        with.add("materials", name + " base_colour", colour_of(a[i]), colour_of(b[i]));
        with.add("materials", name + " double_sided", a[i].double_sided, b[i].double_sided);
        compare_contents(with, of_a, of_b, i);
    }
    compare_thickness(with);
    if (with.settings.ignored.contains("materials")) return;
    compare_places(with);
    compare_places_of_lines(with);
}

void compare_documents(const Comparing& with) {
    try {
        const Json a = io::document_contents(with.a), b = io::document_contents(with.b);
        for (const char* list : {"animations", "skins", "cameras", "lights"}) {
            const Json x = a.is_null() ? Json::array() : a[list], y = b.is_null() ? Json::array() : b[list];
            with.add("document", list, x.size(), y.size());
            for (std::size_t i = 0; i < std::min(x.size(), y.size()); ++i)
                for (const auto& [path, values] : different_entries(x[i], y[i]))
                    with.add("document", fmt::format("{} {}{}", list, i, path), in_short(values.first),
                             in_short(values.second), false);
        }
    } catch (const Error& e) {
        with.leave("document", "contents", nullptr, nullptr, e.what());
    }
}

} // namespace facetmill::report
