#include "stages/optimize/attributes.hpp"

#include "geometry/edit/equal_wedges.hpp"

#include <algorithm>
#include <charconv>
#include <map>
#include <string_view>

namespace facetmill::optimize_stage {

namespace {

/// The combined needs of the mesh's materials; none if unknown.
std::optional<io::MaterialNeeds>
needs_of(const Mesh& mesh,
         const std::function<std::optional<io::MaterialNeeds>(Index material)>& needs_of_material) {
    io::MaterialNeeds all;
    all.normals = false;
    if (mesh.primitives.empty()) return io::MaterialNeeds{};
    for (const Primitive& p : mesh.primitives) {
        if (!p.json.empty()) return {};
        std::optional<io::MaterialNeeds> needs = io::MaterialNeeds{};
        if (p.material != none) needs = needs_of_material(p.material);
        if (!needs) return {};
        all.uvs.insert(needs->uvs.begin(), needs->uvs.end());
        all.normals |= needs->normals;
        all.tangents |= needs->tangents;
    }
    return all;
}

/// Splits "TARGET_3_NORMAL" into the target "TARGET_3_" and the displaced attribute NORMAL.
std::pair<std::string_view, std::string_view> displaced(std::string_view name) {
    const auto end = name.find_first_not_of("0123456789", std::string_view("TARGET_").size());
    if (end == std::string_view::npos || name[end] != '_') return {{}, name};
    return {name.substr(0, end + 1), name.substr(end + 1)};
}

/// Whether every morph target keeps at least one attribute without this semantic. Morph weights are per
/// target, so no target may become empty.
bool targets_can_lose(const Mesh& mesh, std::string_view semantic) {
    std::map<std::string_view, std::size_t> left;
    for (const Attribute& a : mesh.attributes) {
        if (a.role != Role::morph_vector) continue;
        const auto [target, of] = displaced(a.name);
        left[target] += of != semantic;
    }
    return std::all_of(left.begin(), left.end(), [](const auto& target) { return target.second > 0; });
}

/// Colours multiply the material's colour, so white changes nothing.
bool is_white(const Attribute& a) {
    for (std::size_t i = 0; i < a.size(); ++i)
        for (int c = 0; c < a.components; ++c)
            if (a.value(i, c) != 1) return false;
    return true;
}

bool is_unused(const Attribute& a, const io::MaterialNeeds& needs) {
    constexpr std::string_view uv = "TEXCOORD_";
    if (a.domain == Domain::face) return false;
    const std::string_view name = a.role == Role::morph_vector ? displaced(a.name).second : a.name;
    if (name == "NORMAL") return !needs.normals;
    if (name == "TANGENT") return !needs.tangents;
    if (a.role == Role::morph_vector) return false;
    if (a.name == "COLOR_0") return is_white(a);
    if (a.name.rfind(uv, 0) != 0 || a.name.size() != uv.size() + 1) return false; // ten or more sets
    return !needs.uvs.contains(a.name.back() - '0');
}

/// The set of TEXCOORD_n, COLOR_n, JOINTS_n or WEIGHTS_n, with its prefix; none for other names.
std::optional<std::pair<std::string_view, int>> set_of(std::string_view name) {
    for (const std::string_view prefix : {"TEXCOORD_", "COLOR_", "JOINTS_", "WEIGHTS_"}) {
        if (!name.starts_with(prefix)) continue;
        int number = 0;
        const auto [at, error] =
            std::from_chars(name.data() + prefix.size(), name.data() + name.size(), number);
        if (error == std::errc() && at == name.data() + name.size()) return std::pair(prefix, number);
    }
    return {};
}

/// glTF numbers sets without gaps: a set stays while a later one stays.
bool would_leave_gap(const Mesh& mesh, std::string_view name, const std::vector<std::string>& unused) {
    const auto own = set_of(name);
    if (!own) return false;
    return std::any_of(mesh.attributes.begin(), mesh.attributes.end(), [&](const Attribute& a) {
        const auto other = set_of(a.name);
        return other && other->first == own->first && other->second > own->second &&
               std::find(unused.begin(), unused.end(), a.name) == unused.end();
    });
}

} // namespace

std::vector<std::string> drop_unused_attributes(
    Mesh& mesh, const std::function<std::optional<io::MaterialNeeds>(Index material)>& needs_of_material,
    UnusedKinds kinds) {
    std::vector<std::string> dropped;
    auto needs = needs_of(mesh, needs_of_material);
    if (!needs) return dropped;
    needs->normals |= !targets_can_lose(mesh, "NORMAL");
    needs->tangents |= !targets_can_lose(mesh, "TANGENT");
    for (const Attribute& a : mesh.attributes)
        if (a.role == Role::generic && a.domain != Domain::face ? kinds.own
                                                                : kinds.standard && is_unused(a, *needs))
            dropped.push_back(a.name);
    const std::vector<std::string> unused = dropped;
    std::erase_if(dropped, [&](const std::string& name) { return would_leave_gap(mesh, name, unused); });
    if (dropped.empty()) return dropped;
    const auto gone = [&](const std::string& name) {
        return std::find(dropped.begin(), dropped.end(), name) != dropped.end();
    };
    std::erase_if(mesh.attributes,
                  [&](const Attribute& a) { return a.domain != Domain::face && gone(a.name); });
    for (Primitive& p : mesh.primitives)
        if (!std::all_of(p.attributes.begin(), p.attributes.end(),
                         gone)) // an empty list would mean all attributes
            std::erase_if(p.attributes, gone);
    merge_and_drop_wedges(mesh);
    return dropped;
}

} // namespace facetmill::optimize_stage
