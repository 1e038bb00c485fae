// Plain Draco files: one mesh, without materials or nodes.

#include "geometry/triangulate/crossing_faces.hpp"
#include "io/attributes.hpp"
#include "io/flatten.hpp"
#include "io/gltf/draco/draco.hpp"
#include "io/srgb_colours.hpp"
#include "io/write_options.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <set>

namespace facetmill::io {

namespace {

/// Attribute names are glTF's if Draco knows the kind, otherwise from the metadata.
std::string name_of(const DracoColumn& column, std::set<std::string>& taken) {
    std::string stem = column.name;
    if (column.kind == DracoKind::normal && !taken.count("NORMAL"))
        stem = "NORMAL";
    else if (column.kind == DracoKind::uv && column.components == 2)
        stem = "TEXCOORD_";
    else if (column.kind == DracoKind::colour && (column.components == 3 || column.components == 4))
        stem = "COLOR_";
    else if (stem.empty())
        stem = "generic_";
    std::string name = stem;
    if (stem.back() == '_' || taken.count(stem))
        for (int n = 0;; ++n)
            if (name = fmt::format("{}{}{}", stem, stem.back() == '_' ? "" : "_", n); !taken.count(name))
                break;
    taken.insert(name);
    return name;
}

Role role_of(const std::string& name) {
    if (name == "NORMAL") return Role::normal;
    if (name.rfind("TEXCOORD_", 0) == 0) return Role::uv;
    return name.rfind("COLOR_", 0) == 0 ? Role::colour : Role::generic;
}

Mesh to_mesh(DracoMesh decoded) {
    Mesh mesh;
    mesh.corners = std::move(decoded.triangles);
    std::set<std::string> taken;
    for (auto& column : decoded.columns) {
        if (column.kind == DracoKind::position && mesh.positions.empty() && column.components == 3) {
            const Attribute a{"", Domain::wedge, Role::generic, 3, column.normalised, std::move(column.data)};
            mesh.positions = to_vectors(a);
            continue;
        }
        const std::string name = name_of(column, taken);
        mesh.attributes.push_back({name, Domain::wedge, role_of(name), column.components, column.normalised,
                                   std::move(column.data)});
    }
    if (mesh.positions.size() != decoded.points)
        throw Error(ErrorKind::malformed, "E-DRACO", "the Draco data has no positions of three numbers");
    if (!mesh.corners.empty()) weld_exact(mesh); // points are attribute tuples, as in glTF
    return mesh;
}

Scene read(const Input& input, const ReadSettings& settings, ReadLog& log) {
    Scene scene;
    scene.unit = settings.unit.value_or(Unit::unknown);
    scene.up = settings.up.value_or(UpAxis::unknown);
    Part part;
    part.name = std::filesystem::path(input.name()).stem().generic_string();
    try {
        DracoMesh decoded = decode_draco(input.bytes(), DracoContents::mesh_or_points, settings.decoded);
        if (decoded.points > settings.max_vertices)
            throw Error(ErrorKind::limit, "E-LIMIT",
                        fmt::format("more than {} vertices", settings.max_vertices));
        if (decoded.metadata > 0)
            log.warnings.push_back(
                {Severity::warning, "W-SKIPPED",
                 fmt::format("metadata of Draco are skipped ({}), for example names of objects",
                             decoded.metadata),
                 file_mark(input.name()), ""});
        part.mesh = to_mesh(std::move(decoded));
    } catch (Error& e) {
        throw e.at(file_mark(input.name()));
    }
    scene.parts.push_back(std::move(part));
    return scene;
}

/// Joins all parts in world space into a triangle mesh.
Mesh joined(const Scene& scene) {
    Mesh all;
    for (std::size_t i = 0; i < scene.parts.size(); ++i) {
        Mesh mesh = scene.parts[i].mesh;
        if (!scene.parts[i].transform.identity()) apply(mesh, scene.parts[i].transform);
        if (i == 0)
            all = std::move(mesh);
        else
            append(all, mesh);
    }
    if (!all.all_triangles()) all = triangles_of(all);
    if (all.face_count() > 0) drop_unused(all);
    return all;
}

DracoKind kind_of(const Attribute& a) {
    if (a.role == Role::normal) return DracoKind::normal;
    if (a.role == Role::uv) return DracoKind::uv;
    return a.role == Role::colour ? DracoKind::colour : DracoKind::generic;
}

DracoColumn to_column(const Mesh& mesh, const Attribute& a) {
    DracoColumn column{a.name, kind_of(a), 0, a.components, a.normalised, a.data};
    if (const auto* doubles = std::get_if<std::vector<double>>(&a.data)) // Draco quantises float32 only
        column.data = std::vector<float>(doubles->begin(), doubles->end());
    if (a.domain == Domain::wedge || !mesh.has_seams()) return column;
    const std::size_t width = static_cast<std::size_t>(a.components);
    std::visit(
        [&](auto& numbers) {
            std::decay_t<decltype(numbers)> spread(mesh.wedge_count() * width);
            for (std::size_t w = 0; w < mesh.wedge_count(); ++w)
                std::copy_n(numbers.begin() + static_cast<std::ptrdiff_t>(mesh.wedge_vertex[w] * width),
                            width, spread.begin() + static_cast<std::ptrdiff_t>(w * width));
            numbers = std::move(spread);
        },
        column.data);
    return column;
}

/// Drops degenerate faces. If they must be kept or are the only faces, indices are stored instead.
void leave_degenerate(DracoInput& input, const DracoSettings& settings, Written& written) {
    const std::vector<bool> degenerate = degenerate_faces(input.triangles, input.point_vertex);
    const auto count = static_cast<std::size_t>(std::count(degenerate.begin(), degenerate.end(), true));
    input.keep_order = count > 0 && (settings.keep_degenerate || count == degenerate.size());
    if (count == 0 || input.keep_order) return;
    std::vector<Index> kept;
    for (std::size_t c = 0; c < input.triangles.size(); ++c)
        if (!degenerate[c / 3]) kept.push_back(input.triangles[c]);
    input.triangles = std::move(kept);
    written.dropped_faces = count;
    written.warnings.push_back({Severity::warning,
                                "W-FACES",
                                fmt::format("{} degenerate face{} dropped, since Draco cannot compress {}",
                                            count, count == 1 ? " is" : "s are", count == 1 ? "it" : "them"),
                                {},
                                "draco: {degenerate_faces: keep} keeps them, at the price of a larger file"});
}

Written write(const Scene& scene, const WriteSettings& settings) {
    Written written;
    Mesh mesh = joined(scene);
    move_colours_to_wedges(mesh);
    warn_of_nan(zero_nan(mesh), "Draco", written.warnings);
    DracoInput input;
    input.triangles = mesh.corners;
    input.point_vertex = mesh.wedge_vertex;
    if (!mesh.has_seams())
        for (Index v = 0; v < mesh.vertex_count(); ++v) input.point_vertex.push_back(v);
    for (const auto& p : mesh.positions)
        for (std::size_t c = 0; c < 3; ++c) {
            if (!(std::fabs(p[c]) <= 3.4028234663852886e38))
                throw Error(ErrorKind::stage, "E-RANGE",
                            fmt::format("the position {} does not fit float32", p[c]));
            input.vertices.push_back(static_cast<float>(p[c]));
        }
    set_draco_grid(mesh, input);
    for (const auto& a : mesh.attributes) {
        if (a.domain == Domain::face)
            written.changes.push_back(
                {a.name, a.domain, AttributeChange::Kind::dropped, "Draco files have no face attributes"});
        else if (a.components > 127)
            written.changes.push_back(
                {a.name, a.domain, AttributeChange::Kind::dropped, "too many components"});
        else
            input.columns.push_back(to_column(mesh, a));
    }
    leave_documents(written, scene, "Draco");
    warn_of_dropped(written, scene, "Draco");
    drop_materials(written, scene, "Draco");
    const std::string name = (settings.title.empty() ? "mesh" : settings.title) + ".drc";
    if (mesh.face_count() == 0) {
        written.files.push_back({name, encode_draco_points(input, settings.draco)});
        return written;
    }
    leave_degenerate(input, settings.draco, written);
    DracoOutput output = encode_draco(input, settings.draco);
    if (settings.draco.keep_decoded) {
        DracoDecodings decoded;
        decoded.add(output.bytes, std::move(output.decoded));
        written.decoded = std::make_shared<const DracoDecodings>(std::move(decoded));
    }
    written.files.push_back({name, std::move(output.bytes)});
    return written;
}

const RegisterCodec drc({
    .name = "drc",
    .about = "Draco's compressed meshes and point clouds",
    .extensions = {"drc"},
    .can =
        {.points = true, .options = {draco_option()}, .always_draco = true, .attributes = "all at vertices"},
    .sniff = [](Span bytes) { return is_draco(bytes) ? 2 : 0; },
    .read = with_linear_colours(read),
    .write = with_srgb_colours(write),
});

} // namespace

} // namespace facetmill::io
