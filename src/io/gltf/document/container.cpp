#include "io/gltf/document/container.hpp"

#include "base/hash.hpp"
#include "base/ordered_set.hpp"
#include "base/text/words.hpp"
#include "io/gltf/document/accessor.hpp"
#include "io/gltf/document/tinygltf_files.hpp"
#include "io/images/image_files.hpp"
#include "parallel/memory.hpp"
#include "platform/file_bytes.hpp"
#include "platform/file_status.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fmt/format.h>
#include <set>
#include <system_error>
#include <utility>

namespace facetmill::io::gltf {

namespace {

constexpr std::uint32_t magic = 0x46546C67, json_chunk = 0x4E4F534A, binary_chunk = 0x004E4942;

std::uint32_t word(Span bytes, std::size_t at) {
    return static_cast<std::uint32_t>(little_endian(bytes, at, 4));
}

void put_word(Bytes& out, std::uint64_t value) {
    for (std::size_t i = 0; i < 4; ++i) out.push_back(static_cast<std::byte>(value >> (8 * i) & 255));
}

[[noreturn]] void fail(std::size_t at, const std::string& message) {
    throw Error(ErrorKind::malformed, "E-GLB", fmt::format("at byte {}: {}", at, message));
}

void put_chunk(Bytes& out, std::uint32_t kind, Span data, std::byte padding) {
    put_word(out, (data.size() + 3) / 4 * 4);
    put_word(out, kind);
    out.insert(out.end(), data.begin(), data.end());
    while (out.size() % 4 != 0) out.push_back(padding);
}

} // namespace

bool is_glb(Span bytes) { return bytes.size() >= 4 && word(bytes, 0) == magic; }

Chunks split_glb(Span bytes) {
    if (bytes.size() < 12) fail(bytes.size(), "the GLB header is cut short");
    const std::uint32_t version = word(bytes, 4), length = word(bytes, 8);
    if (version != 2)
        throw Error(ErrorKind::malformed, "E-VERSION",
                    fmt::format("at byte 4: expected GLB version 2, found version {}", version),
                    version == 1 ? hint_for_version_1 : "");
    if (length > bytes.size())
        fail(8, fmt::format("the header gives {} bytes, but the file has {}", length, bytes.size()));
    Chunks chunks;
    for (std::size_t at = 12, number = 0; at < length; ++number) {
        if (length - at < 8) {
            if (number > 0) break; // ignores stray padding after the last chunk
            fail(at, "a chunk header is cut short");
        }
        const std::uint32_t size = word(bytes, at), kind = word(bytes, at + 4);
        if (size > length - at - 8) fail(at, fmt::format("a chunk of {} bytes goes beyond the end", size));
        const Span data = bytes.subspan(at + 8, size);
        if (number == 0) {
            if (kind != json_chunk) fail(at, "the first chunk is not JSON");
            chunks.json = as_text(data);
        } else if (kind == binary_chunk && !chunks.binary) {
            chunks.binary = data;
        } else {
            chunks.skipped += data.size();
        }
        at += 8 + std::size_t{size};
    }
    if (chunks.json.empty()) fail(12, "there is no JSON chunk");
    chunks.skipped += bytes.size() - length;
    return chunks;
}

Bytes join_glb(std::string_view json, Span binary) {
    const std::uint64_t total =
        12 + 8 + (json.size() + 3) / 4 * 4 + (binary.empty() ? 0 : 8 + (binary.size() + 3) / 4 * 4);
    if (total > UINT32_MAX)
        throw Error(ErrorKind::limit, "E-SIZE",
                    fmt::format("a GLB cannot be larger than 4 GiB, and this one would have {} bytes", total),
                    "write .gltf, use Draco, or split the scene");
    Bytes out;
    out.reserve(static_cast<std::size_t>(total));
    put_word(out, magic);
    put_word(out, 2);
    put_word(out, total);
    put_chunk(out, json_chunk, std::as_bytes(std::span(json.data(), json.size())), std::byte{' '});
    if (!binary.empty()) put_chunk(out, binary_chunk, binary, std::byte{0});
    return out;
}

// --- tinygltf resolves buffers: it decodes data URIs and asks for files.
// It gets one buffer at a time, never the whole document or images. Its parser does not check
// references, and refuses buffers that only EXT_meshopt_compression needs. Its model also loses unknown
// contents (64-bit integers, nulls, empty objects).

namespace fs = std::filesystem;

namespace {

/// Reads at most `most` bytes of the file; returns errno, 0 for success.
int read_prefix(const fs::path& path, std::size_t most, std::vector<unsigned char>& out) {
    const Descriptor file = open_file(path);
    if (!file) return errno;
    const auto about = status_of(file);
    if (!about) return errno;
    // glTF allows files longer than byteLength; tinygltf does not. The file may be sparse, so its size proves
    // nothing.
    out.resize(std::min<std::size_t>(about->stamp.bytes, most));
    for (std::size_t at = 0; at < out.size();) {
        const auto got = read_some(file, std::as_writable_bytes(std::span(out).subspan(at)));
        if (!got) return errno;
        if (*got == 0) out.resize(at); // the file was truncated meanwhile
        at += *got;
    }
    return 0;
}

/// The file that tinygltf may read: one checked file, up to a limit.
struct Neighbour : TinygltfFiles {
    Neighbour(fs::path file, std::size_t most) : path(std::move(file)), bytes(most) {}

