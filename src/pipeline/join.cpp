#include "pipeline/join.hpp"

#include "pipeline/expressions.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace facetmill::pipeline {

namespace {

/// The indices of the elements of `from` in `to`; missing elements are appended to `to`.
template <class T, class Same>
std::vector<std::size_t> united(std::vector<T>& to, const std::vector<T>& from, Same&& same) {
    std::vector<std::size_t> places;
    for (const auto& element : from) {
        const auto found =
            std::find_if(to.begin(), to.end(), [&](const T& other) { return same(element, other); });
        places.push_back(static_cast<std::size_t>(found - to.begin()));
        if (found == to.end()) to.push_back(element);
    }
    return places;
}

bool same_material(const Material& a, const Material& b) {
    return a.name == b.name && a.document == b.document && a.index == b.index &&
           a.double_sided == b.double_sided &&
           std::equal(std::begin(a.base_colour), std::end(a.base_colour), std::begin(b.base_colour));
}

void add(Scene& all, NamedScene&& one, std::set<std::string>& names, std::set<std::pair<int, int>>& nodes) {
    Scene& scene = one.scene;
    if (all.unit == Unit::unknown) all.unit = scene.unit;
    if (all.up == UpAxis::unknown) all.up = scene.up;
    const auto documents =
        united(all.documents, scene.documents, [](const auto& a, const auto& b) { return a == b; });
    const auto document = [&](int old) {
        return old < 0 ? -1 : static_cast<int>(documents[static_cast<std::size_t>(old)]);
    };
    for (auto& material : scene.materials) material.document = document(material.document);
    const auto materials = united(all.materials, scene.materials, same_material);
    for (auto& part : scene.parts) {
        for (auto& primitive : part.mesh.primitives)
            if (primitive.material < materials.size())
                primitive.material = static_cast<Index>(materials[primitive.material]);
        part.document = document(part.document);
        if (part.document >= 0 && !nodes.emplace(part.document, part.node).second)
            part.document = part.node = part.source_mesh = -1;
        const std::string base = part.name;
        for (int number = 1; !names.insert(part.name).second; ++number)
            part.name = fmt::format("{}.{}{}", base, safe_name(one.name),
                                    number == 1 ? "" : fmt::format("-{}", number));
        all.parts.push_back(std::move(part));
    }
}

} // namespace

Scene joined(std::vector<NamedScene> scenes) {
    Scene all;
    std::set<std::string> names;
    std::set<std::pair<int, int>> nodes;
    for (auto& one : scenes) add(all, std::move(one), names, nodes);
    return all;
}

Scene with_parts_replaced(Scene scene, std::vector<std::vector<NamedScene>> results) {
    std::vector<NamedScene> all;
    for (std::size_t p = 0; p < results.size(); ++p) {
        if (results[p].empty()) {
            Scene alone{{}, scene.materials, scene.unit, scene.up, scene.documents};
            alone.parts.push_back(std::move(scene.parts[p]));
            all.push_back({"", std::move(alone)});
        }
        for (auto& result : results[p]) all.push_back(std::move(result));
    }
    return all.empty() ? std::move(scene) : joined(std::move(all));
}

} // namespace facetmill::pipeline
