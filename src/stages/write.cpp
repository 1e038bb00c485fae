#include "base/spelling.hpp"
#include "io/convert.hpp"
#include "io/draco/draco.hpp"
#include "io/read_back.hpp"
#include "stage/convention_option.hpp"
#include "stage/stage.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace facetmill {

namespace {

constexpr int usual_bits = 14; // of Draco positions

struct DracoOptions {
    bool on = true;
    std::optional<std::int64_t> position_bits;
    std::int64_t normal_bits = 10, uv_bits = 12, colour_bits = 8, generic_bits = 12, speed = 3;
};

enum class Precision { single, full };

struct WriteOptions {
    PathText path;
    std::string format;
    Unit unit = Unit::unknown;
    UpAxis up = UpAxis::unknown;
    bool ascii = false, big_endian = false, mesh_manifold = false, lods = false;
    Precision precision = Precision::single;
    std::optional<DracoOptions> draco;
};

void declare_draco(Declare<DracoOptions>& d) {
    d.option("position_bits", &DracoOptions::position_bits,
             "Bits of each coordinate: the largest side is cut into 2^bits - 1 steps (a count); unset, the "
             "fewest from 14 to 24 at which no two vertices fall together, or 14 where 24 are too few.")
        .between(1, 30);
    d.option("normal_bits", &DracoOptions::normal_bits, "Bits of normals (a count).").between(1, 30);
    d.option("uv_bits", &DracoOptions::uv_bits, "Bits of texture coordinates (a count).").between(1, 30);
    d.option("colour_bits", &DracoOptions::colour_bits, "Bits of colours (a count).").between(1, 30);
    d.option("generic_bits", &DracoOptions::generic_bits, "Bits of every other attribute (a count).")
        .between(1, 30);
    d.option("speed", &DracoOptions::speed, "0 gives the smallest file, 10 the fastest coding (a count).")
        .between(0, 10);
    d.shorthand("true or false", {{"type", "boolean"}},
                [](const Value& v, DracoOptions& out, Problems& problems) {
                    return OptionType<bool>::parse(v, out.on, problems);
                });
}

void declare(Declare<WriteOptions>& d) {
    d.option("path", &WriteOptions::path,
             "The file to write; its suffix says the format; - is standard output.")
        .primary()
        .required();
    d.option("format", &WriteOptions::format, "The format's name, when the suffix does not tell it.");
    d.choice<Unit>("unit", &WriteOptions::unit,
                   unit_choices("auto", "the format's (glTF: metres), else the scene's"),
                   "The unit that the file's numbers are in.");
    d.choice<UpAxis>("up", &WriteOptions::up, up_choices("auto", "the format's (glTF: y), else the scene's"),
                     "The axis that points up in the file.");
    d.option("ascii", &WriteOptions::ascii, "PLY and STL as text instead of binary.");
    d.option("big_endian", &WriteOptions::big_endian, "Binary PLY with the most significant byte first.");
    d.choice<Precision>("precision", &WriteOptions::precision,
                        {{"single", Precision::single, "rounded to 32-bit floats"},
                         {"full", Precision::full, "with all 64 bits (PLY, OBJ, OFF)"}},
                        "How positions are written.");
    d.group("draco", &WriteOptions::draco, "glTF with KHR_draco_mesh_compression: true, or its settings.",
            declare_draco);
    d.option("mesh_manifold", &WriteOptions::mesh_manifold,
             "glTF with EXT_mesh_manifold, so that readers need not weld.");
    d.option("lods", &WriteOptions::lods,
             "glTF with MSFT_lod: the parts X.lod1, X.lod2, ... are shown in place of X, not beside it.");
}

/// An option that only some formats know, and whether it asks for something.
struct FormatOption {
    const char* name;
    std::vector<std::string> formats;
    bool asked;
};

std::vector<FormatOption> format_options(const WriteOptions& o) {
    return {{"ascii", {"ply", "stl"}, o.ascii},
            {"big_endian", {"ply"}, o.big_endian},
            {"precision", {"ply", "obj", "off"}, o.precision == Precision::full},
            {"draco", {"gltf", "glb", "drc"}, o.draco && o.draco->on},
            {"mesh_manifold", {"gltf", "glb"}, o.mesh_manifold},
            {"lods", {"gltf", "glb"}, o.lods}};
}

/// Options that say something another format knows.
void verify_options(const WriteOptions& o, const std::string& format, const Value& given,
                    Problems& problems) {
    for (const auto& [name, formats, asked] : format_options(o))
        if (asked && std::find(formats.begin(), formats.end(), format) == formats.end())
            problems.add(
                given.find_entry(name)->key_mark, "E-EXCLUSIVE",
                fmt::format("write: '{}' goes with {}, not with {}", name, fmt::join(formats, ", "), format),
                "leave it out");
}

const io::Codec* codec_of(const WriteOptions& o) {
    return o.format.empty() ? io::codec_for(o.path.text) : io::codec_named(o.format);
}

void verify(const WriteOptions& o, const Value& given, Problems& problems) {
    const Value* path = given.is_map() ? given.find("path") : &given;
    const Value* format = given.is_map() ? given.find("format") : nullptr;
    if ((path && path->deferred) || (format && format->deferred)) return;
    const io::Codec* codec = codec_of(o);
    std::vector<std::string> names;
    for (const auto& c : io::codecs())
        if (c.write) names.push_back(c.name);
    const Mark& mark = format ? format->mark : path ? path->mark : given.mark;
    if (!codec && format)
        problems.add(mark, "E-FORMAT", fmt::format("there is no format '{}'", o.format),
                     suggestion(o.format, names));
    else if (!codec)
        problems.add(mark, "E-FORMAT", fmt::format("the suffix of '{}' names no format", o.path.text),
                     fmt::format("say it with 'format', one of: {}", fmt::join(names, ", ")));
    else if (!codec->write)
        problems.add(mark, "E-FORMAT", fmt::format("{} is read but not written", codec->name),
                     suggestion("", names));
    else if (codec->name == "gltf" && o.path.text == "-")
        problems.add(mark, "E-FORMAT", "a gltf has a file beside it, which standard output cannot hold",
                     "format: glb");
    else
        verify_options(o, codec->name, given, problems);
}

/// The file's name without suffix and .gz.
std::string title_of(const std::filesystem::path& target) {
    const std::filesystem::path name = target.extension() == ".gz" ? target.stem() : target.filename();
    return target == "-" ? "mesh" : name.stem().string();
}

io::WriteSettings settings_of(const WriteOptions& o, const io::Codec& codec,
                              const std::filesystem::path& target) {
    io::WriteSettings s;
    s.ascii = o.ascii;
    s.big_endian = o.big_endian;
    s.mesh_manifold = o.mesh_manifold;
    s.lods = o.lods;
    s.double_positions = o.precision == Precision::full;
    s.title = title_of(target);
    if (o.draco && o.draco->on)
        s.draco = {.on = true,
                   .position_bits = static_cast<int>(o.draco->position_bits.value_or(usual_bits)),
                   .normal_bits = static_cast<int>(o.draco->normal_bits),
                   .uv_bits = static_cast<int>(o.draco->uv_bits),
                   .colour_bits = static_cast<int>(o.draco->colour_bits),
                   .generic_bits = static_cast<int>(o.draco->generic_bits),
                   .speed = static_cast<int>(o.draco->speed)};
    s.draco.on |= codec.name == "drc";
    return s;
}

/// The positions of all parts in the world, as a plain Draco file has them.
Mesh in_one(const Scene& scene) {
    Mesh all;
    for (const Part& part : scene.parts)
        for (const Vec3& p : part.mesh.positions) all.positions.push_back(part.transform.point(p));
    return all;
}

/// Bits of position for a file that is compressed by Draco: those given, or as many as keep vertices apart.
void choose_bits(io::WriteSettings& s, const WriteOptions& o, const io::Codec& codec, const Scene& scene,
                 Context& context) {
    if (!s.draco.on) return;
    const char* why = "as given";
    if (!o.draco || !o.draco->position_bits) {
        std::optional<int> most = usual_bits;
        const auto look = [&](const Mesh& mesh) {
            if (most) most = io::bits_that_keep_apart(mesh, *most);
        };
        if (codec.name == "drc")
            look(in_one(scene));
        else
            for (const Part& part : scene.parts) look(part.mesh);
        s.draco.position_bits = most.value_or(usual_bits);
        why = most ? "the fewest from 14 that keep vertices apart" : "24 would not keep all vertices apart";
    }
    context.result()["draco"] = {{"position_bits", s.draco.position_bits}, {"why", why}};
}

/// Converts to the file's convention, which the option or else the format says.
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

/// Stages the files, the first as the target and the others beside it, and reads the first back.
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

/// Where a part came from and stood.
struct Lent {
    std::size_t part;
    Transform transform;
    bool skinned;
};

Scene run(Scene scene, const WriteOptions& o, Context& context) {
    const io::Codec* codec = codec_of(o);
    if (!codec || !codec->write)
        throw Error(ErrorKind::usage, "E-FORMAT",
                    fmt::format("the suffix of '{}' names no format", o.path.text), {}, context.where());
    // The parts are lent to the scene that is written, so that no mesh is copied, and come back as they were.
    Scene out{{}, scene.materials, scene.unit, scene.up, scene.documents};
    std::vector<Lent> lent;
    for (std::size_t i = 0; i < scene.parts.size(); ++i)
        if (context.selects(scene.parts[i], scene))
            lent.push_back({i, scene.parts[i].transform, scene.parts[i].skinned});
    for (const auto& l : lent) out.parts.push_back(std::move(scene.parts[l.part]));
    if (out.face_count() == 0)
        throw Error(ErrorKind::stage, "E-EMPTY",
                    fmt::format("there is nothing to write to '{}': the scene has no faces", o.path.text),
                    "see what the stages before kept; the common key when: {faces: {min: 1}} skips a write",
                    context.where());
    to_convention(out, o, *codec, context);
    const std::filesystem::path target = context.places().output(o.path.text);
    io::WriteSettings settings = settings_of(o, *codec, target);
    choose_bits(settings, o, *codec, out, context);
    const io::Written written = codec->write(out, settings);
    for (const auto& w : written.warnings) context.warn(w.id, w.message, w.hint);
    if (!out.parts.empty()) context.ledger(out.parts.front(), written.fates);
    stage_files(written, target, *codec, out, settings, context);
    for (std::size_t k = 0; k < lent.size(); ++k) {
        Part& back = scene.parts[lent[k].part] = std::move(out.parts[k]);
        back.transform = lent[k].transform;
        back.skinned = lent[k].skinned;
    }
    return scene;
}

/// The file and, of a .gltf, the buffer beside it.
StageFiles files(const WriteOptions& o) {
    const io::Codec* codec = codec_of(o);
    const std::filesystem::path path = o.path.text;
    if (!codec || codec->name != "gltf" || o.path.text == "-") return {{}, {o.path}};
    return {{}, {o.path, {(path.parent_path() / (title_of(path) + ".bin")).string()}}};
}

const RegisterStage registered{
    make_stage<WriteOptions>({.name = "write",
                              .about = "Writes the scene to a mesh file; it passes on as it is.",
                              .details = "Files are written beside their targets and appear together when "
                                         "the run has succeeded; what was there before "
                                         "stays until then. The file is decoded again and compared with the "
                                         "scene: the number of faces, and how far "
                                         "positions moved (float32, Draco). Units and the up axis are "
                                         "converted to the format's convention; formats "
                                         "without nodes get all parts in world space. What the format cannot "
                                         "hold is in the ledger. A name that ends "
                                         "in .gz is compressed.",
                              .examples = {"write: part.glb", "write: {path: part.glb, draco: true}",
                                           "write: {path: print.stl, unit: mm, up: z}"}},
                             declare, run, StageHooks<WriteOptions>{.files = files, .verify = verify})};

} // namespace

} // namespace facetmill
