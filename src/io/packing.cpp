#include "io/packing.hpp"

#include "base/error.hpp"
#include "base/progress.hpp"
#include "base/text/spelling.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <memory>
#include <new>
#include <zlib.h>
#include <zstd.h>

namespace facetmill::io {

namespace {

/// Checks for two magic bytes, the only defined method, and no reserved flags.
bool begins_as_gzip(Span bytes) {
    return bytes.size() >= 18 && bytes[0] == std::byte{0x1f} && bytes[1] == std::byte{0x8b} &&
           bytes[2] == std::byte{8} && (bytes[3] & std::byte{0xe0}) == std::byte{0};
}

/// Checks for the magic number of a frame (RFC 8878).
bool begins_as_zstd(Span bytes) {
    constexpr std::array magic{std::byte{0x28}, std::byte{0xb5}, std::byte{0x2f}, std::byte{0xfd}};
    return bytes.size() >= 9 && std::equal(magic.begin(), magic.end(), bytes.begin());
}

struct Suffix {
    const char* text;
    Packing packing;
};
constexpr Suffix suffixes[] = {{".gz", Packing::gzip}, {".zst", Packing::zstd}};

constexpr std::size_t at_once = std::size_t{1} << 30;

/// Unpacks step by step into limited memory.
struct Unpacker {
    /// The outcome of a step.
    enum class State { more, end_of_member, broken };

