#include "io/gltf/numbers/attribute_stream.hpp"

#include "parallel/parallel.hpp"

#include <algorithm>
#include <array>
#include <cstring>

namespace facetmill::io::gltf {

namespace {

constexpr std::byte header_1{0xA1};
constexpr std::size_t group_size = 16, least_tail = 24, channel_size = 4;

/// The storage of a block's bytes at one position.
enum Control : unsigned { small_groups = 0, large_groups = 1, zeros = 2, literal = 3 };
/// The bits of a group's differences, by its header.
constexpr std::array<std::array<int, 4>, 2> group_bits = {{{0, 1, 2, 4}, {1, 2, 4, 8}}};

/// The kind of differences in a channel.
enum ChannelMode : unsigned { of_bytes = 0, of_words = 1, of_bits = 2 };

std::size_t block_elements(std::size_t stride) {
    constexpr std::size_t most_bytes = 8192, most = 256;
    return std::min((most_bytes / stride) & ~(group_size - 1), most);
}

template <class T>
T zigzag(T v) {
    const bool negative = v >> (8 * sizeof(T) - 1);
    return static_cast<T>(negative ? ~(v << 1) : v << 1);
}
template <class T>
T unzigzag(T v) {
    return static_cast<T>(v & 1 ? ~(v >> 1) : v >> 1);
}

std::uint32_t rotated(std::uint32_t v, unsigned by) { return v << (by & 31) | v >> ((32 - by) & 31); }

/// The difference of four bytes between successive elements.
std::uint32_t difference(std::uint32_t from, std::uint32_t to, unsigned mode, unsigned rotation) {
    if (mode == of_bits) return rotated(from ^ to, rotation);
    std::uint32_t out = 0;
    const unsigned step = mode == of_bytes ? 8 : 16;
    for (unsigned at = 0; at < 32; at += step) {
        const std::uint32_t d = (to >> at) - (from >> at);
        const std::uint32_t part =
            mode == of_bytes ? zigzag(static_cast<std::uint8_t>(d)) : zigzag(static_cast<std::uint16_t>(d));
        out |= part << at;
    }
    return out;
}

std::uint32_t next_value(std::uint32_t from, std::uint32_t d, unsigned mode, unsigned rotation) {
    if (mode == of_bits) return from ^ rotated(d, 32 - rotation);
    std::uint32_t out = 0;
    const unsigned step = mode == of_bytes ? 8 : 16;
    for (unsigned at = 0; at < 32; at += step) {
        const std::uint32_t before = from >> at;
        const std::uint32_t part =
            mode == of_bytes
                ? static_cast<std::uint8_t>(before + unzigzag(static_cast<std::uint8_t>(d >> at)))
                : static_cast<std::uint16_t>(before + unzigzag(static_cast<std::uint16_t>(d >> at)));
        out |= part << at;
    }
    return out;
}

// --- encode

using Group = const std::uint8_t*; // a group has 16 differences

/// The size of a group with this many bits; larger differences follow as whole bytes.
std::size_t size_of_group(Group group, int bits) {
    if (bits == 0)
        return std::all_of(group, group + group_size, [](std::uint8_t d) { return d == 0; }) ? 0 : SIZE_MAX;
    if (bits == 8) return group_size;
    const int sentinel = (1 << bits) - 1;
    return group_size * static_cast<std::size_t>(bits) / 8 +
           static_cast<std::size_t>(
               std::count_if(group, group + group_size, [&](std::uint8_t d) { return d >= sentinel; }));
}

void put_group(Group group, int bits, Bytes& out) {
    if (bits == 0) return;
    if (bits == 8) {
        for (std::size_t i = 0; i < group_size; ++i) out.push_back(static_cast<std::byte>(group[i]));
        return;
    }
    const unsigned sentinel = (1u << bits) - 1;
    const std::size_t in_byte = 8 / static_cast<std::size_t>(bits);
    for (std::size_t i = 0; i < group_size; i += in_byte) {
        unsigned packed = 0;
        for (std::size_t k = 0; k < in_byte; ++k) {
            const std::size_t place = bits == 1 ? k : in_byte - 1 - k; // single bits start with the lowest
            packed |= std::min<unsigned>(group[i + k], sentinel) << (place * static_cast<std::size_t>(bits));
        }
        out.push_back(static_cast<std::byte>(packed));
    }
    for (std::size_t i = 0; i < group_size; ++i)
        if (group[i] >= sentinel) out.push_back(static_cast<std::byte>(group[i]));
}

/// The best header for a group, and its size.
std::pair<unsigned, std::size_t> best_header(Group group, unsigned control) {
    std::pair<unsigned, std::size_t> best{0, SIZE_MAX};
    for (unsigned h = 0; h < 4; ++h)
        if (const std::size_t size = size_of_group(group, group_bits[control][h]); size < best.second)
            best = {h, size};
    return best;
}

/// The differences at one byte position of a block: the count, and the bytes padded with zeros to whole
/// groups.
struct Plane {
    std::vector<std::uint8_t> differences;
    std::size_t count = 0;
};

std::size_t size_with(const Plane& plane, unsigned control) {
    if (control == literal) return plane.count;
    const auto& d = plane.differences;
    if (control == zeros)
        return std::all_of(d.begin(), d.end(), [](std::uint8_t x) { return x == 0; }) ? 0 : SIZE_MAX;
    const std::size_t groups = d.size() / group_size;
    std::size_t size = (groups + 3) / 4;
    for (std::size_t g = 0; g < groups; ++g) size += best_header(&d[g * group_size], control).second;
    return size;
}

std::pair<unsigned, std::size_t> best_control(const Plane& plane) {
    std::pair<unsigned, std::size_t> best{literal, SIZE_MAX};
    for (const unsigned control : {zeros, small_groups, large_groups, literal})
        if (const std::size_t size = size_with(plane, control); size < best.second) best = {control, size};
    return best;
}

void put_plane(const Plane& plane, unsigned control, Bytes& out) {
    const auto& d = plane.differences;
    if (control == zeros) return;
    if (control == literal) {
        for (std::size_t i = 0; i < plane.count; ++i) out.push_back(static_cast<std::byte>(d[i]));
        return;
    }
    const std::size_t groups = d.size() / group_size, headers = out.size();
    out.resize(out.size() + (groups + 3) / 4);
    for (std::size_t g = 0; g < groups; ++g) {
        const unsigned header = best_header(&d[g * group_size], control).first;
        out[headers + g / 4] |= static_cast<std::byte>(header << (2 * (g % 4)));
        put_group(&d[g * group_size], group_bits[control][header], out);
    }
}

std::uint32_t channel_at(Span bytes, std::size_t element, std::size_t stride, std::size_t channel) {
    std::uint32_t v = 0;
    for (std::size_t b = 0; b < channel_size; ++b)
        v |= std::to_integer<std::uint32_t>(bytes[element * stride + channel * channel_size + b]) << (8 * b);
    return v;
}

/// One channel of all elements: its bytes by block, with the controls of the four positions.
struct CodedChannel {
    unsigned mode = of_bytes; ///< includes the rotation, as in the stream's tail
    std::vector<std::array<unsigned, channel_size>> controls;
    std::vector<Bytes> blocks;
    std::size_t size = 0;
};

CodedChannel coded(Span bytes, std::size_t count, std::size_t stride, std::size_t channel, unsigned mode) {
    CodedChannel out;
    out.mode = mode;
    std::uint32_t before = count > 0 ? channel_at(bytes, 0, stride, channel) : 0;
    const std::size_t most = block_elements(stride);
    for (std::size_t begin = 0; begin < count; begin += most) {
        const std::size_t here = std::min(most, count - begin);
        std::array<Plane, channel_size> planes;
        for (Plane& plane : planes) {
            plane.count = here;
            plane.differences.resize((here + group_size - 1) / group_size * group_size);
        }
        for (std::size_t i = 0; i < here; ++i) {
            const std::uint32_t value = channel_at(bytes, begin + i, stride, channel);
            const std::uint32_t d = difference(before, value, mode & 15, mode >> 4);
            before = value;
            for (std::size_t b = 0; b < channel_size; ++b)
                planes[b].differences[i] = static_cast<std::uint8_t>(d >> (8 * b));
        }
        Bytes block;
        auto& controls = out.controls.emplace_back();
        for (std::size_t b = 0; b < channel_size; ++b) {
            controls[b] = best_control(planes[b]).first;
            put_plane(planes[b], controls[b], block);
        }
        out.size += block.size();
        out.blocks.push_back(std::move(block));
    }
    return out;
}

// --- decode

/// The unread part of a stream; `broken` after reading past its end.
struct Rest {
    Span bytes;
    bool broken = false;

