#include "io/images/image_files.hpp"

#include "base/hash.hpp"
#include "base/text/markup.hpp"
#include "base/text/percent_encoded.hpp"
#include "base/text/spelling.hpp"
#include "io/images/avif.hpp"
#include "parallel/memory.hpp"
#include "platform/file_names.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::io {

namespace fs = std::filesystem;

namespace {

unsigned byte_at(Span bytes, std::size_t i) { return std::to_integer<unsigned>(bytes[i]); }

/// The colour type of the header (PNG specification, third edition, 11.2.1), or a palette's transparency.
std::optional<ImageColours> png_colours(Span bytes) {
    constexpr std::size_t colour_type = 25;
    if (bytes.size() <= colour_type) return {};
    const unsigned type = byte_at(bytes, colour_type);
    const std::string_view head = as_text(bytes.first(std::min<std::size_t>(bytes.size(), 4096)));
    return ImageColours{(type & 2) == 0, (type & 4) != 0 || head.find("tRNS") != std::string_view::npos};
}

/// The number of components in the frame (ITU-T T.81, B.2.2), from the first SOF marker.
std::optional<ImageColours> jpeg_colours(Span bytes) {
    for (std::size_t at = 2; at + 9 < bytes.size();) {
        if (byte_at(bytes, at) != 0xff) return {};
        const unsigned marker = byte_at(bytes, at + 1);
        const bool frame =
            marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
        if (frame) return ImageColours{byte_at(bytes, at + 9) == 1, false};
        at += marker == 0xff ? 1 : 2 + (byte_at(bytes, at + 2) << 8 | byte_at(bytes, at + 3));
    }
    return {};
}

} // namespace

namespace {

bool leaves_folder(const fs::path& relative) { return !relative.empty() && *relative.begin() == ".."; }

bool is_below(const fs::path& folder, const fs::path& file) {
    return std::mismatch(folder.begin(), folder.end(), file.begin(), file.end()).first == folder.end();
}

/// The path with links and .. resolved; the file need not exist. Made absolute first, because
/// weakly_canonical leaves a relative path unchanged if no part of it exists.
fs::path resolved(const fs::path& path, std::error_code& failed) {
    const fs::path absolute = fs::absolute(path, failed);
    return failed ? fs::path() : fs::weakly_canonical(absolute, failed);
}

/// The path without "..", if that path names the same file. With links, it may name a different file.
fs::path plain(const fs::path& path, const fs::path& real) {
    std::error_code failed;
    const fs::path normal = path.lexically_normal();
    return resolved(normal, failed) == real && !failed ? normal : path;
}

} // namespace

std::optional<fs::path> path_below(const Input& input, const fs::path& relative) {
    const std::vector<fs::path>& roots = input.asset_roots();
    if (leaves_folder(relative) && roots.empty()) return std::nullopt;
    std::error_code failed;
    const fs::path folder = input.path().parent_path();
    const fs::path base = resolved(folder.empty() ? "." : folder, failed);
    if (failed) return std::nullopt;
    const fs::path real = resolved(base / relative, failed);
    const auto holds = [&](const fs::path& root) { return is_below(root, real); };
    if (failed || !(holds(base) || std::any_of(roots.begin(), roots.end(), holds))) return std::nullopt;
    const fs::path path = input.path_beside(relative);
    return leaves_folder(relative) ? plain(path, real) : path;
}

std::string hint_for_asset_root(const Input& input, const std::optional<fs::path>& relative) {
    if (!relative || !leaves_folder(*relative)) return {};
    fs::path folder = input.path().parent_path();
    for (const fs::path& step : *relative)
        if (step == "..") folder /= step;
    folder = folder.lexically_normal();
    if (!folder.has_filename()) folder = folder.parent_path(); // converts "assets/" to "assets"
    const std::string name = for_shell(folder.empty() ? "." : folder.generic_string());
    return fmt::format(
        "--asset-root {0}, or load: {{path: ..., asset_root: {0}}}, allows the files below that folder",
        name);
}

std::optional<fs::path> relative_path_of(std::string name) {
    std::replace(name.begin(), name.end(), '\\', '/');
    if (name.find('\0') != std::string::npos) return {};
    const fs::path path = fs::path(name).lexically_normal();
    if (path.empty() || path.has_root_path() || path == "." || !path.has_filename()) return {};
    return path;
}

