#include "stages/write/file.hpp"

#include "base/progress.hpp"
#include "base/text/words.hpp"
#include "geometry/normals/tangents.hpp"
#include "geometry/render/render.hpp"
#include "io/convert.hpp"
#include "io/gltf/gltf.hpp"
#include "io/gltf/optimize/document_optimizer.hpp"
#include "io/packing.hpp"
#include "io/read_back.hpp"

#include "mesh/equal_meshes.hpp"
#include "mesh/transform.hpp"
#include "stages/write/lattice.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <map>

namespace facetmill::write_stage {

namespace {

/// The up axis that pictures assume for a scene without one.
UpAxis up_in_pictures(const Scene& scene) { return camera_of(scene).up.z > 0 ? UpAxis::z : UpAxis::y; }

/// Joins all parts in world space, as in a plain Draco file.
Mesh in_one(const Scene& scene) {
    Mesh all;
    for (const Part& part : scene.parts)
        for (const Vec3& p : part.mesh.positions) all.positions.push_back(part.transform.point(p));
    return all;
}

/// The bits of each part: the fewest whose steps in the world are no larger than the steps of `bits` over the
/// longest side of the drawn contents, in the largest pose. The minimum is 10 bits, about a thousandth of the
/// part, or `bits` if fewer.
std::vector<int> bits_of_scene(const Scene& scene, const std::vector<io::PartView>& views, double whole,
                               int bits) {
    constexpr int fewest = 10;
    std::vector<int> all;
    for (std::size_t i = 0; i < scene.parts.size(); ++i) {
        const double own = scene.parts[i].mesh.bounds().longest_side() * greatest_stretch(views[i].largest);
        int enough = std::min(fewest, bits);
        const auto steps = [](int n) { return static_cast<double>((std::int64_t{1} << n) - 1); };
        while (enough < bits && own / steps(enough) > whole / steps(bits)) ++enough;
        all.push_back(enough);
    }
    return all;
}

/// Raises the bits until vertices stay distinct. Returns false if the limit is not enough; the bits are then
/// the usual number. Without a limit, nothing changes.
bool keep_distinct(int& bits, const Mesh& mesh, int usual, std::optional<int> limit) {
    if (!limit) return true;
    const std::optional<int> found = io::bits_that_keep_distinct(mesh, bits);
    const bool enough = found && *found <= *limit;
    bits = enough ? *found : usual;
    return enough;
}

/// Parts that share a grid get the largest number of bits among them, so that it is stored once.
void as_shared(std::vector<int>& bits, const DistinctParts& shapes) {
    for (std::size_t i = 0; i < bits.size(); ++i) {
        int& most = bits[shapes.first[i]];
        most = std::max(most, bits[i]);
    }
    for (std::size_t i = 0; i < bits.size(); ++i) bits[i] = bits[shapes.first[i]];
}

std::string why(int usual, io::Grid grid, int limit, bool enough) {
    if (enough)
        return fmt::format("the smallest number from {}{} that keeps vertices distinct", usual,
                           grid == io::Grid::mesh ? "" : " for the size of the scene");
    return fmt::format("{} bits would not keep all vertices distinct", limit);
}

/// Explains why rounding merged points or put points onto lines, with a hint.
std::string rounding(const io::ReadBack& back, const io::Codec& codec, const io::WriteSettings& settings) {
    const std::size_t points = back.changes.rounded;
    const std::string what = points > 0 ? fmt::format("moved {} onto others", counted(points, "point"))
                                        : std::string("moved points onto lines of others");
    if (settings.draco.on && back.grid_step >= back.float_step)
        return fmt::format("Draco's {} bits {}: use more draco.position_bits, or no draco",
                           settings.position_bits(), what);
    if (settings.quantize.on && back.grid_step >= back.float_step)
        return fmt::format("the grid of {} bits {}: use more bits of quantize.position, or no quantize",
                           settings.position_bits(), what);
    if (codec.can.full_precision && !settings.double_positions)
        return fmt::format("32-bit floats {}: use precision: full to keep all bits", what);
    return fmt::format("the 32-bit floats of {} {}: put clean: {{precision: single, self_intersections: "
                       "all}} before write, or write PLY, OBJ or OFF with precision: full",
                       codec.name, what);
}

/// Explains why a file is less sound than the scene, with a hint.
std::string reason(const io::ReadBack& back, const io::Codec& codec, const io::WriteSettings& settings) {
    const io::VertexChanges& changes = back.changes;
    std::vector<std::string> reasons;
    if (changes.added > 0)
        reasons.push_back(fmt::format("{} has one set of attributes per vertex, so seams were cut and {} "
                                      "vertices were added: write OBJ or glTF, or weld after loading (clean)",
                                      codec.name, changes.added));
    if (changes.merged > 0 && !codec.can.shares_vertices)
        reasons.push_back(
            fmt::format("{} has no shared vertices, so reading it merges corners at the same position ({} "
                        "fewer): write 3MF, PLY, OBJ or OFF, which keep them separate",
                        codec.name, changes.merged));
    else if (changes.merged > 0)
        reasons.push_back(
            fmt::format("reading {} merges vertices at the same position ({} fewer): {}write PLY, OBJ or OFF",
                        codec.name, changes.merged,
                        settings.mesh_manifold || settings.draco.on ? "" : "use mesh_manifold: true, or "));
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
                    "give the unit when you load it: load: {path: ..., unit: mm}", context.where());
    if (o.up != UpAxis::unknown && scene.up == UpAxis::unknown)
        throw Error(ErrorKind::stage, "E-UP", "the scene has no up axis, so it cannot be rotated",
                    "give the up axis when you load it: load: {path: ..., up: z}", context.where());
    const UpAxis seen = scene.up == UpAxis::unknown && target.up != UpAxis::unknown && scene.face_count() > 0
                            ? up_in_pictures(scene)
                            : target.up;
    const io::Conversion done = io::convert(scene, target);
    if (done.unit_guessed)
        context.warn(
            "W-UNITS",
            fmt::format("the scene has no unit: '{}' has the same numbers, but programs read {} in {}",
                        o.path.text, codec.name, to_string(target.unit)),
            "give unit and up axis when you load the mesh: load: {path: ..., unit: mm, up: z}, or -D unit=mm "
            "-D "
            "up=z for a built-in pipeline");
    if (done.keys_kept)
        context.warn("W-TRANSFORM", fmt::format("'{}': {}", o.path.text, io::keys_kept_message),
                     io::keys_kept_hint);
    if (seen != target.up)
        context.warn(
            "W-UP",
            fmt::format("the scene has no up axis: '{}' keeps its axes, but programs read {} with {} up, and "
                        "in this mesh {} seems to be up",
                        o.path.text, codec.name, to_string(target.up), to_string(seen)),
            fmt::format("give the up axis when you load the mesh: load: {{path: ..., up: {}}}, or -D up={} "
                        "for a built-in pipeline; up: {} if the mesh does not lie on its side",
                        to_string(seen), to_string(seen), to_string(target.up)));
    if (done.factor != 1) report.factor = done.factor;
    if (done.turned) report.up = to_string(target.up);
}

namespace {
constexpr double tolerable_rounding = 1e-6; // times the diagonal, as for glTF origins and the read-back
} // namespace

bool may_need_full(const WriteOptions& o, const io::Codec& codec, const Box& bounds) {
    if (o.precision != WriteOptions::Precision::automatic || bounds.empty()) return false;
    if (!codec.can.full_precision || codec.can.transforms) return false;
    double farthest = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
        farthest = std::max({farthest, std::abs(bounds.min[axis]), std::abs(bounds.max[axis])});
    constexpr double step = 1.0 / (1 << 24); // the largest relative rounding error of a float32
    return farthest <= std::numeric_limits<float>::max() &&
           farthest * step > tolerable_rounding * diagonal(bounds);
}

double moved_by_floats(const Scene& scene) {
    double most = 0;
    for (const Part& part : scene.parts)
        for (const Vec3& local : part.mesh.positions) {
            const Vec3 p = part.transform.point(local);
            for (std::size_t axis = 0; axis < 3; ++axis)
                most = std::max(most, std::abs(static_cast<double>(static_cast<float>(p[axis])) - p[axis]));
        }
    return most;
}

bool needs_full(double rounding, const Box& bounds, Context& context) {
    if (rounding <= tolerable_rounding * diagonal(bounds)) return false;
    context.say(fmt::format("positions are written with 64 bits, because float32 would move them by up to "
                            "{:.2g} (precision: single writes float32)",
                            rounding));
    return true;
}

std::vector<std::optional<int>> normal_map_uvs(const Scene& scene) {
    std::vector<std::optional<io::DocumentOptimizer>> documents(scene.documents.size());
    std::vector<std::optional<int>> uvs;
    for (const Material& material : scene.materials) {
        uvs.emplace_back();
        if (material.document < 0 || material.index < 0) continue;
        const auto d = static_cast<std::size_t>(material.document);
        if (!documents[d]) documents[d].emplace(*scene.documents[d]);
        uvs.back() = documents[d]->needs_of(static_cast<std::size_t>(material.index)).normal_map_uvs;
    }
    return uvs;
}

bool give_tangents(Part& part, const std::vector<std::optional<int>>& uvs_of_material, const WriteOptions& o,
                   Context& context) {
    if (part.mesh.face_count() == 0) return false;
    if (part.mesh.find("TANGENT", Domain::wedge) && o.tangents == Tangents::missing) return false;
    const auto uvs_of = [&](const Primitive& p) {
        return p.material < uvs_of_material.size() ? uvs_of_material[p.material] : std::nullopt;
    };
    std::optional<int> uvs;
    for (const Primitive& p : part.mesh.primitives)
        if (!uvs) uvs = uvs_of(p);
    if (!uvs) return false;
    Mesh mesh = part.mesh.all_triangles() ? part.mesh : triangulated(part.mesh);
    const auto change = facetmill::give_tangents(mesh, *uvs);
    if (!change) return false;
    for (Primitive& p : mesh.primitives)
        if (uvs_of(p) && !p.attributes.empty() && !p.lists("TANGENT")) p.attributes.emplace_back("TANGENT");
    part.mesh = std::move(mesh);
    part.changed = true;
    context.attribute_changes(part, {*change});
    return true;
}

bool bits_are_given(const io::WriteSettings& s) {
    return (s.draco.on ? s.draco.position_bits : s.quantize.position_bits).has_value();
}

void choose_bits(io::WriteSettings& s, const io::Codec& codec, const Scene& scene, WriteReport& report) {
    if ((!s.draco.on && !s.quantize.on) || scene.parts.empty()) return;
    const int usual = s.position_bits();
    const bool given = bits_are_given(s);
    const io::Grid grid = s.draco.on ? s.draco.grid : s.quantize.grid;
    const std::optional<int> limit = given ? std::nullopt : std::optional(s.draco.on ? 24 : 16);
    s.tiles.given_bits = given;
    if (codec.can.honours("tiles")) return; // tilesets choose a common grid: io/tileset/frame.hpp
    bool enough = true;
    if (codec.can.transforms) {
        const std::vector<io::PartView> views = io::part_views(scene);
        s.drawn = io::drawn_bounds(scene, views);
        const double whole = s.drawn->longest_side();
        s.part_bits = grid == io::Grid::mesh ? std::vector<int>(scene.parts.size(), usual)
                                             : bits_of_scene(scene, views, whole, usual);
        for (std::size_t i = 0; i < scene.parts.size(); ++i)
            enough &= keep_distinct(s.part_bits[i], scene.parts[i].mesh, usual, limit);
        const DistinctParts shapes = parts_sharing_grids(scene, views);
        as_shared(s.part_bits, shapes);
        if (grid == io::Grid::even) {
            const BitLimits limits{whole, usual, limit.value_or(usual), s.draco.on};
            EvenGrid even = even_grid(scene, shapes, s.part_bits, limits, views);
            s.part_bits = std::move(even.bits);
            s.lattices = std::move(even.lattices);
        }
    } else {
        int bits = usual;
        enough = keep_distinct(bits, in_one(scene), usual, limit);
        s.part_bits.assign(scene.parts.size(), bits);
    }
    const auto [least, most] = std::minmax_element(s.part_bits.begin(), s.part_bits.end());
    WriteReport::Bits bits{*most, {}, "as given"};
    if (*least < *most) bits.least = *least;
    if (!given) bits.why = why(usual, grid, *limit, enough);
    (s.draco.on ? s.draco.position_bits : s.quantize.position_bits) = *most;
    (s.draco.on ? report.draco : report.quantize) = bits;
}

WrittenScene stage_files(const io::Written& written, const std::filesystem::path& path,
                         const io::Codec& codec, const Scene& scene, const io::WriteSettings& settings,
                         Context& context) {
    const io::Outputs::File* main = nullptr;
    const std::size_t first = context.output_records().size();
    ProgressSteps steps({1, 3});
    for (const auto& file : written.files) {
        if (main && path == "-") {
            context.warn("W-SKIPPED",
                         fmt::format("'{}' cannot be written to standard output together with the mesh",
                                     file.name.generic_string()));
            continue;
        }
        const io::Packing packing = main ? io::Packing::none : io::packing_named(path);
        const bool packs = packing != io::Packing::none;
        const io::Bytes packed = packs ? io::packed(file.bytes, packing) : io::Bytes{};
        const std::filesystem::path name = main ? path.parent_path() / file.name : path;
        const auto& staged = context.outputs().add(context.places().output(name.generic_string()),
                                                   packs ? packed : file.bytes, context.where());
        if (!main) main = &staged;
        const std::string told = name.lexically_normal().generic_string();
        context.output_records().push_back(
            {told,
             staged.bytes,
             staged.sha256,
             {},
             io::byte_kinds(told, staged.bytes, packed.empty() ? io::Span(file.bytes) : io::Span{})});
    }
    const WrittenScene staged{.path = context.output_records()[first].path,
                              .file = main,
                              .format = codec.name,
                              .unit = scene.unit,
                              .up = scene.up,
                              .first_record = first,
                              .records = context.output_records().size() - first};
    if (!context.reads_back()) return staged;
    steps.next();
    const io::ReadBack back = io::read_back(context.outputs().staged(*main), codec, scene, settings, written);
    context.output_records()[first].read_back = back.json();
    if (!back.losses.empty())
        context.warn("W-ROUNDED",
                     fmt::format("'{}' has more defects when read back than the scene: {}",
                                 path.generic_string(), fmt::join(back.losses, ", ")),
                     reason(back, codec, settings));
    if (back.too_far_for_floats())
        context.warn(
            "W-ROUNDED",
            fmt::format("'{}': points moved by up to {:.2g}, because 32-bit floats are {:.2g} apart so far "
                        "from the origin (the diagonal is {:.4g})",
                        path.generic_string(), back.position_error, back.float_step, back.diagonal),
            codec.can.full_precision && !settings.double_positions
                ? "precision: full keeps all digits"
                : "write glTF with origin: auto, or PLY, OBJ or OFF with precision: full");
    return staged;
}

} // namespace facetmill::write_stage
