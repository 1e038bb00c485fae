#include "stages/optimize/attributes.hpp"

#include <algorithm>
#include <cstring>
#include <numeric>

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

/// Compares the attributes of wedges.
class WedgeOrder {
  public:
    explicit WedgeOrder(const Mesh& mesh) : vertex_(mesh.wedge_vertex) {
        for (const Attribute& a : mesh.attributes)
            if (a.domain == Domain::wedge)
                std::visit(
                    [&](const auto& numbers) {
                        columns_.push_back({reinterpret_cast<const char*>(numbers.data()),
                                            sizeof(numbers[0]) * static_cast<std::size_t>(a.components)});
                    },
                    a.data);
    }
    int compare(Index a, Index b) const {
        if (vertex_[a] != vertex_[b]) return vertex_[a] < vertex_[b] ? -1 : 1;
        for (const auto& [bytes, stride] : columns_)
            if (const int order = std::memcmp(bytes + a * stride, bytes + b * stride, stride)) return order;
        return 0;
    }

  private:
    const std::vector<Index>& vertex_;
    std::vector<std::pair<const char*, std::size_t>> columns_;
};

} // namespace

std::size_t merge_equal_wedges(Mesh& mesh) {
    if (!mesh.has_seams()) return 0;
    const std::size_t before = mesh.wedge_count();
    const WedgeOrder order(mesh);
    std::vector<Index> sorted(mesh.wedge_vertex.size());
    std::iota(sorted.begin(), sorted.end(), Index{0});
    std::sort(sorted.begin(), sorted.end(), [&](Index a, Index b) {
        const int c = order.compare(a, b);
        return c != 0 ? c < 0 : a < b;
    });
    std::vector<Index> instead(sorted.size());
    for (std::size_t i = 0; i < sorted.size(); ++i)
        instead[sorted[i]] =
            i > 0 && order.compare(sorted[i - 1], sorted[i]) == 0 ? instead[sorted[i - 1]] : sorted[i];
    bool equal = false;
    for (Index w = 0; w < instead.size(); ++w) equal = equal || instead[w] != w;
    if (!equal) return 0;
    for (Index& w : mesh.corners) w = instead[w];
    drop_unused(mesh);
    return before - mesh.wedge_count();
}

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