std::optional<Bytes> read_image(const Input& input, const std::optional<fs::path>& relative,
                                const std::string& name, const std::string& where, ReadLog& log) {
    const auto refuse = [&](const std::string& why, std::string hint = {}) -> std::optional<Bytes> {
        log.warnings.push_back({Severity::warning, "W-IMAGE", fmt::format("{}: {}", where, why),
                                file_mark(input.name()), std::move(hint)});
        return {};
    };
    const auto path = relative ? path_below(input, *relative) : std::nullopt;
    if (!path) {
        log.unrepeatable = true; // the link may change
        return refuse(
            fmt::format("\"{}\" is not a file in the directory of '{}' and is not read", name, input.name()),
            hint_for_asset_root(input, relative));
    }
    std::error_code ignored;
    if (!fs::is_regular_file(*path, ignored)) {
        log.absent.push_back(*path);
        return refuse(
            fmt::format("the file \"{}\" is missing", path->generic_string()),
            "put the image into that folder, or export the model with its textures in the file (GLB)");
    }
    const auto size = fs::file_size(*path, ignored);
    if (!ignored)
        require_memory(2.0 * static_cast<double>(size), fmt::format("reading '{}'", path->generic_string()),
                       "use a machine with more memory");
    try {
        const Input image = Input::open(*path);
        Bytes bytes(image.stored().begin(), image.stored().end());
        log.files.push_back({*path, bytes.size(), sha256(bytes)});
        return bytes;
    } catch (const Error& error) {
        // A disk failure, or too many open files. Without this image the result would be different.
        if (error.kind() == ErrorKind::missing && may_read(*path)) throw;
        log.unrepeatable = true; // the file exists, and may become readable
        return refuse(error.diagnostics().front().message, "check the permissions of the image");
    }
}

std::string media_type(Span bytes) {
    const std::string_view text = as_text(bytes.first(std::min<std::size_t>(bytes.size(), 16)));
    if (text.starts_with("\x89PNG\r\n\x1a\n")) return "image/png";
    if (text.starts_with("\xff\xd8\xff")) return "image/jpeg";
    if (text.starts_with("RIFF") && text.substr(std::min<std::size_t>(text.size(), 8)).starts_with("WEBP"))
        return "image/webp";
    if (is_avif(bytes)) return "image/avif";
    if (text.starts_with("\xabKTX 20\xbb\r\n\x1a\n")) return "image/ktx2";
    return text.starts_with("DDS ") ? "image/vnd-ms.dds" : "";
}

std::optional<ImageColours> image_colours(Span bytes) {
    const std::string type = media_type(bytes);
    if (type == "image/png") return png_colours(bytes);
    if (type == "image/jpeg") return jpeg_colours(bytes);
    return {};
}

std::string uri_of(const fs::path& relative) { return percent_encoded(relative.generic_string()); }

bool has_bytes(const fs::path& path, Span bytes) {
    std::error_code failed;
    if (!fs::is_regular_file(path, failed) || fs::file_size(path, failed) != bytes.size()) return false;
    const Input file = Input::open(path);
    return std::equal(bytes.begin(), bytes.end(), file.stored().begin(), file.stored().end());
}

std::string suffix_of_image(const std::string& type) {
    return type == "image/webp"   ? ".webp"
           : type == "image/avif" ? ".avif"
           : type == "image/ktx2" ? ".ktx2"
           : type == "image/jpeg" ? ".jpg"
                                  : ".png";
}

fs::path file_name_of_image(const std::string& name, std::size_t index, Span bytes) {
    constexpr std::size_t most = 100;
    const std::string suffix = suffix_of_image(media_type(bytes));
    std::string stem = name.empty() ? fmt::format("image{}", index) : name;
    const std::string last = lower_case(fs::path(stem).extension().generic_string());
    if (last == suffix || last == ".jpeg") stem.resize(stem.size() - last.size());
    const std::string_view forbidden = R"(/\:*?"<>|)"; // in names on Windows, the first on all systems
    for (char& c : stem)
        if (static_cast<unsigned char>(c) < ' ' || forbidden.find(c) != forbidden.npos) c = '_';
    std::size_t end = std::min(stem.size(), most); // avoids cutting a character
    while (end < stem.size() && end > 0 && (static_cast<unsigned char>(stem[end]) & 0xc0) == 0x80) --end;
    return stem.substr(0, end) + suffix;
}

namespace {

/// A path component that is safe in lines with blank-separated words, and on all file systems.
std::string plain_step(std::string step) {
    for (char& c : step)
        if (static_cast<unsigned char>(c) <= ' ' ||
            std::string_view("\x7f#\"'\\:*?<>|").find(c) != std::string_view::npos)
            c = '_';
    if (step.starts_with('-')) step.front() = '_'; // a leading dash would begin an option
    return step;
}

} // namespace

ImageNames::ImageNames(const std::string& stem, Spelling spelling)
    : spelling_(spelling), stem_(spelling == Spelling::plain ? plain_step(stem) : stem) {
    for (const char* suffix : {".gltf", ".glb", ".bin", ".obj", ".mtl"})
        taken_.insert(lower_case(stem_ + suffix));
}

fs::path ImageNames::add(const fs::path& relative) {
    const auto spelled = [&](const fs::path& step) {
        return spelling_ == Spelling::plain ? plain_step(step.generic_string()) : step.generic_string();
    };
    const std::string file = spelled(relative.filename());
    const std::string name = file.starts_with(stem_ + ".") ? file : stem_ + "." + file;
    fs::path folder;
    for (const fs::path& step : relative.parent_path())
        if (step != "..") folder /= spelled(step);
    fs::path path = folder / name;
    const fs::path plain = fs::path(name).stem(), extension = fs::path(name).extension();
    for (int n = 2; !taken_.insert(lower_case(path.generic_string())).second; ++n)
        path = folder / fmt::format("{}.{}{}", plain.generic_string(), n, extension.generic_string());
    return path;
}

} // namespace facetmill::io
