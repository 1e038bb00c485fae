#include "io/codec.hpp"

#include "base/progress.hpp"
#include "base/text/spelling.hpp"
#include "base/text/words.hpp"
#include "io/attributes.hpp"
#include "io/encoding.hpp"
#include "io/flatten.hpp"
#include "io/not_finite.hpp"
#include "io/other_formats.hpp"
#include "io/packing.hpp"
#include "io/stated.hpp"
#include "io/text.hpp"
#include "mesh/invariants.hpp"
#include "mesh/power_scale.hpp"
#include "parallel/memory.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace facetmill::io {

namespace {

std::vector<Codec>& registry() {
    static std::vector<Codec> all;
    return all;
}

template <class Condition>
std::vector<std::string> names_where(Condition&& condition) {
    std::vector<std::string> names;
    for (const auto& c : codecs())
        if (condition(c)) names.push_back(c.name);
    return names;
}

/// The codec that the content identifies, otherwise the codec of the extension.
const Codec& choose(const Input& input, ReadLog& log) {
    const Codec* by_name = codec_for(input.name());
    if (const Codec* surely = sure_codec(input)) {
        if (by_name && by_name != surely)
            log.warnings.push_back({Severity::warning, "W-FORMAT",
                                    fmt::format("'{}' is read as {}, because its content has this format",
                                                input.name(), surely->name),
                                    file_mark(input.name()), "", false});
        return *surely;
    }
    if (by_name) return *by_name;
    for (const auto& codec : codecs())
        if (codec.sniff && codec.sniff(input.bytes()) == 1) return codec;
    if (std::string hint = hint_for_reading(input.name()); !hint.empty())
        throw Error(ErrorKind::usage, "E-FORMAT",
                    fmt::format("facetmill cannot read the format of '{}'", input.name()), std::move(hint));
    throw Error(ErrorKind::usage, "E-FORMAT",
                fmt::format("the format of '{}' is not recognised", input.name()),
                fmt::format("give 'format', one of: {}", fmt::join(names_of_readers(), ", ")));
}

/// The input for its codec: text becomes UTF-8, and files with a magic number stay unchanged.
Input readable(const Input& input) { return sure_codec(input) ? input : in_utf8(input); }

/// Throws a malformed-input error (E-EMPTY) for a file without bytes, and a usage error (E-FORMAT) when no
/// codec reads it.
const Codec& reader_for(const Input& input, ReadLog& log, const Codec* forced) {
    if (input.bytes().empty())
        throw Error(ErrorKind::malformed, "E-EMPTY",
                    fmt::format("'{}' is empty: it has no bytes", input.name()),
                    "export or download the file again");
    const Codec& codec = forced ? *forced : choose(input, log);
    if (!codec.read)
        throw Error(ErrorKind::usage, "E-FORMAT", fmt::format("{} can be written but not read", codec.name));
    if (!codec.reads()) {
        const std::string other = hint_for_reading("x." + codec.extensions.front());
        throw Error(ErrorKind::usage, "E-FORMAT",
                    fmt::format("facetmill cannot read the format of '{}' on this machine", input.name()),
                    fmt::format("{}{}{}", other, other.empty() ? "" : "; or ", codec.missing()));
    }
    return codec;
}

void check_finite(const Part& part, const std::string& name) {
    for (const auto& row : part.transform.m)
        for (const double x : row)
            if (!std::isfinite(x))
                throw Error(ErrorKind::malformed, "E-NAN",
                            fmt::format("the transform of part '{}' in '{}' is not finite", part.name, name));
    const auto& positions = part.mesh.positions;
    const std::size_t first = first_not_finite(positions);
    if (first == positions.size()) return;
    const Vec3& p = positions[first];
    throw Error(ErrorKind::malformed, "E-NAN",
                fmt::format("vertex {} of part '{}' in '{}' is ({}, {}, {}), expected finite numbers", first,
                            part.name, name, p.x, p.y, p.z),
                drop_not_finite_hint);
}

void leave_out_not_finite(Part& part, const std::string& name, ReadLog& log) {
    const NotFinite out = drop_not_finite(part);
    if (out.vertices == 0) return;
    std::string with;
    if (out.faces > 0) with += fmt::format(", with {}", counted(out.faces, "face"));
    if (out.lines > 0) with += fmt::format(", with {}", counted(out.lines, "line"));
    log.warnings.push_back(
        {Severity::warning, "W-NOT-FINITE",
         fmt::format("{} of part '{}' whose coordinates are not finite numbers {} left out{}; the "
                     "first is vertex {}",
                     counted(out.vertices, "vertex", "vertices"), part.name, out.vertices == 1 ? "is" : "are",
                     with, out.first),
         file_mark(name), "clean: {holes: minimal} closes the holes that this leaves"});
}

/// If sizes are above far_size or below its inverse, products of coordinates in stages may overflow or
/// underflow.
constexpr double far_size = 1e60;

void warn_of_size(const Part& part, ReadLog& log) {
    const double size = diagonal(part.mesh.bounds());
    if (size == 0 || (size < far_size && size > 1 / far_size)) return;
    const std::string length = std::isfinite(size) ? fmt::format("{:.3g}", size) : "more than 1.8e308";
    log.warnings.push_back(
        {Severity::warning,
         "W-SIZE",
         fmt::format("part '{}' has size {}: verdicts are exact, but areas and volumes may be outside the "
                     "range of numbers (null or 0), and stages may lose precision",
                     part.name, length),
         {},
         hint_for_size(size),
         false});
}

/// The file's name without directory, .gz or .zst, and suffix, for unnamed parts.
std::string stem_of(const Input& input) {
    return without_packing(std::filesystem::path(input.name()).filename()).stem().generic_string();
}

/// Renames parts of lines that share the name of a part with faces.
void name_lines(Scene& scene) {
    std::set<std::string> names;
    for (const Part& part : scene.parts)
        if (part.mesh.line_count() == 0) names.insert(part.name);
    for (Part& part : scene.parts)
        if (part.mesh.line_count() > 0 && names.contains(part.name)) part.name += "_lines";
}

} // namespace

