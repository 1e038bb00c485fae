#include "cells/face_source.hpp"

#include "cells/ply_source.hpp"
#include "cells/stl_source.hpp"
#include "io/output_files.hpp"
#include "io/packing.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::cells {

namespace {

bool is_ply(const io::Input& input) {
    constexpr std::size_t magic = 4;
    const auto text = io::as_text(input.bytes().first(std::min(magic, input.bytes().size())));
    return text == "ply\n" || text == "ply\r" || text == "ply ";
}

std::optional<std::string> why_not(const io::Input& input) {
    if (input.stored().data() != input.bytes().data()) return "it is compressed"; // under whatever name
    if (is_ply(input)) return why_ply_not_streamed(input);
    const io::Codec* codec = io::codec_for(input.path());
    if (codec && codec->name == "stl") return why_stl_not_streamed(input);
    return "its format is not read in pieces";
}

} // namespace

std::optional<std::string> why_not_streamed(const std::filesystem::path& path) {
    std::error_code ignored;
    if (path == "-" || io::is_stream(path)) return "it is a stream, and is read more than once";
    if (io::packing_named(path) != io::Packing::none) return "it is compressed";
    return why_not(io::Input::open(path));
}

std::uint64_t estimated_faces(const std::filesystem::path& path) {
    constexpr std::uint64_t text_bytes = 30, packed_bytes = 8; // of a face, in OBJ and OFF; in gzip and Draco
    std::error_code ignored;
    if (path == "-" || io::is_stream(path)) return 0;
    const auto size = std::filesystem::file_size(path, ignored);
    if (ignored) return 0;
    if (io::packing_named(path) != io::Packing::none) return size / packed_bytes;
    const io::Input input = io::Input::open(path);
    if (is_ply(input)) return ply_faces(input);
    const io::Codec* codec = io::codec_for(path);
    if (codec && codec->name == "stl" && !why_stl_not_streamed(input)) return stl_faces(input);
    return size / text_bytes;
}

std::unique_ptr<FaceSource> open_faces(const std::filesystem::path& path, const io::ReadSettings& settings) {
    io::Input input = io::Input::open(path);
    if (const auto why = why_not(input))
        throw Error(ErrorKind::usage, "E-CELLS",
                    fmt::format("'{}' cannot be processed in cells: {}", path.string(), *why),
                    "write it as binary PLY or STL first, or use more memory");
    return is_ply(input) ? open_ply(std::move(input), settings) : open_stl(std::move(input), settings);
}

} // namespace facetmill::cells
