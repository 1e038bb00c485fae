#include "cells/stl_source.hpp"

#include "base/random.hpp"
#include "cells/stream.hpp"
#include "io/stl/stl.hpp"
#include "io/text.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <fmt/format.h>

namespace facetmill::cells {

namespace {

constexpr std::size_t stl_head = 84, stl_record = 50, normal_size = 12;

using Point = std::array<float, 3>;

std::uint64_t key_of(const Point& p) {
    std::uint64_t key = 0;
    for (const float x : p) key = hashed(key, std::bit_cast<std::uint32_t>(x + 0.0F)); // -0 is 0
    return key;
}

class StlSource final : public FaceSource {
  public:
    StlSource(io::Input opened, const io::ReadSettings& settings)
        : FaceSource(std::move(opened)), settings_(settings), file_(input().path()) {
        count_ = static_cast<std::uint32_t>(stl_faces(input()));
        const std::uint64_t held = (bytes() - stl_head) / stl_record;
        if (count_ > held)
            io::malformed(input().name(), 0, "E-STL",
                          fmt::format("the file is to have {} triangles and ends in triangle {}, at byte {}",
                                      count_, held, bytes()));
        scan();
    }

    std::size_t record_size() const override { return stl_record; }

    void each(const Take& take, std::size_t) override {
        Stream faces(file_, stl_head, stl_head + std::uint64_t{count_} * stl_record);
        for (std::uint32_t f = 0; f < count_; ++f) {
            const std::byte* const record = faces.take(stl_record);
            Vec3 centre;
            for (const Point& p : corners_of(record)) centre = centre + Vec3{p[0], p[1], p[2]} / 3;
            take(centre, {record, stl_record});
        }
    }

    Piece piece(io::Span records) const override {
        io::Bytes bytes(stl_head);
        const auto n = static_cast<std::uint32_t>(records.size() / stl_record);
        std::memcpy(bytes.data() + stl_head - sizeof n, &n, sizeof n);
        bytes.insert(bytes.end(), records.begin(), records.end());
        io::ReadLog log;
        Scene scene = io::read_scene(io::Input::of(input().name(), std::move(bytes)), settings_, log,
                                     io::codec_named("stl"));
        Piece piece{std::move(scene.parts.front().mesh), {}};
        piece.names.resize(piece.mesh.vertex_count());
        return piece;
    }

    std::vector<std::uint64_t> keys(io::Span records) const override {
        std::vector<std::uint64_t> keys;
        keys.reserve(records.size() / stl_record * 3);
        for (std::size_t at = 0; at + stl_record <= records.size(); at += stl_record)
            for (const Point& p : corners_of(records.data() + at)) keys.push_back(key_of(p));
        std::sort(keys.begin(), keys.end());
        keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
        return keys;
    }
    std::uint64_t key(const Piece& piece, Index vertex) const override {
        const Vec3& p = piece.mesh.positions[vertex];
        return key_of({static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
    }

  private:
    static std::array<Point, 3> corners_of(const std::byte* record) {
        std::array<Point, 3> corners;
        std::memcpy(corners.data(), record + normal_size, sizeof corners);
        return corners;
    }

    void scan() {
        Sha256 sum;
        Stream all(file_, 0, bytes(), &sum);
        all.take(stl_head);
        for (std::uint32_t f = 0; f < count_; ++f)
            for (const Point& p : corners_of(all.take(stl_record))) {
                const Vec3 at{p[0], p[1], p[2]};
                if (!is_finite(at))
                    io::malformed(input().name(), 0, "E-NAN",
                                  fmt::format("triangle {} at byte {} has the corner ({}, {}, {}), expected "
                                              "finite numbers",
                                              f, stl_head + std::uint64_t{f} * stl_record, at.x, at.y, at.z));
                own_contents().bounds.add(at);
            }
        while (all.left() > 0)
            all.take(static_cast<std::size_t>(std::min<std::uint64_t>(all.left(), 1 << 16)));
        own_contents().sha256 = sum.digest();
    }

    io::ReadSettings settings_;
    ReadFile file_;
    std::uint32_t count_ = 0;
};

} // namespace

std::optional<std::string> why_stl_not_streamed(const io::Input& input) {
    if (input.bytes().size() < stl_head || io::stl::is_text(input.bytes()))
        return "it is text, and only binary STL is";
    return {};
}

std::uint64_t stl_faces(const io::Input& input) {
    std::uint32_t count = 0;
    std::memcpy(&count, input.bytes().data() + stl_head - sizeof count, sizeof count);
    return count;
}

std::unique_ptr<FaceSource> open_stl(io::Input input, const io::ReadSettings& settings) {
    return std::make_unique<StlSource>(std::move(input), settings);
}

} // namespace facetmill::cells
