#include "stages/optimize/attributes.hpp"

#include "geometry/edit/equal_wedges.hpp"

#include <algorithm>

namespace facetmill::optimize_stage {

namespace {

/// What the faces of a mesh need altogether; none when that is not known.
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
    // What morph targets displace has to be there.
    if (std::any_of(mesh.attributes.begin(), mesh.attributes.end(),
                    [](const Attribute& a) { return a.role == Role::morph_vector; }))
        all.normals = all.tangents = true;
    return all;
}

/// Colours multiply those of the material: white changes nothing.
bool is_white(const Attribute& a) {
    for (std::size_t i = 0; i < a.size(); ++i)
        for (int c = 0; c < a.components; ++c)
            if (a.value(i, c) != 1) return false;
    return true;
}

bool is_unused(const Attribute& a, const io::MaterialNeeds& needs) {
    constexpr std::string_view uv = "TEXCOORD_";
    if (a.domain == Domain::face) return false;
    if (a.name == "NORMAL") return !needs.normals;
    if (a.name == "TANGENT") return !needs.tangents;
    if (a.name == "COLOR_0") return is_white(a);
    if (a.name.rfind(uv, 0) != 0 || a.name.size() != uv.size() + 1)
        return false; // beyond nine: whoever knows
    return !needs.uvs.contains(a.name.back() - '0');
}

} // namespace

std::vector<std::string> drop_unused_attributes(
    Mesh& mesh, const std::function<std::optional<io::MaterialNeeds>(Index material)>& needs_of_material) {
    std::vector<std::string> dropped;
    const auto needs = needs_of(mesh, needs_of_material);
    if (!needs) return dropped;
    for (const Attribute& a : mesh.attributes)
        if (is_unused(a, *needs)) dropped.push_back(a.name);
    if (dropped.empty()) return dropped;
    const auto gone = [&](const std::string& name) {
        return std::find(dropped.begin(), dropped.end(), name) != dropped.end();
    };
    std::erase_if(mesh.attributes,
                  [&](const Attribute& a) { return a.domain != Domain::face && gone(a.name); });
    for (Primitive& p : mesh.primitives)
        if (!std::all_of(p.attributes.begin(), p.attributes.end(), gone)) // an empty list would mean all
            std::erase_if(p.attributes, gone);
    merge_equal_wedges(mesh);
    return dropped;
}

} // namespace facetmill::optimize_stage
