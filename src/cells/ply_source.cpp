#include "cells/ply_source.hpp"

#include "cells/stream.hpp"
#include "io/ply/ply.hpp"
#include "io/text.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <fmt/format.h>

namespace facetmill::cells {

namespace {

namespace ply = io::ply;

/// A triangle's record: its vertices' numbers.
using Corners = std::array<std::uint32_t, 3>;

template <class T>
T number_at(const std::byte* at, bool swap) {
    std::array<std::byte, sizeof(T)> raw;
    std::memcpy(raw.data(), at, sizeof(T));
    if (swap) std::reverse(raw.begin(), raw.end());
    return std::bit_cast<T>(raw);
}

double value_at(const std::byte* at, ply::Type type, bool swap) {
    switch (type) {
    case ply::Type::float32:
        return static_cast<double>(number_at<float>(at, swap));
    case ply::Type::float64:
        return number_at<double>(at, swap);
    case ply::Type::uint8:
        return number_at<std::uint8_t>(at, swap);
    case ply::Type::int8:
        return number_at<std::int8_t>(at, swap);
    case ply::Type::uint16:
        return number_at<std::uint16_t>(at, swap);
    case ply::Type::int16:
        return number_at<std::int16_t>(at, swap);
    case ply::Type::uint32:
        return number_at<std::uint32_t>(at, swap);
    case ply::Type::int32:
        break;
    }
    return number_at<std::int32_t>(at, swap);
}

bool is_index_list(const ply::Property& p) {
    return p.list && (p.name == "vertex_indices" || p.name == "vertex_index");
}

std::size_t scalars_size(const ply::Element& e) {
    std::size_t size = 0;
    for (const auto& p : e.properties) size += ply::size_of(p.type);
    return size;
}

bool has_list(const ply::Element& e) {
    return std::any_of(e.properties.begin(), e.properties.end(), [](const auto& p) { return p.list; });
}

class PlySource final : public FaceSource {
  public:
    PlySource(io::Input opened, const io::ReadSettings& settings)
        : FaceSource(std::move(opened)), settings_(settings), header_(ply::read_header(input())),
          file_(input().path()), swap_(header_.encoding == ply::Encoding::big_endian) {
        std::uint64_t at = header_.size;
        for (const auto& e : header_.elements) {
            if (e.name == "vertex") {
                vertices_ = &e;
                vertices_at_ = at;
                stride_ = scalars_size(e);
            }
            if (e.name == "face") {
                faces_ = &e;
                faces_at_ = at;
                break;
            }
            if (e.count > bytes() / std::max<std::size_t>(1, scalars_size(e))) ends_in(e, 0);
            at += e.count * scalars_size(e);
        }
        if (at > bytes()) ends_in(*vertices_, (bytes() - vertices_at_) / stride_);
        find_coordinates();
        for (const auto& p : faces_->properties)
            if (!p.list) drop(fmt::format("'{}' of faces", p.name));
        scan();
    }

    std::size_t record_size() const override { return sizeof(Corners); }

    void each(const Take& take, std::size_t memory) override {
        RecordCache vertices(file_, vertices_at_, stride_, vertices_->count, memory);
        Stream faces(file_, faces_at_, bytes());
        std::vector<std::uint32_t> corners;
        forget_skipped_faces();
        for (std::uint64_t f = 0; f < faces_->count; ++f) {
            read_face(faces, f, corners);
            if (corners.size() < 3)
                add_skipped_face();
            else if (corners.size() == 3)
                give({corners[0], corners[1], corners[2]}, vertices, take);
            else
                give_polygon(corners, vertices, take);
        }
    }

