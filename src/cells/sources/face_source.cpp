#include "cells/sources/face_source.hpp"

#include "base/text/words.hpp"
#include "cells/sources/gltf_rows.hpp"
#include "cells/sources/off_rows.hpp"
#include "cells/sources/ply_rows.hpp"
#include "cells/sources/rows.hpp"
#include "cells/sources/stl_source.hpp"
#include "io/encoding.hpp"
#include "io/material_document.hpp"
#include "io/metadata.hpp"
#include "io/outputs/output_files.hpp"
#include "io/packing.hpp"
#include "io/ply/ply.hpp"
#include "io/stl/stl.hpp"
#include "io/text.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::cells {

namespace {

enum class Format { none, ply, stl, obj, off, gltf };

constexpr std::size_t mapped_from = std::size_t{1} << 16; ///< size in bytes

[[noreturn]] void changed_while_read(const io::Input& input) {
    throw Error(ErrorKind::malformed, "E-CHANGED",
                fmt::format("'{}' changed while it was read", input.name()),
                "run it again while no other program writes to it");
}

/// Whether the file is compressed, whatever its name.
bool is_packed(const std::filesystem::path& path) {
    if (io::packing_named(path) != io::Packing::none) return true;
    constexpr std::uintmax_t magic = 8;
    std::error_code error;
    io::Bytes first(std::min(magic, std::filesystem::file_size(path, error)));
    if (error) return false; // opening the file reports the error
    ReadFile(path).read(0, first);
    return io::packing_of(first) != io::Packing::none;
}

/// The format that io::read_scene would choose: by content if certain, otherwise by the suffix.
Format format_of(const io::Input& input) {
    const io::Codec* codec = io::sure_codec(input);
    if (!codec) codec = io::codec_for(input.path());
    if (is_gltf(input)) return Format::gltf;
    constexpr std::pair<const char*, Format> known[] = {
        {"ply", Format::ply}, {"stl", Format::stl}, {"obj", Format::obj}, {"off", Format::off}};
    for (const auto& [name, format] : known)
        if (codec && codec->name == name) return format;
    return Format::none;
}

std::optional<std::string> why_not(const io::Input& input, Format format) {
    switch (format) {
    case Format::ply:
        return why_ply_not_streamed(input);
    case Format::gltf:
        return why_gltf_not_streamed(input);
    case Format::stl:
        if (!is_text_stl(input)) return {};
        [[fallthrough]];
    case Format::obj:
    case Format::off:
        if (!io::is_plain_utf8(input)) return "its text is not plain UTF-8";
        return format == Format::off ? why_off_not_streamed(input) : std::nullopt;
    case Format::none:
        break;
    }
    return "its format cannot be read in pieces";
}

std::unique_ptr<RowReader> reader_of(const io::Input& input, const io::ReadSettings& settings,
                                     std::size_t memory, bool or_none) {
    switch (format_of(input)) {
    case Format::ply:
        return ply_rows(input, settings);
    case Format::stl:
        return stl_rows(input, settings, memory, or_none);
    case Format::obj:
        return obj_rows(input, settings);
    case Format::off:
        return off_rows(input, settings);
    case Format::gltf:
    case Format::none:
        break;
    }
    return gltf_rows(input, settings);
}

/// Takes the unit and axis of a file. All files that state them must agree.
void take_convention(const io::Input& input, const io::ReadSettings& settings,
                     FaceSource::Contents& contents) {
    const io::FileHeader header = io::file_header(input, settings);
    const auto differs = [](auto unknown, auto a, auto b) { return a != unknown && b != unknown && a != b; };
    if (differs(Unit::unknown, header.unit, contents.unit) ||
        differs(UpAxis::unknown, header.up, contents.up))
        throw Error(ErrorKind::usage, "E-CELLS",
                    fmt::format("'{}' and '{}' have different units or axes, but cells can have only one",
                                contents.files.front().input.name(), input.name()),
                    "give both: load: {path: ..., unit: m, up: z}");
    if (contents.unit == Unit::unknown) contents.unit = header.unit;
    if (contents.up == UpAxis::unknown) contents.up = header.up;
}

void add_once(std::vector<std::string>& all, const std::string& one) {
    if (std::find(all.begin(), all.end(), one) == all.end()) all.push_back(one);
}

bool same_properties(const std::vector<io::ply::Property>& a, const std::vector<io::ply::Property>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const auto& p, const auto& q) { return p.name == q.name && p.type == q.type; });
}

