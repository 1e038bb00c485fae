#include "stages/write/file.hpp"

#include "base/progress.hpp"
#include "base/words.hpp"
#include "io/convert.hpp"
#include "io/gltf/gltf.hpp"
#include "io/packing.hpp"
#include "io/read_back.hpp"

#include <fmt/format.h>

namespace facetmill::write_stage {

namespace {

/// The positions of all parts in the world, as a plain Draco file has them.
Mesh in_one(const Scene& scene) {
    Mesh all;
    for (const Part& part : scene.parts)
        for (const Vec3& p : part.mesh.positions) all.positions.push_back(part.transform.point(p));
    return all;
}

/// Why rounding put points on others or faces on lines, and the hint.
std::string rounding(const io::ReadBack& back, const io::Codec& codec, const io::WriteSettings& settings) {
    const std::size_t points = back.changes.rounded;
    const std::string what = points > 0 ? fmt::format("put {} on others", counted(points, "point"))
                                        : std::string("moved points onto lines of others");
    if (settings.draco.on && back.grid_step >= back.float_step)
        return fmt::format("Draco's {} bits {}: use more draco.position_bits, or no draco",
                           settings.grid_bits(), what);
    if (settings.quantize.on && back.grid_step >= back.float_step)
        return fmt::format("the grid of {} bits {}: use more bits of quantize.position, or no quantize",
                           settings.grid_bits(), what);
    if (codec.can.full_precision && !settings.double_positions)
        return fmt::format("32-bit floats {}: precision: full keeps all bits", what);
    return fmt::format(
        "the 32-bit floats of {} {}: use clean before write, or write PLY, OBJ or OFF with precision: full",
        codec.name, what);
}

/// Why a file is less sound than the scene, and the hint.
std::string reason(const io::ReadBack& back, const io::Codec& codec, const io::WriteSettings& settings) {
    const io::VertexChanges& changes = back.changes;
    std::vector<std::string> reasons;
    if (changes.added > 0)
        reasons.push_back(fmt::format("{} has one set of attributes per vertex, so seams were cut and {} "
                                      "vertices were added: write OBJ or glTF, or weld after loading (clean)",
                                      codec.name, changes.added));
    if (changes.merged > 0 && !codec.can.shares_vertices)
        reasons.push_back(
            fmt::format("{} has no shared vertices, so corners at the same position are one when "
                        "it is read ({} fewer): write PLY, OBJ or OFF",
                        codec.name, changes.merged));
    else if (changes.merged > 0)
        reasons.push_back(
            fmt::format("vertices of {} at the same position are merged when it is read ({} fewer): {}write "
                        "PLY, OBJ or OFF",
                        codec.name, changes.merged,
                        settings.mesh_manifold || settings.draco.on ? "" : "mesh_manifold: true, or "));
    if (changes.rounded > 0 || reasons.empty()) reasons.push_back(rounding(back, codec, settings));
    return fmt::format("{}", fmt::join(reasons, "; "));
}

} // namespace

void to_convention(Scene& scene, const WriteOptions& o, const io::Codec& codec, Context& context,
                   WriteReport& report) {
    const io::Convention target{o.unit != Unit::unknown ? o.unit : codec.unit,
                                o.up != UpAxis::unknown ? o.up : codec.up};
    if (o.unit != Unit::unknown && scene.unit == Unit::unknown)
        throw Error(ErrorKind::stage, "E-UNIT",
                    fmt::format("the scene has no unit, so it cannot be written in {}", to_string(o.unit)),
                    "give the unit when it is loaded: load: {path: ..., unit: mm}", context.where());
    if (o.up != UpAxis::unknown && scene.up == UpAxis::unknown)
        throw Error(ErrorKind::stage, "E-UP", "the scene has no up axis, so it cannot be rotated",
                    "give the up axis when it is loaded: load: {path: ..., up: z}", context.where());
    const io::Conversion done = io::convert(scene, target);
    if (done.unit_guessed)
        context.warn("W-UNITS",
                     fmt::format("the scene has no unit: '{}' gets its numbers as they are, and {} means {}",
                                 o.path.text, codec.name, to_string(target.unit)),
                     "give both when it is loaded: load: {path: ..., unit: mm, up: z}");
    if (done.factor != 1) report.factor = done.factor;
    if (done.turned) report.up = to_string(target.up);
}

void choose_bits(io::WriteSettings& s, const WriteOptions& o, const io::Codec& codec, const Scene& scene,
                 WriteReport& report) {
    if (s.grid_bits() == 0) return;
    int& bits = s.draco.on ? s.draco.position_bits : s.quantize.position_bits;
    const int limit = s.draco.on ? 24 : 16;
    const bool given = s.draco.on ? o.draco && o.draco->position_bits : o.quantize && o.quantize->position;
    std::string why = "as given";
    if (!given) {
        const int usual = bits;
        std::optional<int> most = usual;
        const auto look = [&](const Mesh& mesh) {
            if (most) most = io::bits_that_keep_distinct(mesh, *most);
        };
        if (!codec.can.transforms)
            look(in_one(scene));
        else
            for (const Part& part : scene.parts) look(part.mesh);
        const bool enough = most && *most <= limit;
        bits = enough ? *most : usual;
        why = enough ? fmt::format("the smallest number from {} on that keeps vertices distinct", usual)
                     : fmt::format("{} would not keep all vertices distinct", limit);
    }
    (s.draco.on ? report.draco : report.quantize) = WriteReport::Bits{bits, why};
}

void stage_files(const io::Written& written, const std::filesystem::path& path, const io::Codec& codec,
                 const Scene& scene, const io::WriteSettings& settings, Context& context) {
    RunState& run = context.run();
    const io::Outputs::File* main = nullptr;
    const std::size_t first = run.record.outputs.size();
    ShareOfSteps steps({1, 3});
    for (const auto& file : written.files) {
        if (main && path == "-") {
            context.warn("W-SKIPPED", fmt::format("'{}' cannot go to standard output beside the mesh",
                                                  file.name.string()));
            continue;
        }
        const io::Packing packing = main ? io::Packing::none : io::packing_named(path);
        const bool packs = packing != io::Packing::none;
        const io::Bytes packed = packs ? io::packed(file.bytes, packing) : io::Bytes{};
        const std::filesystem::path name = main ? path.parent_path() / file.name : path;
        const auto& staged = run.outputs.add(context.places().output(name.string()),
                                             packs ? packed : file.bytes, context.where());
        if (!main) main = &staged;
        run.record.outputs.push_back({name.lexically_normal().string(), staged.bytes, staged.sha256, {}});
    }
    if (!main || !run.read_back) return;
    steps.next();
    const io::ReadBack back =
        io::read_back(run.outputs.staged(*main), codec, scene, settings, written.dropped_faces);
    run.record.outputs[first].read_back = back.json();
    if (!back.losses.empty())
        context.warn("W-ROUNDED",
                     fmt::format("'{}' is less sound when read back than the scene: {}", path.string(),
                                 fmt::join(back.losses, ", ")),
                     reason(back, codec, settings));
    if (back.too_far_for_floats())
        context.warn(
            "W-ROUNDED",
            fmt::format("'{}': points moved by up to {:.2g}, since 32-bit floats are {:.2g} apart so far "
                        "from the origin (the diagonal is {:.4g})",
                        path.string(), back.position_error, back.float_step, back.diagonal),
            codec.can.full_precision && !settings.double_positions
                ? "precision: full keeps all digits"
                : "write glTF with origin: auto, or PLY, OBJ or OFF with precision: full");
}

} // namespace facetmill::write_stage
