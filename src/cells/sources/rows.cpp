#include "cells/sources/rows.hpp"

#include "base/sort_unique.hpp"
#include "cells/sources/pieces.hpp"
#include "cells/sources/unite.hpp"
#include "cells/storage/packed_numbers.hpp"
#include "io/text.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <fmt/format.h>
#include <numeric>
#include <utility>

namespace facetmill::cells {

namespace ply = io::ply;

namespace {

constexpr std::uint64_t usual_corners = 3; // a packed face stores its count as the difference from this

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

} // namespace

std::size_t row_size(const std::vector<ply::Property>& properties) {
    std::size_t size = 0;
    for (const auto& p : properties) size += ply::size_of(p.type);
    return size;
}

void ends_in(const std::string& file, std::uint64_t bytes, const std::string& element, std::uint64_t item,
             std::uint64_t count) {
    io::malformed(
        file, 0, "E-PLY",
        fmt::format("the file ends in element '{}', {} of {}, at byte {}", element, item, count, bytes));
}

Coordinates::Coordinates(const Rows& rows, const std::string& file) : swap_(rows.swap) {
    std::size_t offset = 0, found = 0;
    for (const auto& p : rows.vertex) {
        for (std::size_t axis = 0; axis < 3; ++axis)
            if (p.name == std::string(1, "xyz"[axis])) {
                offset_[axis] = offset;
                type_[axis] = p.type;
                ++found;
            }
        offset += ply::size_of(p.type);
    }
    if (found != 3)
        io::malformed(file, rows.vertex_line, "E-PLY",
                      "element 'vertex' lacks one of the properties x, y and z");
}

Vec3 Coordinates::of(const std::byte* row) const {
    Vec3 p;
    for (std::size_t axis = 0; axis < 3; ++axis) p[axis] = value_at(row + offset_[axis], type_[axis], swap_);
    return p;
}

Vec3 finite_place(const Coordinates& coordinates, const std::byte* row, std::uint64_t number,
                  const std::string& file) {
    const Vec3 p = coordinates.of(row);
    if (!is_finite(p))
        io::malformed(
            file, 0, "E-NAN",
            fmt::format("vertex {} is at ({}, {}, {}), expected finite numbers", number, p.x, p.y, p.z),
            not_finite_hint);
    return p;
}

void read_face(const Rows& rows, const std::string& file, std::uint64_t number, Stream& faces,
               std::vector<std::uint32_t>& corners) {
    const auto take = [&](std::uint64_t n) {
        if (n > faces.left()) ends_in(file, rows.faces_end, "face", number, rows.face_count);
        return faces.take(static_cast<std::size_t>(n));
    };
    for (const auto& p : rows.face) {
        if (!p.list) {
            take(ply::size_of(p.type));
            continue;
        }
        const double count = value_at(take(ply::size_of(p.count_type)), p.count_type, rows.swap);
        if (count < 0) ends_in(file, rows.faces_end, "face", number, rows.face_count);
        const std::size_t size = ply::size_of(p.type);
        const std::byte* at = take(static_cast<std::uint64_t>(count) * size);
        corners.resize(static_cast<std::size_t>(count));
        for (std::uint32_t& corner : corners) {
            const double vertex = value_at(at, p.type, rows.swap);
            if (!(vertex >= 0 && vertex < static_cast<double>(rows.vertex_count)))
                io::malformed(file, rows.face_line, "E-PLY",
                              fmt::format("face {} of {} refers to vertex {}, but the file has {}", number,
                                          rows.face_count, vertex, rows.vertex_count));
            corner = static_cast<std::uint32_t>(vertex);
            at += size;
        }
    }
}

RowWriter::RowWriter(const std::filesystem::path& scratch, std::vector<ply::Property> extra,
                     ply::Type coordinate)
    : extra_(std::move(extra)), extra_size_(row_size(extra_)), single_(coordinate == ply::Type::float32),
      vertices_(scratch), faces_(scratch) {
    for (const char* name : {"x", "y", "z"}) rows_.vertex.push_back({name, coordinate});
    rows_.vertex.insert(rows_.vertex.end(), extra_.begin(), extra_.end());
    rows_.packed = scratch;
    rows_.swap = std::endian::native == std::endian::big;
}

void RowWriter::begin_group(Identity identity, bool by_use) {
    if (!rows_.groups.empty() && rows_.groups.back().first == rows_.vertex_count) rows_.groups.pop_back();
    rows_.groups.push_back({rows_.vertex_count, identity, by_use});
}

void RowWriter::vertex(const Vec3& p, io::Span extra) {
    if (rows_.vertex_count + 1 >= none)
        throw Error(ErrorKind::limit, "E-SIZE",
                    fmt::format("facetmill supports at most {} vertices", none - 1),
                    "write it as binary PLY or STL in several files, and process each");
    if (single_) {
        const std::array place{static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
        vertices_.append(std::as_bytes(std::span(place)));
    } else {
        const std::array place{p.x, p.y, p.z};
        vertices_.append(std::as_bytes(std::span(place)));
    }
    vertices_.append(extra.first(std::min(extra.size(), extra_size_)));
    bounds_.add(p);
    ++rows_.vertex_count;
}

void RowWriter::face(std::span<const std::uint32_t> corners) {
    if (corners.size() < 3) {
        ++short_faces_;
        return;
    }
    packed_.clear();
    const auto put = [&](std::byte byte) { packed_.push_back(byte); };
    put_difference(usual_corners, corners.size(), put);
    for (const std::uint32_t corner : corners)
        put_difference(std::exchange(last_corner_, corner), corner, put);
    faces_.append(packed_);
    rows_.faces_end += packed_.size();
    ++rows_.face_count;
}

namespace {

/// Reads a face packed by RowWriter. last: the previous corner, 0 at first. Throws an output error
/// (E-SCRATCH).
void read_packed_face(const Rows& rows, Stream& faces, std::uint32_t& last,
                      std::vector<std::uint32_t>& corners) {
    const auto next = [&] {
        if (faces.left() == 0) unreadable_scratch(*rows.packed);
        return *faces.take(1);
    };
    const std::uint64_t n = take_difference(usual_corners, next);
    if (n > faces.left()) unreadable_scratch(*rows.packed);
    corners.resize(static_cast<std::size_t>(n));
    for (std::uint32_t& corner : corners) {
        const std::uint64_t number = take_difference(last, next);
        if (number >= rows.vertex_count) unreadable_scratch(*rows.packed);
        corner = last = static_cast<std::uint32_t>(number);
    }
}

} // namespace

Rows RowWriter::finish() {
    rows_.vertices = vertices_.finish();
    rows_.faces = faces_.finish();
    return std::move(rows_);
}

namespace {

/// A triangle's record: the numbers of its rows.
using Corners = std::array<std::uint32_t, 3>;

/// The distinct rows of some corners.
struct Ranks {
    std::vector<std::uint32_t> numbers; ///< distinct row numbers, ascending
    std::vector<Index> of;              ///< [corners] index in numbers
};

Ranks ranks_of(io::Span records) {
    constexpr int place_bits = 32;
    std::vector<std::uint32_t> corners(records.size() / sizeof(std::uint32_t));
    if (!corners.empty()) std::memcpy(corners.data(), records.data(), corners.size() * sizeof(std::uint32_t));
    std::vector<std::uint64_t> sorted(corners.size());
    std::uint32_t largest = 0;
    for (std::size_t c = 0; c < corners.size(); ++c) {
        sorted[c] = std::uint64_t{corners[c]} << place_bits | c;
        largest = std::max(largest, corners[c]);
    }
    radix_sort(
        sorted, [](std::uint64_t s) { return s >> place_bits; }, static_cast<int>(std::bit_width(largest)));
    Ranks ranks;
    ranks.of.resize(corners.size());
    for (const std::uint64_t s : sorted) {
        const auto number = static_cast<std::uint32_t>(s >> place_bits);
        if (ranks.numbers.empty() || ranks.numbers.back() != number) ranks.numbers.push_back(number);
        ranks.of[static_cast<std::uint32_t>(s)] = static_cast<Index>(ranks.numbers.size() - 1);
    }
    return ranks;
}

/// Distinct row numbers, ascending.
std::vector<std::uint32_t> numbers_of(io::Span records) { return ranks_of(records).numbers; }

class RowSource final : public FaceSource {
  public:
    RowSource(Rows rows, Contents contents, const io::ReadSettings& settings)
        : FaceSource(std::move(contents)), rows_(std::move(rows)), settings_(settings),
          coordinates_(rows_, name()), stride_(row_size(rows_.vertex)),
          is_file_(this->contents().files.front().sha256.empty()) {
        settings_.weld = io::Weld::off;
        for (const auto& group : rows_.groups) {
            by_place_ |= group.identity != Identity::number;
            by_use_ |= group.by_use;
        }
        if (!by_place_) own_contents().vertices = rows_.vertex_count;
    }

    std::size_t record_size() const override { return sizeof(Corners); }

    void scan(std::size_t memory) override {
        if (!is_file_ || scanned_) return;
        auto sum = std::make_unique<Sha256>();
        auto vertices = cache_of(memory);
        const bool held = vertices->holds_all();
        Box bounds;
        Stream head(*rows_.vertices, 0, rows_.faces_at, sum.get());
        head.skip(rows_.vertices_at);
        for (std::uint64_t v = 0; v < rows_.vertex_count; ++v) {
            const std::byte* const row = head.take(stride_);
            bounds.add(finite_place(coordinates_, row, v, name()));
            if (held) vertices->append(row);
        }
        head.skip(head.left());
        own_contents().bounds = bounds;
        scanned_ = true;
        begun_ = std::move(sum);
        if (held) held_ = std::move(vertices);
    }

    void finish_digests() override {
        std::string& digest = own_contents().files.front().sha256;
        if (!digest.empty()) return;
        std::unique_ptr<Sha256> sum = std::move(begun_);
        const std::uint64_t from = sum ? rows_.faces_at : 0;
        if (!sum) sum = std::make_unique<Sha256>();
        Stream rest(*rows_.faces, from, rows_.faces_end, sum.get());
        rest.skip(rest.left());
        digest = sum->digest();
    }

    void each(const Take& take, std::size_t memory) override {
        const auto vertices = held_ ? std::move(held_) : cache_of(memory);
        each_triangle(*vertices, [&](const Corners& corners) {
            Vec3 sum;
            for (const std::uint32_t corner : corners) sum = sum + coordinates_.of(vertices->at(corner)) / 3;
            take(sum, std::as_bytes(std::span(corners)));
        });
    }

    void each_record(const TakeRecord& take, std::size_t memory) override {
        each_triangle(*cache_of(memory),
                      [&](const Corners& corners) { take(std::as_bytes(std::span(corners))); });
    }

    std::uint64_t vertex_numbers() const override { return by_place_ ? 0 : rows_.vertex_count; }

    Piece piece(io::Span records) const override {
        const Ranks ranks = ranks_of(records);
        const auto& numbers = ranks.numbers;
        const io::Bytes rows = read_records(*rows_.vertices, rows_.vertices_at, stride_, numbers);
        Piece piece{has_places_only() ? mesh_of_places(rows, ranks) : mesh_of_rows(rows, ranks),
                    {numbers.begin(), numbers.end()}};
        if (by_use_) put_in_order_of_use(piece);
        if (!by_place_) return piece;
        for (std::size_t v = 0; v < numbers.size(); ++v)
            piece.names[v] = name_of(static_cast<std::uint32_t>(piece.names[v]), piece.mesh.positions[v]);
        std::vector<Index> all(piece.mesh.vertex_count());
        std::iota(all.begin(), all.end(), Index{0});
        unite(piece.mesh, piece.names, std::move(all));
        return piece;
    }

    std::vector<std::uint64_t> names(io::Span records) const override {
        const auto numbers = numbers_of(records);
        std::vector<std::uint64_t> names(numbers.begin(), numbers.end());
        if (!by_place_) return names;
        const io::Bytes rows = read_records(*rows_.vertices, rows_.vertices_at, stride_, numbers);
        for (std::size_t i = 0; i < names.size(); ++i)
            names[i] = name_of(numbers[i], coordinates_.of(rows.data() + i * stride_));
        sort_unique(names);
        return names;
    }

  private:
    Rows::Group group_of(std::uint64_t number) const {
        const auto after =
            std::upper_bound(rows_.groups.begin(), rows_.groups.end(), number,
                             [](std::uint64_t n, const Rows::Group& g) { return n < g.first; });
        return after == rows_.groups.begin() ? Rows::Group{} : *std::prev(after);
    }

    std::uint64_t name_of(std::uint32_t number, const Vec3& p) const {
        const Rows::Group group = group_of(number);
        if (group.identity == Identity::number) return number;
        return name_of_place(p, group.identity == Identity::place ? 0 : group.first);
    }

    /// Orders vertices by first use if their groups require it. Names equal the row numbers.
    void put_in_order_of_use(Piece& piece) const {
        const auto corners = static_cast<Index>(piece.mesh.corners.size());
        std::vector<Index> first(piece.names.size(), none), order(first.size()), place(first.size());
        for (Index c = 0; c < corners; ++c)
            first[piece.mesh.corners[c]] = std::min(first[piece.mesh.corners[c]], c);
        std::vector<std::pair<std::uint64_t, Index>> keys(first.size());
        for (std::size_t v = 0; v < keys.size(); ++v) {
            const Rows::Group group = group_of(piece.names[v]);
            keys[v] = {group.by_use ? group.first : piece.names[v], first[v]};
        }
        std::iota(order.begin(), order.end(), Index{0});
        std::sort(order.begin(), order.end(), [&](Index a, Index b) { return keys[a] < keys[b]; });
        const Piece old = piece;
        for (Index v = 0; v < order.size(); ++v) {
            place[order[v]] = v;
            piece.names[v] = old.names[order[v]];
            piece.mesh.positions[v] = old.mesh.positions[order[v]];
        }
        for (Attribute& a : piece.mesh.attributes)
            if (a.domain != Domain::face) a.select(order);
        for (Index& corner : piece.mesh.corners) corner = place[corner];
    }

    std::unique_ptr<RecordCache> cache_of(std::size_t memory) const {
        return std::make_unique<RecordCache>(*rows_.vertices, rows_.vertices_at, stride_, rows_.vertex_count,
                                             memory);
    }

    /// Calls give(corners) for each triangle. vertices: for triangulating polygons.
    template <class Give>
    void each_triangle(RecordCache& vertices, Give&& give) {
        const std::unique_ptr<Sha256> sum = std::move(begun_);
        Stream faces(*rows_.faces, rows_.faces_at, rows_.faces_end, sum.get());
        std::vector<std::uint32_t> corners;
        std::uint64_t skipped = 0;
        std::uint32_t last = 0;
        for (std::uint64_t f = 0; f < rows_.face_count; ++f) {
            if (rows_.packed)
                read_packed_face(rows_, faces, last, corners);
            else
                read_face(rows_, name(), f, faces, corners);
            if (corners.size() < 3)
                ++skipped;
            else if (corners.size() == 3)
                give(Corners{corners[0], corners[1], corners[2]});
            else
                give_polygon(corners, vertices, give);
        }
        if (skipped > 0) own_contents().skipped_faces = skipped;
        if (!sum) return;
        faces.skip(faces.left());
        own_contents().files.front().sha256 = sum->digest();
    }

    /// Triangulates like reading the whole file.
    template <class Give>
    void give_polygon(const std::vector<std::uint32_t>& corners, RecordCache& vertices, Give&& give) const {
        Mesh polygon;
        std::vector<Index> wedges;
        for (const std::uint32_t corner : corners) {
            wedges.push_back(static_cast<Index>(polygon.positions.size()));
            polygon.positions.push_back(coordinates_.of(vertices.at(corner)));
        }
        add_face(polygon, wedges);
        polygon = triangulated(polygon);
        for (std::size_t c = 0; c + 2 < polygon.corners.size(); c += 3)
            give(Corners{corners[polygon.corners[c]], corners[polygon.corners[c + 1]],
                         corners[polygon.corners[c + 2]]});
    }

    /// Whether rows hold only positions.
    bool has_places_only() const {
        constexpr std::array<const char*, 3> axes{"x", "y", "z"};
        return rows_.vertex.size() == axes.size() &&
               std::all_of(axes.begin(), axes.end(), [&](const char* axis) {
                   return std::any_of(rows_.vertex.begin(), rows_.vertex.end(),
                                      [&](const ply::Property& p) { return p.name == axis; });
               });
    }

    Mesh mesh_of_places(io::Span rows, const Ranks& ranks) const {
        Mesh mesh;
        mesh.positions.reserve(ranks.numbers.size());
        for (std::size_t v = 0; v < ranks.numbers.size(); ++v)
            mesh.positions.push_back(coordinates_.of(rows.data() + v * stride_));
        mesh.corners = ranks.of;
        return mesh;
    }

    /// A mesh with the attributes that a file of these rows would give.
    Mesh mesh_of_rows(io::Span rows, const Ranks& ranks) const {
        io::Bytes bytes = header_of(ranks.numbers.size(), ranks.of.size() / 3);
        bytes.insert(bytes.end(), rows.begin(), rows.end());
        for (std::size_t i = 0; i < ranks.of.size(); ++i) {
            auto raw = std::bit_cast<std::array<std::byte, 4>>(ranks.of[i]);
            if (rows_.swap) std::reverse(raw.begin(), raw.end());
            if (i % 3 == 0) bytes.push_back(std::byte{3});
            bytes.insert(bytes.end(), raw.begin(), raw.end());
        }
        io::ReadLog log;
        Scene scene =
            io::read_scene(io::Input::of(name(), std::move(bytes)), settings_, log, io::codec_named("ply"));
        return std::move(scene.parts.front().mesh);
    }

    /// The header of a file with some of the vertices and faces.
    io::Bytes header_of(std::size_t vertices, std::size_t faces) const {
        static constexpr const char* types[] = {"float",  "double", "uchar", "char",
                                                "ushort", "short",  "uint",  "int"};
        const bool big = rows_.swap == (std::endian::native == std::endian::little);
        std::string text = fmt::format("ply\nformat binary_{}_endian 1.0\nelement vertex {}\n",
                                       big ? "big" : "little", vertices);
        for (const auto& p : rows_.vertex)
            text += fmt::format("property {} {}\n", types[static_cast<std::size_t>(p.type)], p.name);
        text += fmt::format("element face {}\nproperty list uchar uint vertex_indices\nend_header\n", faces);
        const auto bytes = std::as_bytes(std::span(text));
        return {bytes.begin(), bytes.end()};
    }

    Rows rows_;
    io::ReadSettings settings_;
    Coordinates coordinates_;
    std::size_t stride_;
    bool is_file_;                      ///< the rows are the first file, which is hashed during reading
    bool scanned_ = false;              ///< set by scan()
    std::unique_ptr<Sha256> begun_;     ///< after scan(): digest state of the file before its faces
    std::unique_ptr<RecordCache> held_; ///< after scan(): the vertices, if all fit
    bool by_place_ = false;             ///< some vertices are identified by position
    bool by_use_ = false;               ///< some groups use the order of first use
};

} // namespace

std::unique_ptr<FaceSource> source_of(Rows rows, FaceSource::Contents contents,
                                      const io::ReadSettings& settings) {
    return std::make_unique<RowSource>(std::move(rows), std::move(contents), settings);
}

} // namespace facetmill::cells