    std::uint8_t next() {
        if (bytes.empty()) {
            broken = true;
            return 0;
        }
        const auto b = std::to_integer<std::uint8_t>(bytes.front());
        bytes = bytes.subspan(1);
        return b;
    }
};

void take_group(Rest& rest, int bits, std::uint8_t* out) {
    if (bits == 0) return;
    const unsigned sentinel = (1u << bits) - 1;
    const std::size_t in_byte = 8 / static_cast<std::size_t>(bits);
    for (std::size_t i = 0; i < group_size; i += in_byte) {
        const unsigned packed = rest.next();
        for (std::size_t k = 0; k < in_byte; ++k) {
            const std::size_t place = bits == 1 ? k : in_byte - 1 - k;
            out[i + k] =
                static_cast<std::uint8_t>(packed >> (place * static_cast<std::size_t>(bits)) & sentinel);
        }
    }
    for (std::size_t i = 0; i < group_size && bits < 8; ++i)
        if (out[i] == sentinel) out[i] = rest.next();
}

/// Reads count differences, and the padding of the last group.
std::vector<std::uint8_t> take_plane(Rest& rest, unsigned control, std::size_t count) {
    const std::size_t groups = (count + group_size - 1) / group_size;
    std::vector<std::uint8_t> out(groups * group_size);
    if (control == zeros) return out;
    if (control == literal) {
        for (std::size_t i = 0; i < count; ++i) out[i] = rest.next();
        return out;
    }
    std::vector<std::uint8_t> headers((groups + 3) / 4);
    for (std::uint8_t& h : headers) h = rest.next();
    for (std::size_t g = 0; g < groups && !rest.broken; ++g)
        take_group(rest, group_bits[control][headers[g / 4] >> (2 * (g % 4)) & 3], &out[g * group_size]);
    return out;
}

/// Decodes a block. `before` is the previous element, and becomes the block's last element.
void take_block(Rest& rest, Span modes, std::size_t count, std::vector<std::uint32_t>& before,
                std::byte* out) {
    const std::size_t channels = modes.size(), stride = channels * channel_size;
    std::vector<std::uint8_t> controls(channels);
    for (std::uint8_t& c : controls) c = rest.next();
    for (std::size_t channel = 0; channel < channels && !rest.broken; ++channel) {
        std::array<std::vector<std::uint8_t>, channel_size> planes;
        for (std::size_t b = 0; b < channel_size; ++b)
            planes[b] = take_plane(rest, controls[channel] >> (2 * b) & 3, count);
        const auto mode = std::to_integer<unsigned>(modes[channel]);
        for (std::size_t i = 0; i < count; ++i) {
            std::uint32_t d = 0;
            for (std::size_t b = 0; b < channel_size; ++b) d |= std::uint32_t{planes[b][i]} << (8 * b);
            before[channel] = next_value(before[channel], d, mode & 15, mode >> 4);
            for (std::size_t b = 0; b < channel_size; ++b)
                out[i * stride + channel * channel_size + b] =
                    static_cast<std::byte>(before[channel] >> (8 * b));
        }
    }
}

std::size_t tail_size(std::size_t stride) { return std::max(least_tail, stride + stride / channel_size); }

} // namespace

bool is_attribute_stream_1(Span stream) { return !stream.empty() && stream[0] == header_1; }

std::size_t most_elements_in_stream(std::size_t bytes, std::size_t stride) {
    // A block has at least its control bytes.
    return (bytes / (stride / channel_size) + 1) * block_elements(stride);
}

Bytes encode_attribute_stream(Span bytes, std::size_t count, std::size_t stride) {
    const std::size_t channels = stride / channel_size;
    std::vector<CodedChannel> best(channels);
    parallel_for(
        channels,
        [&](std::size_t c) {
            best[c] = coded(bytes, count, stride, c, of_bytes);
            constexpr unsigned sign_last = of_bits | 1 << 4; // useful for floats that change their sign often
            for (const unsigned mode : {unsigned{of_words}, unsigned{of_bits}, sign_last})
                if (auto other = coded(bytes, count, stride, c, mode); other.size < best[c].size)
                    best[c] = std::move(other);
        },
        1);
    Bytes out{header_1};
    const std::size_t blocks = channels > 0 ? best[0].blocks.size() : 0;
    for (std::size_t b = 0; b < blocks; ++b) {
        for (const CodedChannel& channel : best) {
            unsigned packed = 0;
            for (std::size_t k = 0; k < channel_size; ++k) packed |= channel.controls[b][k] << (2 * k);
            out.push_back(static_cast<std::byte>(packed));
        }
        for (const CodedChannel& channel : best)
            out.insert(out.end(), channel.blocks[b].begin(), channel.blocks[b].end());
    }
    out.resize(out.size() + tail_size(stride) - stride - channels);
    if (count > 0)
        out.insert(out.end(), bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(stride));
    else
        out.resize(out.size() + stride);
    for (const CodedChannel& channel : best) out.push_back(static_cast<std::byte>(channel.mode));
    return out;
}

std::optional<Bytes> decode_attribute_stream(Span stream, std::size_t count, std::size_t stride) {
    const std::size_t channels = stride / channel_size, tail = tail_size(stride);
    if (!is_attribute_stream_1(stream) || stream.size() < 1 + tail) return {};
    const Span modes = stream.last(channels);
    const Span baseline = stream.last(channels + stride).first(stride);
    for (const std::byte m : modes) {
        const auto mode = std::to_integer<unsigned>(m);
        if ((mode & 15) > of_bits || ((mode & 15) != of_bits && mode >> 4 != 0)) return {};
    }
    std::vector<std::uint32_t> before(channels);
    for (std::size_t c = 0; c < channels; ++c) before[c] = channel_at(baseline, 0, stride, c);
    Rest rest{stream.subspan(1).first(stream.size() - 1 - tail)};
    Bytes out(count * stride);
    const std::size_t most = block_elements(stride);
    for (std::size_t begin = 0; begin < count && !rest.broken; begin += most)
        take_block(rest, modes, std::min(most, count - begin), before, out.data() + begin * stride);
    if (rest.broken || !rest.bytes.empty()) return {};
    return out;
}

} // namespace facetmill::io::gltf
