#include "stages/write/cells.hpp"

#include "base/text/words.hpp"
#include "cells/write/write_cells.hpp"
#include "cells/write/write_tiles.hpp"
#include "io/outputs/output_files.hpp"
#include "io/packing.hpp"
#include "mesh/power_scale.hpp"
#include "stages/write/file.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>

namespace facetmill::write_stage {

namespace {

/// Reads the file back and compares its hash with the bytes handed over.
void read_again(const io::Outputs::File& file, Context& context) {
    const cells::ReadFile there(file.temporary);
    Sha256 sum;
    cells::Stream all(there, 0, file.bytes, &sum);
    all.skip(file.bytes);
    if (sum.digest() != file.sha256)
        throw Error(ErrorKind::output, "E-READBACK",
                    fmt::format("'{}' cannot be read back as written", file.target.generic_string()),
                    "write it to another disk", context.where());
}

void warn_of_rounding(double rounding, const WriteOptions& o, const io::Codec& codec, const CellFlow& flow,
                      Context& context) {
    constexpr double tolerable = 1e-6; // times the diagonal
    if (rounding <= tolerable * diagonal(flow.bounds())) return;
    context.warn("W-ROUNDED",
                 fmt::format("'{}': points moved by up to {:.2g}, because 32-bit floats are coarse so far "
                             "from the origin (the diagonal is {:.4g})",
                             o.path.text, rounding, diagonal(flow.bounds())),
                 codec.can.full_precision
                     ? "precision: full preserves all digits"
                     : "write PLY with precision: full, or transform: {centre: true} first");
}

struct Staged {
    const io::Outputs::File* file = nullptr;
    report::FileRecord told;
};

/// Stages bytes as a file under the pipeline's name.
Staged stage_one(const std::filesystem::path& name, io::Span bytes, Context& context) {
    const auto& staged =
        context.outputs().add(context.places().output(name.generic_string()), bytes, context.where());
    const std::string told = name.lexically_normal().generic_string();
    return {&staged, {told, staged.bytes, staged.sha256, {}, io::byte_kinds(told, staged.bytes, bytes)}};
}

/// Records the last files of the outputs for later checks.
void tell_written(const io::Outputs::File& main, std::size_t files, const std::string& format,
                  const Scene& outline, Context& context) {
    const std::size_t first = context.output_records().size() - files;
    context.wrote({.path = context.output_records()[first].path,
                   .file = &main,
                   .format = format,
                   .unit = outline.unit,
                   .up = outline.up,
                   .first_record = first,
                   .records = files});
}

/// Writes the cells as a tileset. Each tile is staged once it is made, to limit memory.
void write_tileset(const WriteOptions& o, const io::WriteSettings& settings, CellFlow& flow,
                   const Scene& outline, WriteReport& report, Context& context) {
    const std::filesystem::path path = o.path.text, folder = path.parent_path();
    std::map<std::string, Staged> tiles;
    const Transform transform = outline.parts.front().transform;
    cells::WrittenTiles written =
        cells::write_tiles(*flow.partition, transform, settings, flow.means, [&](const io::OutputFile& file) {
            tiles.emplace(file.name.generic_string(), stage_one(folder / file.name, file.bytes, context));
        });
    std::vector<const io::Outputs::File*> staged;
    const auto tell = [&](const Staged& one) {
        staged.push_back(one.file);
        context.output_records().push_back(one.told);
    };
    for (const io::OutputFile& file : written.index) tell(stage_one(folder / file.name, file.bytes, context));
    for (const std::string& name : written.names) tell(tiles.at(name));
    if (written.cache.triangles > 0) report.order = written.cache;
    report.tiles = written.told;
    for (const Diagnostic& w : written.warnings) context.warn(w.id, w.message, w.hint);
    context.attribute_changes(outline.parts.front(), written.changes);
    tell_written(*staged.front(), staged.size(), codec_of(o)->name, outline, context);
    if (!context.reads_back()) return;
    for (const io::Outputs::File* file : staged) read_again(*file, context);
}

/// Warns that a GLB written from cells has positions only, although the format could hold attributes.
void tell_of_positions_only(const WriteOptions& o, CellFlow& flow, const Part& part, Context& context) {
    constexpr const char* why = "a GLB written from cells contains only positions";
    std::vector<std::string> names;
    for (const Attribute& a : flow.partition->cell(0).mesh.attributes) {
        context.attribute_changes(part, {{a.name, a.domain, AttributeChange::Kind::dropped, why}});
        names.push_back(a.name);
    }
    if (!names.empty())
        context.warn("W-CELLS", fmt::format("'{}': {}, without {}", o.path.text, why, join_texts(names)),
                     "write PLY or a tileset, which store attributes, or give more memory");
}

/// A point near the middle of the cells if float32 would round positions by more than a millionth of the
/// diagonal.
Vec3 origin_of(const WriteOptions& o, const io::Codec& codec, const CellFlow& flow) {
    constexpr double tolerable = 1e-6,
                     step = 1.0 / (1 << 24); // times the diagonal; the relative rounding error of a float32
    const Box box = flow.partition->source().contents().bounds;
    double most = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
        most = std::max({most, std::abs(box.min[axis]), std::abs(box.max[axis])});
    if (!codec.can.transforms || o.origin.kind != OriginOption::Kind::automatic ||
        most * step <= tolerable * diagonal(box))
        return {};
    const Vec3 centre = box.centre();
    return {std::round(centre.x), std::round(centre.y), std::round(centre.z)};
}

} // namespace

std::optional<std::string> why_not_on_cells(const WriteOptions& o) {
    const io::Codec* codec = codec_of(o);
    if (!codec || !codec->write) return {};
    if (o.path.text == "-" || io::is_stream(o.path.text)) return "cells cannot be written to a stream";
    if (io::packing_named(o.path.text) != io::Packing::none) return "cells cannot be compressed";
    if (o.normals != NormalKind::keep || o.tangents != Tangents::keep)
        return "normals and tangents need the whole mesh in memory";
    if (o.origin.kind == OriginOption::Kind::point) return "in cells, origin must be auto or keep";
    if (codec->can.honours("tiles")) return {};
    return cells::why_not_written(*codec, settings_of(o, *codec, o.path.text));
}

void write_on_cells(const WriteOptions& o, CellFlow& flow, Context& context) {
    const io::Codec& codec = *codec_of(o);
    WriteReport report;
    Scene outline = flow.outline();
    to_convention(outline, o, codec, context, report);
    const std::filesystem::path target = context.places().output(o.path.text);
    io::WriteSettings settings = settings_of(o, codec, target);
    if (codec.can.honours("tiles")) {
        settings.tiles.given_bits = bits_are_given(settings);
        write_tileset(o, settings, flow, outline, report, context);
        return context.report(fields_of<WriteReport>(declare_write_report), &report);
    }
    const cells::WritePlace place{outline.parts.front().transform,
                                  origin_of(o, codec, flow),
                                  {outline.unit, outline.up},
                                  flow.partition->source().contents().documents};
    if (may_need_full(o, codec, outline.bounds()))
        settings.double_positions = needs_full(
            cells::rounding_of(*flow.partition, outline.parts.front().transform), outline.bounds(), context);
    double rounding = 0;
    const auto& staged = context.outputs().add(
        target,
        [&](const io::Outputs::Put& put) {
            rounding = cells::write_cells(*flow.partition, place, codec, settings, put);
        },
        context.where());
    warn_of_rounding(rounding, o, codec, flow, context);
    if (codec.name == "glb") tell_of_positions_only(o, flow, outline.parts.front(), context);
    const std::string told = std::filesystem::path(o.path.text).lexically_normal().generic_string();
    context.output_records().push_back(
        {told, staged.bytes, staged.sha256, {}, io::byte_kinds(told, staged.bytes, {})});
    tell_written(staged, 1, codec.name, outline, context);
    if (context.reads_back()) read_again(staged, context);
    context.report(fields_of<WriteReport>(declare_write_report), &report);
}

} // namespace facetmill::write_stage
