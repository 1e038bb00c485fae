#include "geometry/edit/mask.hpp"

#include "base/error.hpp"
#include "base/text/glob.hpp"
#include "base/text/spelling.hpp"
#include "geometry/cut/cap_paint.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill {

namespace {

[[noreturn]] void refuse(const Part& part, const std::string& message) {
    std::vector<std::string> names;
    for (const auto& a : part.mesh.attributes) names.push_back(a.name);
    throw Error(ErrorKind::stage, "E-MASK", fmt::format("mask: part '{}' has no {}", part.name, message),
                names.empty() ? std::string("it has no attributes")
                              : "it has " + fmt::format("{}", fmt::join(names, ", ")));
}

std::vector<std::uint8_t> chosen_faces(const Part& part, const Scene& scene, const MaskSettings& s) {
    const Mesh& mesh = part.mesh;
    std::vector<std::uint8_t> chosen(mesh.face_count(), 1);
    if (s.group) {
        const Attribute* group = mesh.find(group_attribute, Domain::face);
        if (!group) refuse(part, "face attribute 'group'");
        for (std::size_t f = 0; f < chosen.size(); ++f)
            chosen[f] = group->value(f, 0) == static_cast<double>(*s.group);
    }
    if (s.material.empty()) return chosen;
    for (Index f = 0; f < chosen.size(); ++f) {
        const Index p = mesh.primitive_of(f);
        const Index material = p < mesh.primitives.size() ? mesh.primitives[p].material : none;
        if (material >= scene.materials.size() || !glob_matches(s.material, scene.materials[material].name))
            chosen[f] = 0;
    }
    return chosen;
}

/// Lowers the shares of the face's vertices to at most x.
void lower(const Mesh& mesh, Index f, double x, std::vector<double>& shares) {
    for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c)
        shares[mesh.vertex(c)] = std::min(shares[mesh.vertex(c)], x);
}

void multiply(const Part& part, const std::string& name, std::vector<double>& shares) {
    const Mesh& mesh = part.mesh;
    const Attribute* a = mesh.find(name, Domain::vertex);
    if (!a) a = mesh.find(name, Domain::wedge);
    if (!a) a = mesh.find(name, Domain::face);
    if (!a) refuse(part, fmt::format("attribute '{}'", name));
    std::vector<double> least(shares.size(), 1);
    for (std::size_t i = 0; i < a->size(); ++i) {
        const double value = a->value(i, 0), x = value >= 0 ? std::min(value, 1.0) : 0; // NaN becomes 0
        if (a->domain == Domain::face) {
            lower(mesh, static_cast<Index>(i), x, least);
            continue;
        }
        const auto v =
            a->domain == Domain::vertex ? static_cast<Index>(i) : mesh.vertex_of_wedge(static_cast<Index>(i));
        least[v] = std::min(least[v], x);
    }
    for (std::size_t v = 0; v < shares.size(); ++v) shares[v] *= least[v];
}

} // namespace

std::vector<double> vertex_mask(const Part& part, const Scene& scene, const MaskSettings& s) {
    if (!s.any()) return {};
    std::vector<double> shares(part.mesh.vertex_count(), 1);
    const auto chosen = chosen_faces(part, scene, s);
    for (Index f = 0; f < chosen.size(); ++f)
        if (!chosen[f]) lower(part.mesh, f, 0, shares);
    if (!s.attribute.empty()) multiply(part, s.attribute, shares);
    if (s.invert)
        for (double& x : shares) x = 1 - x;
    return shares;
}

void hold_caps(const Mesh& mesh, std::vector<double>& shares) {
    const Attribute* cut = mesh.find(cut_id_attribute, Domain::face);
    if (!cut || largest_number(mesh, cut_id_attribute) == 0) return;
    if (shares.empty()) shares.assign(mesh.vertex_count(), 1);
    for (Index f = 0; f < mesh.face_count(); ++f)
        if (cut->value(f, 0) > 0) lower(mesh, f, 0, shares);
}

} // namespace facetmill
