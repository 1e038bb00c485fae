#include "stage/write_file.hpp"

#include "io/convert.hpp"
#include "io/draco/draco.hpp"
#include "io/read_back.hpp"

#include <fmt/format.h>

namespace facetmill {

namespace {

/// The positions of all parts in the world, as a plain Draco file has them.
Mesh in_one(const Scene& scene) {
    Mesh all;
    for (const Part& part : scene.parts)
        for (const Vec3& p : part.mesh.positions) all.positions.push_back(part.transform.point(p));
    return all;
}

} // namespace

void to_convention(Scene& scene, const WriteOptions& o, const io::Codec& codec, Context& context) {
    const io::Convention target{o.unit != Unit::unknown ? o.unit : codec.unit,
                                o.up != UpAxis::unknown ? o.up : codec.up};
    if (o.unit != Unit::unknown && scene.unit == Unit::unknown)
        throw Error(ErrorKind::stage, "E-UNIT",
                    fmt::format("the scene has no unit, so it cannot be written in {}", spelled(o.unit)),
                    "say what was loaded: load: {path: ..., unit: mm}", context.where());
    if (o.up != UpAxis::unknown && scene.up == UpAxis::unknown)
        throw Error(ErrorKind::stage, "E-UP", "the scene has no up axis, so it cannot be turned",
                    "say what was loaded: load: {path: ..., up: z}", context.where());
    const io::Conversion done = io::convert(scene, target);
    if (done.unit_guessed)
        context.warn("W-UNITS",
                     fmt::format("the scene has no unit: '{}' gets its numbers as they are, and {} means {}",
                                 o.path.text, codec.name, spelled(target.unit)),
                     "say what was loaded: load: {path: ..., unit: mm, up: z}");
    if (codec.name == "glb" || codec.name == "gltf")
        for (const auto& name : done.lost_skins)
            context.warn("W-SKIN",
                         fmt::format("part '{}' is converted to {} and {} up in bind pose and loses its skin",
                                     name, spelled(target.unit), spelled(target.up)),
                         "write it in the unit and up axis that it was loaded in");
    if (done.factor != 1) context.result()["factor"] = done.factor;
    if (done.turned) context.result()["up"] = spelled(target.up);
}

void choose_bits(io::WriteSettings& s, const WriteOptions& o, const io::Codec& codec, const Scene& scene,
                 Context& context) {
    if (!s.draco.on) return;
    const char* why = "as given";
    if (!o.draco || !o.draco->position_bits) {
        const int usual = io::DracoSettings{}.position_bits;
        std::optional<int> most = usual;
        const auto look = [&](const Mesh& mesh) {
            if (most) most = io::bits_that_keep_apart(mesh, *most);
        };
        if (codec.name == "drc")
            look(in_one(scene));
        else
            for (const Part& part : scene.parts) look(part.mesh);
        s.draco.position_bits = most.value_or(usual);
        why = most ? "the fewest from 14 that keep vertices apart" : "24 would not keep all vertices apart";
    }
    context.result()["draco"] = {{"position_bits", s.draco.position_bits}, {"why", why}};
}

void stage_files(const io::Written& written, const std::filesystem::path& target, const io::Codec& codec,
                 const Scene& scene, const io::WriteSettings& settings, Context& context) {
    RunState& run = context.run();
    const io::Outputs::File* main = nullptr;
    const std::size_t first = run.record.outputs.size();
    for (const auto& file : written.files) {
        if (main && target == "-") {
            context.warn("W-SKIPPED", fmt::format("'{}' cannot go to standard output beside the mesh",
                                                  file.name.string()));
            continue;
        }
        const bool packed = !main && target.extension() == ".gz";
        const io::Bytes gz = packed ? io::gzipped(file.bytes) : io::Bytes{};
        const auto& staged = run.outputs.add(main ? target.parent_path() / file.name : target,
                                             packed ? gz : file.bytes, context.where());
        if (!main) main = &staged;
        run.record.outputs.push_back({staged.target.string(), staged.bytes, staged.sha256, {}});
    }
    if (!main || !run.read_back) return;
    const io::ReadBack back = io::read_back(run.outputs.staged(*main), codec, scene, settings);
    run.record.outputs[first].read_back = back.json();
    if (!back.losses.empty())
        context.warn("W-ROUNDED",
                     fmt::format("'{}' as read again is less sound than the scene: {}", target.string(),
                                 fmt::join(back.losses, ", ")),
                     "its numbers are coarser: precision: full, more position_bits, or clean before writing");
}

} // namespace facetmill
