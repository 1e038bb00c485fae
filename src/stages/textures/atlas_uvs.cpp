#include "stages/textures/atlas_uvs.hpp"

#include "mesh/face.hpp"
#include "mesh/separate_wedges.hpp"
#include "mesh/topology.hpp"

#include <cmath>
#include <fmt/format.h>

namespace facetmill::textures_stage {

namespace {

constexpr double farthest = 1e5; ///< in textures; float32 coordinates beyond have lost their texel

std::string set_name(const io::AtlasTexture& texture) {
    return fmt::format("TEXCOORD_{}", texture.sampling.set);
}

void keep_apart(AtlasCandidate& candidate, const std::string& why) {
    if (candidate.look.apart.empty()) candidate.look.apart = why;
}

bool has_morphed_uvs(const Mesh& mesh) {
    return std::any_of(mesh.attributes.begin(), mesh.attributes.end(), [](const Attribute& a) {
        return a.role == Role::morph_vector && a.name.find("_TEXCOORD_") != std::string::npos;
    });
}

/// Keeps candidates apart whose primitives an atlas would spoil.
void check_primitives(const Part& part, AtlasCandidates& candidates) {
    const bool morphs = has_morphed_uvs(part.mesh);
    for (const Primitive& p : part.mesh.primitives) {
        const auto found = candidates.find(p.material);
        if (found == candidates.end()) continue;
        AtlasCandidate& c = found->second;
        if (p.json.find("\"extensions\"") != std::string::npos)
            keep_apart(c, fmt::format("part '{}' has extensions that refer to it", part.name));
        const io::AtlasTexture* texture = c.look.any();
        if (!texture) continue;
        if (morphs) keep_apart(c, fmt::format("part '{}' morphs its texture coordinates", part.name));
        const std::string set = set_name(*texture);
        const Attribute* uvs = part.mesh.find(set, Domain::wedge);
        if (!uvs || uvs->components != 2 || !p.has(set))
            keep_apart(c, fmt::format("part '{}' has no {}", part.name, set));
    }
}

/// [primitives] The candidate that is not apart, or none.
std::vector<Index> candidates_of(const Mesh& mesh, const AtlasCandidates& candidates) {
    std::vector<Index> all(std::max<std::size_t>(1, mesh.primitives.size()), none);
    for (std::size_t p = 0; p < mesh.primitives.size(); ++p) {
        const auto found = candidates.find(mesh.primitives[p].material);
        if (found != candidates.end() && found->second.look.apart.empty()) all[p] = found->first;
    }
    return all;
}

/// The candidate of each face's wedges.
std::vector<Index> separate(Mesh& mesh, const std::vector<Index>& of_primitive) {
    std::vector<Index> of_corner(mesh.corner_count());
    for (Index f = 0; f < mesh.face_count(); ++f) {
        const Index p = mesh.primitive_of(f);
        for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c)
            of_corner[c] = p < of_primitive.size() ? of_primitive[p] : none;
    }
    return separate_wedges(mesh, of_corner);
}

/// How far whole textures may move coordinates without a visible change: 1, 2 if mirrored, 0 if clamped.
double period(const io::AtlasMaterial& look, TextureWrap Texture::*wrap) {
    double period = 1;
    for (const auto* one : look.textures()) {
        if (!*one) continue;
        const TextureWrap mode = (*one)->sampling.*wrap;
        if (mode == TextureWrap::clamp) return 0;
        if (mode == TextureWrap::mirror) period = 2;
    }
    return period;
}

/// The whole number of periods that moves the middle of a range nearest to the first texture.
double shift(double low, double high, double period) {
    return period == 0 ? 0 : period * std::floor((low + high) / 2 / period);
}

void transform_uvs(const Mesh& mesh, AtlasCandidates& candidates, MappedPart& mapped) {
    mapped.uv.resize(mapped.material.size());
    for (auto& [material, candidate] : candidates) {
        const io::AtlasTexture* texture = candidate.look.any();
        const Attribute* uvs = texture ? mesh.find(set_name(*texture), Domain::wedge) : nullptr;
        if (!uvs || !candidate.look.apart.empty()) continue;
        const auto& t = texture->sampling.transform;
        for (std::size_t w = 0; w < mapped.material.size(); ++w) {
            if (mapped.material[w] != material) continue;
            const double u = uvs->value(w, 0), v = uvs->value(w, 1);
            mapped.uv[w] = {t[0] * u + t[1] * v + t[2], t[3] * u + t[4] * v + t[5]};
            if (!(std::abs(mapped.uv[w][0]) < farthest && std::abs(mapped.uv[w][1]) < farthest))
                keep_apart(candidate, "it has texture coordinates that are not finite or too large");
        }
    }
}

void move_islands(const Mesh& mesh, const AtlasCandidates& candidates, MappedPart& mapped) {
    DisjointSets islands(mapped.material.size());
    for (Index f = 0; f < mesh.face_count(); ++f)
        for (const Index w : mesh.face_wedges(f)) islands.join(mesh.face_wedges(f)[0], w);
    std::vector<UvExtent> extents(mapped.material.size());
    for (Index w = 0; w < mapped.material.size(); ++w) {
        if (mapped.material[w] == none) continue;
        UvExtent one;
        one.low = one.high = mapped.uv[w];
        extents[islands.find(w)].add(one);
    }
    std::map<Index, Uv> periods;
    for (const auto& [material, candidate] : candidates)
        periods[material] = {period(candidate.look, &Texture::wrap_u),
                             period(candidate.look, &Texture::wrap_v)};
    for (Index w = 0; w < mapped.material.size(); ++w) {
        if (mapped.material[w] == none) continue;
        const UvExtent& island = extents[islands.find(w)];
        const Uv& p = periods.at(mapped.material[w]);
        for (std::size_t a = 0; a < 2; ++a) mapped.uv[w][a] -= shift(island.low[a], island.high[a], p[a]);
    }
}

void measure(const Part& part, const MappedPart& mapped, AtlasCandidates& candidates) {
    const Mesh& mesh = part.mesh;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        const std::span<const Index> wedges = mesh.face_wedges(f);
        if (wedges.empty() || mapped.material[wedges[0]] == none) continue;
        UvExtent face;
        Vec3 area;
        const Uv& o = mapped.uv[wedges[0]];
        const auto point = [&](std::size_t i) {
            return part.transform.point(mesh.positions[mesh.vertex_of_wedge(wedges[i])]);
        };
        for (std::size_t i = 0; i < wedges.size(); ++i) {
            const Uv& p = mapped.uv[wedges[i]];
            UvExtent one;
            one.low = one.high = p;
            face.add(one);
            if (i == 0) continue;
            const Uv& q = mapped.uv[wedges[i - 1]];
            face.uv_area += ((q[0] - o[0]) * (p[1] - o[1]) - (p[0] - o[0]) * (q[1] - o[1])) / 2;
            area += cross(point(i - 1) - point(0), point(i) - point(0)) / 2;
        }
        face.uv_area = std::abs(face.uv_area);
        face.world_area = length(area);
        candidates.at(mapped.material[wedges[0]]).extent.add(face);
    }
}

} // namespace

void UvExtent::add(const UvExtent& other) {
    for (std::size_t a = 0; a < 2; ++a) {
        low[a] = std::min(low[a], other.low[a]);
        high[a] = std::max(high[a], other.high[a]);
    }
    uv_area += other.uv_area;
    world_area += other.world_area;
}

MappedPart map_part(Part& part, std::size_t number, AtlasCandidates& candidates) {
    MappedPart mapped{number, {}, {}};
    check_primitives(part, candidates);
    const std::vector<Index> of_primitive = candidates_of(part.mesh, candidates);
    if (std::all_of(of_primitive.begin(), of_primitive.end(), [](Index m) { return m == none; }))
        return mapped;
    mapped.material = separate(part.mesh, of_primitive);
    transform_uvs(part.mesh, candidates, mapped);
    move_islands(part.mesh, candidates, mapped);
    measure(part, mapped, candidates);
    return mapped;
}

} // namespace facetmill::textures_stage