/// Attributes that all files share. None if positions define vertices, because a vertex has a single value
/// of each.
std::vector<io::ply::Property> common_properties(const std::vector<std::unique_ptr<RowReader>>& readers,
                                                 const io::ReadSettings& settings,
                                                 std::vector<std::string>& dropped) {
    std::vector<io::ply::Property> common = readers.front()->extra;
    bool alike = settings.weld != io::Weld::exact;
    for (const auto& reader : readers) alike &= same_properties(reader->extra, common);
    if (alike) return common;
    for (const auto& reader : readers)
        for (const auto& p : reader->extra) add_once(dropped, fmt::format("'{}' of vertices", p.name));
    return {};
}

struct RowMeans {
    std::filesystem::path scratch;
    std::size_t memory; ///< limit for reading
    bool or_none;       ///< see stl_rows
};

/// Opens files that are first converted to rows. May return null, see stl_rows.
std::unique_ptr<FaceSource> open_rows(const std::vector<io::Input>& inputs, const io::ReadSettings& settings,
                                      const RowMeans& means, FaceSource::Contents contents) {
    std::vector<std::unique_ptr<RowReader>> readers;
    readers.reserve(inputs.size());
    for (const io::Input& input : inputs)
        readers.push_back(reader_of(input, settings, means.memory, means.or_none));
    const auto extra = common_properties(readers, settings, contents.dropped);
    const bool single = std::all_of(readers.begin(), readers.end(), [](const auto& reader) {
        return reader->coordinate == io::ply::Type::float32;
    });
    RowWriter writer(means.scratch, extra, single ? io::ply::Type::float32 : io::ply::Type::float64);
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        take_convention(inputs[i], settings, contents);
        const FaceSource::File file =
            open_again(inputs[i]); // closed after reading, because many files may be open
        contents.files.push_back({inputs[i], readers[i]->read(file.file, writer, !extra.empty()), nullptr});
        if (contents.files.back().sha256.empty()) return nullptr;
        require_as_opened({file});
        for (auto& file : readers[i]->neighbours) contents.files.push_back(std::move(file));
        for (const std::string& what : readers[i]->dropped) add_once(contents.dropped, what);
    }
    contents.bounds = writer.bounds();
    contents.skipped_faces = writer.short_faces();
    Rows rows = writer.finish();
    const std::size_t groups = rows.groups.size();
    if (groups > 1)
        contents.dropped.push_back(
            fmt::format("the division into {}, which become one part", counted(groups, "part")));
    return source_of(std::move(rows), std::move(contents), settings);
}

} // namespace

void FaceSource::take_digests(const std::vector<std::string>& digests) {
    for (std::size_t i = 0; i < digests.size(); ++i) contents_.files[i].sha256 = digests[i];
}

void FaceSource::restore(const Box& bounds, std::uint64_t skipped_faces) {
    contents_.bounds = bounds;
    contents_.skipped_faces = skipped_faces;
}

io::Input open_mapped(const std::filesystem::path& path) { return io::Input::open(path, mapped_from); }

FaceSource::File open_again(const io::Input& input) {
    FaceSource::File file{input, {}, std::make_shared<const ReadFile>(input.path())};
    const io::Span seen = input.bytes();
    const std::optional<FileStamp>& stamp = file.file->stamp();
    bool same = stamp && stamp->bytes == seen.size();
    if (same && seen.size() < mapped_from) { // small files are copied into memory
        io::Bytes again(seen.size());
        file.file->read(0, again);
        same = std::equal(again.begin(), again.end(), seen.begin());
    } else if (same) {
        same = input.is_as_opened() && FileStamp::of(input.path()) == stamp;
    }
    if (!same) changed_while_read(input);
    return file;
}