    bool exists(const std::string&) override {
        std::error_code ignored;
        return fs::is_regular_file(path, ignored);
    }
    std::size_t size() const override { return bytes; }
    bool read(const std::string&, std::vector<unsigned char>& out, std::string& reason) override {
        error = read_prefix(path, bytes, out);
        if (error != 0) reason = "cannot be read";
        return error == 0;
    }

    fs::path path;
    std::size_t bytes;
    int error = 0; ///< errno of a failed read
};

int hex(char c) {
    return c >= '0' && c <= '9'   ? c - '0'
           : c >= 'a' && c <= 'f' ? c - 'a' + 10
           : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                  : -1;
}

std::string percent_decoded(std::string_view uri) {
    std::string out;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        if (uri[i] == '%' && i + 2 < uri.size() && hex(uri[i + 1]) >= 0 && hex(uri[i + 2]) >= 0) {
            out += static_cast<char>(hex(uri[i + 1]) * 16 + hex(uri[i + 2]));
            i += 2;
        } else {
            out += uri[i];
        }
    }
    return out;
}

Bytes resolve_with_tinygltf(const JsonCursor& buffer, const std::string& uri, Neighbour neighbour) {
    const Json document = {{"asset", {{"version", "2.0"}}},
                           {"buffers", {{{"uri", uri}, {"byteLength", neighbour.bytes}}}}};
    const std::string text = document.dump();
    tinygltf::TinyGLTF loader = loader_for(neighbour);
    tinygltf::Model model;
    std::string error, warning;
    const bool loaded =
        text.size() <= UINT32_MAX &&
        loader.LoadASCIIFromString(&model, &error, &warning, text.data(), static_cast<unsigned>(text.size()),
                                   "", tinygltf::NO_REQUIRE);
    if (neighbour.error != 0)
        throw Error(ErrorKind::missing, "E-FILE",
                    fmt::format("{}.uri: the file \"{}\" cannot be read: {}", buffer.path(),
                                neighbour.path.generic_string(), std::strerror(neighbour.error)));
    if (!loaded || model.buffers.size() != 1)
        buffer.fail(fmt::format("expected {} bytes, but {} has fewer", neighbour.bytes,
                                is_data_uri(uri) ? "the data URI" : "the file \"" + uri + "\""),
                    "E-BUFFER");
    const auto& data = model.buffers[0].data;
    Bytes bytes(data.size());
    if (!data.empty()) std::memcpy(bytes.data(), data.data(), data.size());
    return bytes;
}

Bytes load_uri(const JsonCursor& buffer, const std::string& uri, std::size_t length, const Input& input,
               ReadLog& log) {
    if (is_data_uri(uri)) return resolve_with_tinygltf(buffer, uri, {{}, length});
    const fs::path path = buffer_path(buffer, uri, input);
    std::error_code ignored;
    if (!fs::is_regular_file(path, ignored))
        throw Error(ErrorKind::missing, "E-FILE",
                    fmt::format("{}.uri: the file \"{}\" is missing", buffer.path(), path.generic_string()));
    const auto size = fs::file_size(path, ignored);
    if (!ignored)
        require_memory(2.0 * static_cast<double>(std::min<std::uintmax_t>(size, length)),
                       fmt::format("reading '{}'", path.generic_string()), "use a machine with more memory");
    Bytes bytes = resolve_with_tinygltf(buffer, uri, {path, length});
    // A file longer than the buffer is not read to its end.
    const bool whole = !ignored && size == bytes.size();
    log.files.push_back({path, bytes.size(), whole ? sha256(bytes) : std::string()});
    return bytes;
}

bool is_fallback(const JsonCursor& buffer) {
    const auto meshopt = meshopt_extension(buffer);
    return meshopt && meshopt->boolean_or("fallback", false);
}

} // namespace

bool is_data_uri(std::string_view uri) { return uri.substr(0, 5) == "data:"; }

Bytes data_uri_bytes(std::string_view uri) {
    Bytes bytes;
    std::uint32_t bits = 0;
    int count = 0;
    for (const char c : uri.substr(std::min(uri.size(), uri.find(',') + 1))) {
        const int six = c >= 'A' && c <= 'Z'   ? c - 'A'
                        : c >= 'a' && c <= 'z' ? c - 'a' + 26
                        : c >= '0' && c <= '9' ? c - '0' + 52
                        : c == '+'             ? 62
                        : c == '/'             ? 63
                                               : -1;
        if (six < 0) continue;
        bits = bits << 6 | static_cast<std::uint32_t>(six);
        count += 6;
        if (count < 8) continue;
        count -= 8;
        bytes.push_back(static_cast<std::byte>(bits >> count & 0xff));
    }
    return bytes;
}