    Piece piece(io::Span records) const override {
        const std::size_t n = records.size() / sizeof(Corners);
        std::vector<std::uint32_t> numbers = numbers_of(records);
        io::Bytes bytes = header_of(numbers.size(), n);
        const io::Bytes rows = read_records(file_, vertices_at_, stride_, numbers);
        bytes.insert(bytes.end(), rows.begin(), rows.end());
        for (std::size_t i = 0; i < 3 * n; ++i) {
            std::uint32_t number = 0;
            std::memcpy(&number, records.data() + i * sizeof number, sizeof number);
            const auto at = std::lower_bound(numbers.begin(), numbers.end(), number);
            auto raw =
                std::bit_cast<std::array<std::byte, 4>>(static_cast<std::uint32_t>(at - numbers.begin()));
            if (swap_) std::reverse(raw.begin(), raw.end());
            if (i % 3 == 0) bytes.push_back(std::byte{3});
            bytes.insert(bytes.end(), raw.begin(), raw.end());
        }
        io::ReadLog log;
        Scene scene = io::read_scene(io::Input::of(input().name(), std::move(bytes)), settings_, log,
                                     io::codec_named("ply"));
        return {std::move(scene.parts.front().mesh), {numbers.begin(), numbers.end()}};
    }

    std::vector<std::uint64_t> keys(io::Span records) const override {
        const auto numbers = numbers_of(records);
        return {numbers.begin(), numbers.end()};
    }
    std::uint64_t key(const Piece& piece, Index vertex) const override { return piece.names[vertex]; }

  private:
    [[noreturn]] void ends_in(const ply::Element& e, std::uint64_t record) const {
        io::malformed(input().name(), 0, "E-PLY",
                      fmt::format("the file ends in element '{}', {} of {}, at byte {}", e.name, record,
                                  e.count, bytes()));
    }

    void find_coordinates() {
        std::size_t offset = 0, found = 0;
        for (const auto& p : vertices_->properties) {
            for (std::size_t axis = 0; axis < 3; ++axis)
                if (p.name == std::string(1, "xyz"[axis])) {
                    offset_[axis] = offset;
                    type_[axis] = p.type;
                    ++found;
                }
            offset += ply::size_of(p.type);
        }
        if (found != 3)
            io::malformed(input().name(), vertices_->line, "E-PLY",
                          "element 'vertex' lacks one of the properties x, y and z");
    }

    Vec3 position(const std::byte* row) const {
        Vec3 p;
        for (std::size_t axis = 0; axis < 3; ++axis)
            p[axis] = value_at(row + offset_[axis], type_[axis], swap_);
        return p;
    }

    /// The whole file once.
    void scan() {
        Sha256 sum;
        Stream all(file_, 0, bytes(), &sum);
        for (std::uint64_t skip = vertices_at_; skip > 0;) {
            const std::size_t n = static_cast<std::size_t>(std::min<std::uint64_t>(skip, 1 << 16));
            all.take(n);
            skip -= n;
        }
        for (std::uint64_t v = 0; v < vertices_->count; ++v) {
            const Vec3 p = position(all.take(stride_));
            if (!is_finite(p))
                io::malformed(
                    input().name(), 0, "E-NAN",
                    fmt::format("vertex {} is at ({}, {}, {}), expected finite numbers", v, p.x, p.y, p.z));
            own_contents().bounds.add(p);
        }
        while (all.left() > 0)
            all.take(static_cast<std::size_t>(std::min<std::uint64_t>(all.left(), 1 << 16)));
        own_contents().vertices = vertices_->count;
        own_contents().sha256 = sum.digest();
    }

    void read_face(Stream& faces, std::uint64_t f, std::vector<std::uint32_t>& corners) const {
        for (const auto& p : faces_->properties) {
            const auto take = [&](std::uint64_t n) {
                if (n > faces.left()) ends_in(*faces_, f);
                return faces.take(static_cast<std::size_t>(n));
            };
            if (!p.list) {
                take(ply::size_of(p.type));
                continue;
            }
            const double count = value_at(take(ply::size_of(p.count_type)), p.count_type, swap_);
            if (count < 0) ends_in(*faces_, f);
            const std::size_t size = ply::size_of(p.type);
            const std::byte* at = take(static_cast<std::uint64_t>(count) * size);
            corners.resize(static_cast<std::size_t>(count));
            for (std::uint32_t& corner : corners) {
                const double number = value_at(at, p.type, swap_);
                if (!(number >= 0 && number < static_cast<double>(vertices_->count)))
                    io::malformed(input().name(), faces_->line, "E-PLY",
                                  fmt::format("face {} of {} names vertex {}, there are {}", f, faces_->count,
                                              number, vertices_->count));
                corner = static_cast<std::uint32_t>(number);
                at += size;
            }
        }
    }

