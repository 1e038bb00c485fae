#include "io/gltf/container.hpp"

#include <cstring>
#include <fmt/format.h>

namespace facetmill::io::gltf {

namespace {

constexpr std::uint32_t magic = 0x46546C67, json_chunk = 0x4E4F534A, binary_chunk = 0x004E4942;

std::uint32_t word(Span bytes, std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) value |= std::to_integer<std::uint32_t>(bytes[at + i]) << (8 * i);
    return value;
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
    if (version != 2) fail(4, fmt::format("GLB version {} is not supported, only 2", version));
    if (length > bytes.size())
        fail(8, fmt::format("the file says that it has {} bytes, but it has {}", length, bytes.size()));
    Chunks chunks;
    for (std::size_t at = 12, number = 0; at < length; ++number) {
        if (length - at < 8) {
            if (number > 0) break; // stray padding after the last chunk
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
        }
        at += 8 + std::size_t{size};
    }
    if (chunks.json.empty()) fail(12, "there is no JSON chunk");
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

} // namespace facetmill::io::gltf
