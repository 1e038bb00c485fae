#include "mesh/invariants.hpp"

#include "parallel/parallel.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill {

namespace {

/// Violations of a kind, reported in a sentence with their number and the first.
struct Finding {
    const char* what;
    std::size_t count = 0, first = 0;
    void add(std::size_t i) {
        if (count++ == 0) first = i;
    }
    void tell(std::vector<std::string>& out) const {
        if (count > 0) out.push_back(fmt::format("{}: {}, first {}", what, count, first));
    }
};

void check_range(const char* what, const std::vector<Index>& indices, std::size_t limit,
                 std::vector<std::string>& out) {
    Finding finding{what};
    for (std::size_t i = 0; i < indices.size(); ++i)
        if (indices[i] >= limit) finding.add(i);
    finding.tell(out);
}

void check_offsets(const Mesh& mesh, std::vector<std::string>& out) {
    const auto& offsets = mesh.face_offsets;
    if (offsets.empty()) {
        if (mesh.corners.size() % 3 != 0)
            out.push_back(
                fmt::format("{} corners of triangles are not a multiple of three", mesh.corners.size()));
        return;
    }
    if (offsets.front() != 0) out.emplace_back("face_offsets do not begin at 0");
    if (offsets.back() != mesh.corners.size())
        out.emplace_back("face_offsets do not end at the number of corners");
    Finding descending{"face_offsets descend"}, small{"faces of fewer than three corners"};
    bool triangles = true;
    for (std::size_t f = 0; f + 1 < offsets.size(); ++f) {
        if (offsets[f + 1] < offsets[f])
            descending.add(f);
        else if (offsets[f + 1] - offsets[f] < 3)
            small.add(f);
        triangles = triangles && offsets[f + 1] == offsets[f] + 3;
    }
    descending.tell(out);
    small.tell(out);
    if (triangles) out.emplace_back("face_offsets are stored though all faces are triangles");
}

void check_attribute(const Mesh& mesh, const Attribute& a, std::vector<std::string>& out) {
    const auto stored = std::visit([](const auto& v) { return v.size(); }, a.data);
    const auto wanted = mesh.count(a.domain) * static_cast<std::size_t>(std::max(a.components, 0));
    if (a.components < 1 || stored != wanted)
        out.push_back(fmt::format("{} attribute {} holds {} numbers, not {}", to_string(a.domain), a.name,
                                  stored, wanted));
    const auto same = [&](const Attribute& b) {
        return &b != &a && b.name == a.name && b.domain == a.domain;
    };
    if (std::any_of(mesh.attributes.begin(), mesh.attributes.end(), same))
        out.push_back(fmt::format("{} attribute {} occurs twice", to_string(a.domain), a.name));
}

void check_primitives(const Mesh& mesh, std::vector<std::string>& out) {
    const Attribute* a = mesh.find(primitive_attribute, Domain::face);
    if (!a) return;
    const auto* indices = std::get_if<std::vector<std::uint32_t>>(&a->data);
    if (!indices || a->components != 1 || a->role != Role::index)
        out.emplace_back("face attribute primitive is not one uint32 index");
    else
        check_range("primitives out of range", *indices, std::max<std::size_t>(1, mesh.primitives.size()),
                    out);
}

void check_lines(const Mesh& mesh, std::vector<std::string>& out) {
    if (mesh.lines.size() % 2 != 0)
        out.push_back(fmt::format("{} ends of lines are not a multiple of two", mesh.lines.size()));
    if (!mesh.lines.empty() && !mesh.corners.empty()) out.emplace_back("faces and lines in one mesh");
    check_range("lines that refer to no wedge", mesh.lines, mesh.wedge_count(), out);
    if (!mesh.line_primitive.empty() && mesh.line_primitive.size() != mesh.line_count())
        out.push_back(
            fmt::format("{} primitives of lines, not {}", mesh.line_primitive.size(), mesh.line_count()));
    check_range("primitives of lines out of range", mesh.line_primitive,
                std::max<std::size_t>(1, mesh.primitives.size()), out);
}

} // namespace

std::vector<std::string> broken_invariants(const Mesh& mesh) {
    std::vector<std::string> out;
    check_offsets(mesh, out);
    check_range("corners that refer to no wedge", mesh.corners, mesh.wedge_count(), out);
    check_range("wedges that refer to no vertex", mesh.wedge_vertex, mesh.vertex_count(), out);
    Finding infinite{"positions that are not finite"};
    for (std::size_t v = 0; v < mesh.positions.size(); ++v)
        if (!is_finite(mesh.positions[v])) infinite.add(v);
    infinite.tell(out);
    for (const auto& a : mesh.attributes) check_attribute(mesh, a, out);
    check_primitives(mesh, out);
    check_lines(mesh, out);
    return out;
}

std::vector<std::string> broken_invariants(const Scene& scene) {
    std::vector<std::string> out;
    for (std::size_t p = 0; p < scene.parts.size(); ++p) {
        const Part& part = scene.parts[p];
        for (const auto& sentence : broken_invariants(part.mesh))
            out.push_back(fmt::format("part {} ({}): {}", p, part.name, sentence));
        if (part.document >= static_cast<int>(scene.documents.size()))
            out.push_back(fmt::format("part {} ({}): refers to no document", p, part.name));
        for (const auto& primitive : part.mesh.primitives)
            if (primitive.material != none && primitive.material >= scene.materials.size())
                out.push_back(fmt::format("part {} ({}): a primitive refers to no material", p, part.name));
    }
    return out;
}

std::size_t first_not_finite(const std::vector<Vec3>& points) {
    return parallel_reduce(
        points.size(), points.size(),
        [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i)
                if (!is_finite(points[i])) return i;
            return points.size();
        },
        [](std::size_t a, std::size_t b) { return std::min(a, b); });
}

std::optional<std::string> not_finite(const Scene& scene) {
    for (const Part& part : scene.parts) {
        const std::size_t first = first_not_finite(part.mesh.positions);
        if (first < part.mesh.positions.size())
            return fmt::format("vertex {} of part '{}'", first, part.name);
    }
    const Box box = scene.bounds();
    if (!box.empty() && !(is_finite(box.min) && is_finite(box.max))) return "the box in world space";
    return {};
}

} // namespace facetmill