    void give(const Corners& corners, RecordCache& vertices, const Take& take) const {
        Vec3 sum;
        for (const std::uint32_t corner : corners) sum = sum + position(vertices.at(corner)) / 3;
        take(sum, std::as_bytes(std::span(corners)));
    }

    /// As the same file read whole is triangulated.
    void give_polygon(const std::vector<std::uint32_t>& corners, RecordCache& vertices,
                      const Take& take) const {
        Mesh polygon;
        std::vector<Index> wedges;
        for (const std::uint32_t corner : corners) {
            wedges.push_back(static_cast<Index>(polygon.positions.size()));
            polygon.positions.push_back(position(vertices.at(corner)));
        }
        add_face(polygon, wedges);
        polygon = triangulated(polygon);
        for (std::size_t c = 0; c + 2 < polygon.corners.size(); c += 3)
            give({corners[polygon.corners[c]], corners[polygon.corners[c + 1]],
                  corners[polygon.corners[c + 2]]},
                 vertices, take);
    }

    /// Each vertex once, ascending.
    static std::vector<std::uint32_t> numbers_of(io::Span records) {
        std::vector<std::uint32_t> numbers(records.size() / sizeof(std::uint32_t));
        if (numbers.empty()) return numbers;
        std::memcpy(numbers.data(), records.data(), numbers.size() * sizeof(std::uint32_t));
        std::sort(numbers.begin(), numbers.end());
        numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
        return numbers;
    }

    /// Of a file of some of the vertices and faces.
    io::Bytes header_of(std::size_t vertices, std::size_t faces) const {
        static constexpr const char* types[] = {"float",  "double", "uchar", "char",
                                                "ushort", "short",  "uint",  "int"};
        std::string text = fmt::format("ply\nformat binary_{}_endian 1.0\nelement vertex {}\n",
                                       swap_ ? "big" : "little", vertices);
        for (const auto& p : vertices_->properties)
            text += fmt::format("property {} {}\n", types[static_cast<std::size_t>(p.type)], p.name);
        text += fmt::format("element face {}\nproperty list uchar uint vertex_indices\nend_header\n", faces);
        const auto bytes = std::as_bytes(std::span(text));
        return {bytes.begin(), bytes.end()};
    }

    io::ReadSettings settings_;
    ply::Header header_;
    ReadFile file_;
    bool swap_;
    const ply::Element *vertices_ = nullptr, *faces_ = nullptr;
    std::uint64_t vertices_at_ = 0, faces_at_ = 0;
    std::size_t stride_ = 0;
    std::array<std::size_t, 3> offset_{};
    std::array<ply::Type, 3> type_{};
};

} // namespace

std::optional<std::string> why_ply_not_streamed(const io::Input& input) {
    const ply::Header header = ply::read_header(input);
    if (header.encoding == ply::Encoding::ascii) return "it is text, and only binary PLY is";
    const ply::Element *vertices = nullptr, *faces = nullptr;
    for (const auto& e : header.elements) {
        if (e.name == "tristrips") return "it has triangle strips";
        if (e.name == "vertex") vertices = &e;
        if (e.name == "face") faces = &e;
        if (e.name == "face" && !vertices) return "its faces stand before its vertices";
        if (!faces && has_list(e)) return fmt::format("its element '{}' has lists", e.name);
    }
    if (!vertices || !faces || vertices->count == 0 || faces->count == 0) return "it has no faces";
    if (vertices->count >= none) return "it has more than 4294967294 vertices";
    if (!header.textures.empty()) return "it has textures";
    std::size_t lists = 0;
    for (const auto& p : faces->properties) {
        if (!p.list) continue;
        if (!is_index_list(p)) return fmt::format("its faces have the list '{}'", p.name);
        ++lists;
    }
    return lists == 1 ? std::nullopt : std::optional<std::string>("its faces have no list 'vertex_indices'");
}

std::uint64_t ply_faces(const io::Input& input) {
    for (const auto& e : ply::read_header(input).elements)
        if (e.name == "face") return e.count;
    return 0;
}

std::unique_ptr<FaceSource> open_ply(io::Input input, const io::ReadSettings& settings) {
    return std::make_unique<PlySource>(std::move(input), settings);
}

} // namespace facetmill::cells
