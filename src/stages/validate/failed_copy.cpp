#include "stages/validate/failed_copy.hpp"

#include "io/codec.hpp"
#include "io/outputs/outputs.hpp"
#include "options/mark_at.hpp"
#include "stages/validate/check_evidence.hpp"

#include <array>
#include <fmt/format.h>
#include <set>

namespace facetmill::validate_stage {

namespace {

/// Moves the flagged faces to a copy of their primitive that has the material.
void paint(Mesh& mesh, const std::vector<std::uint32_t>& flags, Index material) {
    std::vector<std::uint32_t> primitives(mesh.face_count(), 0);
    for (Index f = 0; f < primitives.size(); ++f) primitives[f] = mesh.primitive_of(f);
    if (mesh.primitives.empty()) mesh.primitives.emplace_back();
    const auto before = static_cast<std::uint32_t>(mesh.primitives.size());
    for (std::uint32_t p = 0; p < before; ++p) {
        mesh.primitives.push_back(mesh.primitives[p]);
        mesh.primitives.back().material = material;
    }
    for (Index f = 0; f < primitives.size(); ++f)
        if (flags[f]) primitives[f] += before;
    mesh.drop(primitive_attribute, Domain::face);
    mesh.drop("failed", Domain::face);
    mesh.attributes.push_back(
        {std::string(primitive_attribute), Domain::face, Role::index, 1, false, std::move(primitives)});
    mesh.attributes.push_back({"failed", Domain::face, Role::index, 1, false, flags});
}

bool is_corner(const Mesh& mesh, const Location& location) {
    for (Index c = mesh.face_begin(location.face); c < mesh.face_end(location.face); ++c)
        if (mesh.point(c) == location.at) return true;
    return false;
}

} // namespace

void flag_faces_against(const Part& part, const Assertion& assertion, std::vector<std::uint32_t>& flags) {
    const Mesh& mesh = part.mesh;
    std::set<std::array<double, 3>> points; // locations at vertices
    for (const Location& p : locations_against(part, assertion)) {
        if (p.face == none || is_corner(mesh, p)) points.insert({p.at.x, p.at.y, p.at.z});
        if (p.face != none) flags[p.face] = 1;
        if (p.with != none) flags[p.with] = 1;
    }
    for (Index f = 0; f < flags.size() && !points.empty(); ++f)
        for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c) {
            const Vec3& p = mesh.point(c);
            if (points.contains({p.x, p.y, p.z})) flags[f] = 1;
        }
}

Scene failed_copy(const Scene& scene, const std::vector<std::vector<std::uint32_t>>& flags) {
    Scene copy = scene;
    Material red;
    red.name = "failed";
    red.base_colour[1] = 0;
    red.base_colour[2] = 0;
    red.double_sided = true;
    copy.materials.push_back(red);
    for (std::size_t p = 0; p < copy.parts.size(); ++p) {
        paint(copy.parts[p].mesh, flags[p], static_cast<Index>(copy.materials.size() - 1));
        copy.parts[p].changed = true;
    }
    return copy;
}

void verify_failed_copy(const std::string& path, const Value& given, Problems& problems) {
    const io::Codec* codec = io::codec_for(path);
    if (codec && codec->write) return;
    problems.add(mark_at(given, "mark"), "E-FORMAT", fmt::format("validate: no format writes '{}'", path),
                 "facetmill formats lists them; .glb shows the colours");
}

void write_failed_copy(const Scene& scene, const std::vector<std::vector<std::uint32_t>>& flags,
                       const std::filesystem::path& path) {
    io::WriteSettings settings;
    settings.title = path.stem().generic_string();
    const io::Written written = io::codec_for(path)->write(failed_copy(scene, flags), settings);
    for (const auto& file : written.files) io::write_now(path.parent_path() / file.name, file.bytes);
}

} // namespace facetmill::validate_stage