    Unpacker() = default;
    Unpacker(const Unpacker&) = delete;
    Unpacker& operator=(const Unpacker&) = delete;
    virtual ~Unpacker() = default;
    /// Advances both spans past the bytes read and written.
    virtual State step(Span& in, std::span<std::byte>& out) = 0;
    /// Whether another member begins here; if so, the next step reads it.
    virtual bool next_member(Span in) = 0;
    virtual const char* problem() const = 0;
    const char* id = "";
    const char* format = "";
    const char* tool = "";
};

/// Unpacks gzip, or deflate without a header.
struct Inflate final : Unpacker {
    explicit Inflate(bool header) : gzip(header) {
        id = header ? "E-GZIP" : "E-ZIP";
        format = header ? "gzip" : "deflate";
        tool = header ? "gzip -d" : "unzip";
        if (::inflateInit2(&z, header ? 15 + 16 : -15) != Z_OK)
            throw out_of_memory("not enough memory to decompress a file");
    }
    Inflate(const Inflate&) = delete;
    Inflate& operator=(const Inflate&) = delete;
    ~Inflate() override { ::inflateEnd(&z); }
    State step(Span& in, std::span<std::byte>& out) override {
        const auto take = static_cast<uInt>(std::min(in.size(), at_once));
        const auto room = static_cast<uInt>(std::min(out.size(), at_once));
        z.next_in = const_cast<Bytef*>(reinterpret_cast<const Bytef*>(in.data()));
        z.next_out = reinterpret_cast<Bytef*>(out.data());
        z.avail_in = take;
        z.avail_out = room;
        const int state = ::inflate(&z, Z_NO_FLUSH);
        in = in.subspan(take - z.avail_in);
        out = out.subspan(room - z.avail_out);
        if (state == Z_MEM_ERROR) throw std::bad_alloc();
        return state == Z_STREAM_END ? State::end_of_member : state == Z_OK ? State::more : State::broken;
    }
    bool next_member(Span in) override { return gzip && begins_as_gzip(in) && ::inflateReset(&z) == Z_OK; }
    const char* problem() const override { return z.msg ? z.msg : "it ends early"; }
    z_stream z{};
    bool gzip;
};

struct Unzstd final : Unpacker {
    Unzstd() : z(::ZSTD_createDCtx()) {
        id = "E-ZSTD";
        format = "zstd";
        tool = "zstd -d";
        if (!z) throw out_of_memory("no memory to decompress a file");
        // 128 MiB: the largest window that readers should support, and zstd's default.
        ::ZSTD_DCtx_setParameter(z, ZSTD_d_windowLogMax, 27);
    }
    Unzstd(const Unzstd&) = delete;
    Unzstd& operator=(const Unzstd&) = delete;
    ~Unzstd() override { ::ZSTD_freeDCtx(z); }
    State step(Span& in, std::span<std::byte>& out) override {
        ZSTD_inBuffer from{in.data(), in.size(), 0};
        ZSTD_outBuffer to{out.data(), out.size(), 0};
        result = ::ZSTD_decompressStream(z, &to, &from);
        in = in.subspan(from.pos);
        out = out.subspan(to.pos);
        if (::ZSTD_isError(result)) return State::broken;
        return result == 0 ? State::end_of_member : State::more;
    }
    bool next_member(Span in) override { return !in.empty(); }
    const char* problem() const override {
        return ::ZSTD_isError(result) ? ::ZSTD_getErrorName(result) : "it ends early";
    }
    ZSTD_DCtx* z;
    std::size_t result = 0;
};

Bytes unpack_all(Span bytes, Unpacker& unpacker, std::size_t most, const std::string& name) {
    const std::size_t usual = most_unpacked(bytes.size());
    const std::size_t limit = std::min(most, usual);
    Bytes out;
    std::size_t size = 0;
    for (Span in = bytes;;) {
        if (size == out.size()) out.resize(std::min(std::max<std::size_t>(size * 2, 1 << 16), limit + 1));
        ProgressScope::report(1 - static_cast<double>(in.size()) / static_cast<double>(bytes.size()));
        auto room = std::span(out).subspan(size);
        const auto state = unpacker.step(in, room);
        size = out.size() - room.size();
        if (size > limit && usual < most)
            throw Error(ErrorKind::limit, "E-SIZE",
                        fmt::format("'{}' decompresses to more than {} bytes from {}, which no mesh does",
                                    name, limit, bytes.size()),
                        fmt::format("if it is a mesh, decompress it first: {}", unpacker.tool));
        if (size > limit) too_large(name, limit);
        if (state == Unpacker::State::end_of_member) {
            if (!unpacker.next_member(in)) break;
        } else if (state == Unpacker::State::broken || (in.empty() && !room.empty())) {
            throw Error(ErrorKind::malformed, unpacker.id,
                        fmt::format("'{}' cannot be decompressed as {}: {} near byte {}", name,
                                    unpacker.format, unpacker.problem(), bytes.size() - in.size()));
        }
    }
    out.resize(size);
    return out;
}

Bytes deflated(Span bytes, bool header) {
    z_stream z{};
    if (::deflateInit2(&z, 6, Z_DEFLATED, header ? 15 + 16 : -15, 8, Z_DEFAULT_STRATEGY) != Z_OK)
        throw out_of_memory("no memory to compress a file");
    Bytes out;
    std::size_t at = 0, size = 0;
    for (int state = Z_OK; state == Z_OK;) {
        if (size == out.size()) out.resize(std::max<std::size_t>(size * 2, 1 << 16));
        const uInt in = static_cast<uInt>(std::min(bytes.size() - at, at_once));
        const uInt room = static_cast<uInt>(std::min(out.size() - size, at_once));
        z.next_in = const_cast<Bytef*>(reinterpret_cast<const Bytef*>(bytes.data() + at));
        z.next_out = reinterpret_cast<Bytef*>(out.data() + size);
        z.avail_in = in;
        z.avail_out = room;
        state = ::deflate(&z, at + in == bytes.size() ? Z_FINISH : Z_NO_FLUSH);
        at += in - z.avail_in;
        size += room - z.avail_out;
    }
    ::deflateEnd(&z);
    out.resize(size);
    return out;
}

/// Packs a single frame with its size and a checksum. Uses a single thread, because the output would depend
/// on the number of threads.
Bytes zstd_packed(Span bytes) {
    const std::unique_ptr<ZSTD_CCtx, decltype(&::ZSTD_freeCCtx)> z(::ZSTD_createCCtx(), &::ZSTD_freeCCtx);
    if (!z) throw out_of_memory("no memory to compress a file");
    // Level 9 gives smaller files than gzip's level 6, and is not slower.
    ::ZSTD_CCtx_setParameter(z.get(), ZSTD_c_compressionLevel, 9);
    ::ZSTD_CCtx_setParameter(z.get(), ZSTD_c_checksumFlag, 1);
    Bytes out(::ZSTD_compressBound(bytes.size()));
    const std::size_t size = ::ZSTD_compress2(z.get(), out.data(), out.size(), bytes.data(), bytes.size());
    if (::ZSTD_isError(size)) throw out_of_memory("no memory to compress a file");
    out.resize(size);
    return out;
}

} // namespace

void too_large(const std::string& name, std::size_t limit) {
    throw Error(ErrorKind::limit, "E-SIZE", fmt::format("'{}' gives more than {} bytes", name, limit),
                "write it to a file first, uncompressed");
}

std::size_t most_unpacked(std::size_t compressed) {
    constexpr std::size_t harmless = std::size_t{64} << 20, ratio = 200;
    return compressed > SIZE_MAX / ratio ? SIZE_MAX : std::max(harmless, ratio * compressed);
}

Packing packing_of(Span bytes) {
    return begins_as_gzip(bytes) ? Packing::gzip : begins_as_zstd(bytes) ? Packing::zstd : Packing::none;
}

Packing packing_named(const std::filesystem::path& path) {
    const std::string suffix = lower_case(path.extension().generic_string());
    for (const Suffix& known : suffixes)
        if (suffix == known.text) return known.packing;
    return Packing::none;
}

std::string stem_of_neighbours(const std::filesystem::path& output) {
    std::string stem = without_packing(output).stem().generic_string();
    std::replace(stem.begin(), stem.end(), '\\', '_');
    return stem;
}

std::filesystem::path without_packing(const std::filesystem::path& path) {
    return packing_named(path) == Packing::none ? path : path.parent_path() / path.stem();
}

Bytes unpacked(Span bytes, Packing packing, std::size_t limit, const std::string& name) {
    if (packing == Packing::none) return {bytes.begin(), bytes.end()};
    if (packing != Packing::zstd) {
        Inflate inflate(packing == Packing::gzip);
        return unpack_all(bytes, inflate, limit, name);
    }
    Unzstd unzstd;
    return unpack_all(bytes, unzstd, limit, name);
}

Bytes packed(Span bytes, Packing packing) {
    if (packing == Packing::none) return {bytes.begin(), bytes.end()};
    return packing == Packing::zstd ? zstd_packed(bytes) : deflated(bytes, packing == Packing::gzip);
}

} // namespace facetmill::io