FaceSource::File open_input(const std::filesystem::path& path) { return open_again(open_mapped(path)); }

void require_as_opened(const std::vector<FaceSource::File>& files) {
    for (const FaceSource::File& file : files)
        if (!file.input.is_as_opened() || (file.file && !file.file->is_as_opened()))
            changed_while_read(file.input);
}

void require_unchanged(const std::vector<FaceSource::File>& files) {
    for (const FaceSource::File& file : files)
        if (file.is_rows && !file.file->has_same_contents()) changed_while_read(file.input);
}

std::optional<std::string> why_not_streamed(const std::filesystem::path& path) {
    if (path == "-" || io::is_stream(path)) return "it is a stream, which can be read only once";
    if (is_packed(path)) return "it is compressed";
    const io::Input input = open_mapped(path);
    return why_not(input, format_of(input));
}

std::uint64_t estimated_faces(const std::filesystem::path& path) {
    constexpr std::uint64_t text_bytes = 30,
                            packed_bytes = 8; // bytes per face in OBJ text, and in gzip and Draco
    constexpr std::uint64_t stl_text_bytes = 200;
    std::error_code ignored;
    if (path == "-" || io::is_stream(path)) return 0;
    const auto size = std::filesystem::file_size(path, ignored);
    if (ignored) return 0;
    if (is_packed(path)) return size / packed_bytes;
    const io::Input input = open_mapped(path);
    const Format format = format_of(input);
    if (format == Format::ply) return ply_faces(input);
    if (format == Format::stl)
        return is_text_stl(input) ? size / stl_text_bytes : io::stl::promised_triangles(input.bytes());
    if (format == Format::off && !why_not(input, format)) return off_faces(input);
    if (format == Format::gltf && !why_not(input, format)) return gltf_faces(input);
    return size / text_bytes;
}

namespace {

/// Keeps the comments of a PLY as reading it into memory does.
void take_comments(const io::Input& input, FaceSource::Contents& contents) {
    if (format_of(input) != Format::ply) return;
    const auto comments = io::ply::read_header(input).comments;
    if (comments.empty()) return;
    io::MaterialDocument document(input.name());
    document.asset()["extras"][io::comments_key] = comments;
    contents.documents.push_back(document.finish());
}

} // namespace

std::unique_ptr<FaceSource> open_faces(const std::vector<std::filesystem::path>& paths,
                                       const io::ReadSettings& settings, const std::filesystem::path& scratch,
                                       std::size_t memory, bool kept) {
    std::vector<io::Input> inputs;
    for (const auto& path : paths) {
        if (const auto why = why_not_streamed(path))
            throw Error(ErrorKind::usage, "E-CELLS",
                        fmt::format("'{}' cannot be processed in cells: {}", path.generic_string(), *why),
                        "write it as binary PLY or STL first, or use more memory");
        inputs.push_back(open_mapped(path).with_asset_roots(settings.asset_roots));
    }
    FaceSource::Contents contents;
    contents.name = paths.front().stem().generic_string();
    for (const auto& input : inputs) take_comments(input, contents);
    const io::Input& first = inputs.front();
    const Format format = format_of(first);
    const bool by_format = settings.weld == io::Weld::automatic;
    const bool itself =
        inputs.size() == 1 && (by_format || (format == Format::ply && settings.weld == io::Weld::off));
    if (itself && format == Format::ply && !is_text_ply(first)) {
        take_convention(first, settings, contents);
        return open_ply(open_again(first), settings, std::move(contents));
    }
    if (itself && format == Format::stl && !is_text_stl(first)) {
        if (!kept)
            if (auto source = open_rows(inputs, settings, {scratch, memory, true}, contents)) return source;
        take_convention(first, settings, contents);
        return open_stl(open_again(first), settings, std::move(contents));
    }
    return open_rows(inputs, settings, {scratch, memory, false}, std::move(contents));
}

} // namespace facetmill::cells