void VertexCacheUse::add(const VertexCacheUse& other) {
    triangles += other.triangles;
    vertices += other.vertices;
    before += other.before;
    after += other.after;
}

RegisterCodec::RegisterCodec(Codec codec) {
    auto& all = registry();
    const auto at = std::lower_bound(all.begin(), all.end(), codec.name,
                                     [](const Codec& c, const std::string& name) { return c.name < name; });
    all.insert(at, std::move(codec));
}

const std::vector<Codec>& codecs() { return registry(); }

const Codec* codec_for(const std::filesystem::path& path) {
    const std::string name = lower_case(without_packing(path).filename().generic_string());
    const std::string extension = std::filesystem::path(name).extension().generic_string();
    if (extension.empty()) return nullptr;
    for (const auto& codec : codecs())
        for (const auto& e : codec.extensions) {
            const bool two = e.find('.') != std::string::npos; // "tileset.json", which may be the whole name
            if (two ? name == e || name.ends_with("." + e) : extension.compare(1, std::string::npos, e) == 0)
                return &codec;
        }
    return nullptr;
}

const Codec* sure_codec(const Input& input) {
    const Codec* by_name = codec_for(input.name());
    const Codec* sure = nullptr;
    for (const auto& codec : codecs())
        if (codec.sniff && codec.sniff(input.bytes()) == 2 && (!sure || &codec == by_name)) sure = &codec;
    return sure;
}

const Codec* codec_named(std::string_view name) {
    for (const auto& codec : codecs())
        if (codec.name == name) return &codec;
    return nullptr;
}

std::vector<std::string> names_of_readers() {
    return names_where([](const Codec& c) { return c.reads(); });
}

std::vector<std::string> names_of_writers() {
    return names_where([](const Codec& c) { return c.write != nullptr; });
}

bool Capabilities::honours(std::string_view option) const {
    return std::any_of(options.begin(), options.end(), [&](const auto& o) { return o.name == option; });
}

FileHeader file_header(const Input& file, const ReadSettings& settings, const Codec* forced) {
    const Input input = readable(file).with_asset_roots(settings.asset_roots);
    ReadLog log; // reading the file repeats its warnings
    const Codec& codec = reader_for(input, log, forced);
    FileHeader header{codec.name, codec.unit, codec.up};
    if (codec.peek) codec.peek(input, header);
    if (settings.unit) header.unit = *settings.unit;
    if (settings.up) header.up = *settings.up;
    for (auto& name : header.parts)
        if (name.empty()) name = stem_of(input);
    return header;
}

namespace {

/// Warns if the load settings differ from the file. A scene as read has the file's unit and axis. Formats
/// with a fixed unit and axis take these from the codec.
void warn_of_override(const Input& input, const Codec& codec, const Scene& scene,
                      const ReadSettings& settings, ReadLog& log) {
    FileHeader header{codec.name, codec.unit, codec.up};
    if (codec.unit != Unit::unknown && settings.unit && codec.peek) codec.peek(input, header);
    if (codec.unit == Unit::unknown) header.unit = scene.unit;
    if (codec.up == UpAxis::unknown) header.up = scene.up;
    for (auto& warning : overridden(input.name(), {header.unit, header.up}, settings))
        log.warnings.push_back(std::move(warning));
}

} // namespace

Scene read_scene(const Input& file, const ReadSettings& settings, ReadLog& log, const Codec* forced) {
    const Input input = readable(file).with_asset_roots(settings.asset_roots);
    const Codec& codec = reader_for(input, log, forced);
    constexpr double memory_per_byte = 4; // measured on large meshes: 3 to 5 in all formats
    require_memory(memory_per_byte * static_cast<double>(input.bytes().size()),
                   fmt::format("reading '{}'", input.name()), "split it, or use a machine with more memory");
    ProgressSteps steps({8, 1});
    Scene scene = codec.read(input, settings, log);
    steps.next();
    warn_of_override(input, codec, scene, settings, log);
    if (settings.unit) scene.unit = *settings.unit;
    if (settings.up) scene.up = *settings.up;
    bool any = false;
    for (auto& part : scene.parts) {
        if (part.name.empty()) part.name = stem_of(input);
        if (settings.drop_not_finite) leave_out_not_finite(part, input.name(), log);
        check_finite(part, input.name());
        warn_of_size(part, log);
        if (settings.weld == Weld::exact) weld_exact(part.mesh);
        fix_attributes(part, input.name(), log);
        any |= part.mesh.vertex_count() > 0;
    }
    if (!settings.lines) name_lines(scene);
    if (settings.lines) {
        for (const Part& part : scene.parts)
            if (part.mesh.line_count() > 0) log.lines.push_back(lines_of(part));
        std::erase_if(scene.parts, [](const Part& part) { return part.mesh.line_count() > 0; });
    }
    for (Lines& lines : log.lines) {
        if (lines.name.empty()) lines.name = stem_of(input);
        any |= !lines.segments.empty();
    }
    if (!any && !(codec.can.documents && scene.parts.empty()))
        throw Error(ErrorKind::malformed, "E-EMPTY",
                    fmt::format("'{}' has no mesh and no vertex", input.name()),
                    "export it again with its meshes: programs may leave out hidden or unselected objects");
    return scene;
}

} // namespace facetmill::io