std::optional<fs::path> decoded_path(std::string_view uri) {
    for (const char c : uri) { // a scheme ends at a colon before any slash
        if (c == ':') return std::nullopt;
        if (c == '/') break;
    }
    const std::string text = percent_decoded(uri);
    if (text.empty() || text.find('\0') != std::string::npos || text.find('\\') != std::string::npos)
        return std::nullopt;
    const fs::path path = fs::path(text).lexically_normal();
    if (path.has_root_path() || path == "." || !path.has_filename()) return std::nullopt;
    return path;
}

fs::path buffer_path(const JsonCursor& buffer, const std::string& uri, const Input& input) {
    const auto relative = decoded_path(uri);
    const auto path = relative ? path_below(input, *relative) : std::nullopt;
    if (path) return *path;
    const std::string hint = hint_for_asset_root(input, relative);
    throw Error(ErrorKind::malformed, "E-URI",
                fmt::format("{}.uri: \"{}\" is not a file in the document's directory", buffer.path(), uri),
                hint.empty() ? "only relative URIs to files in the glTF's folder or below are read" : hint);
}

std::vector<fs::path> neighbours(const Json& document, const char* list) {
    OrderedSet<fs::path> all;
    for (std::size_t i = 0; i < count_of(document, list); ++i) {
        const JsonCursor place = item(document, list, i);
        const auto uri = place.find("uri");
        if (!uri || is_data_uri(uri->text()) || is_fallback(place)) continue;
        if (const auto path = decoded_path(uri->text())) all.add(*path);
    }
    return all.all();
}

std::vector<Bytes> load_buffers(const Json& document, std::optional<Span> binary_chunk, const Input& input,
                                ReadLog& log) {
    std::vector<Bytes> buffers(count_of(document, "buffers"));
    for (std::size_t i = 0; i < buffers.size(); ++i) {
        const JsonCursor buffer = item(document, "buffers", i);
        const std::size_t length = buffer.at("byteLength").natural();
        const auto uri = buffer.find("uri");
        if (is_fallback(buffer)) continue;
        if (uri) {
            buffers[i] = load_uri(buffer, uri->text(), length, input, log);
        } else if (i == 0 && binary_chunk) {
            if (length > binary_chunk->size())
                buffer.fail(fmt::format("expected {} bytes, but the binary chunk has {}", length,
                                        binary_chunk->size()),
                            "E-BUFFER");
            buffers[i].assign(binary_chunk->begin(),
                              binary_chunk->begin() + static_cast<std::ptrdiff_t>(length));
        }
        // A buffer without data is legal until something reads it; the reader reports it.
    }
    return buffers;
}

bool is_tileset(std::string_view json) {
    constexpr std::array<std::string_view, 9> of_gltf{
        "accessors", "buffers", "bufferViews", "materials", "meshes", "nodes", "scene", "scenes", "textures"};
    json = without_byte_order_mark(json);
    int depth = 0;
    bool is_key = false; // the next text is a member's name
    for (std::size_t i = 0; i < json.size(); ++i) {
        const char c = json[i];
        if (c == '"') {
            const std::size_t first = ++i;
            for (; i < json.size() && json[i] != '"'; ++i) i += json[i] == '\\';
            if (!std::exchange(is_key, false) || i >= json.size()) continue;
            const std::string_view key = json.substr(first, i - first);
            if (key == "geometricError" || key == "root") return true;
            if (std::find(of_gltf.begin(), of_gltf.end(), key) != of_gltf.end()) return false;
        } else if (c == '{' || c == '[') {
            if (depth++ == 0 && c == '[') return false;
            is_key = depth == 1;
        } else if (c == '}' || c == ']') {
            if (--depth <= 0) return false;
        } else if (c == ',') {
            is_key = depth == 1;
        } else if (depth == 0 && c != ' ' && c != '\t' && c != '\r' && c != '\n') {
            return false; // no object
        }
    }
    return false;
}

std::map<std::string, Bytes> load_images(const Json& document, const Input& input, ReadLog& log) {
    std::map<std::string, Bytes> files;
    for (std::size_t i = 0; i < count_of(document, "images"); ++i) {
        const auto uri = item(document, "images", i).find("uri");
        if (!uri || is_data_uri(uri->text()) || files.count(uri->text())) continue;
        auto bytes = read_image(input, decoded_path(uri->text()), uri->text(), uri->path(), log);
        if (bytes) files[uri->text()] = *std::move(bytes);
    }
    return files;
}

void drop_unnamed_files(std::map<std::string, Bytes>& files, const Json& document) {
    std::set<std::string> named;
    for (std::size_t i = 0; i < count_of(document, "images"); ++i)
        if (const Json& image = document["images"][i]; image.contains("uri") && image["uri"].is_string())
            named.insert(image["uri"].get<std::string>());
    std::erase_if(files, [&](const auto& file) { return !named.contains(file.first); });
}

} // namespace facetmill::io::gltf
