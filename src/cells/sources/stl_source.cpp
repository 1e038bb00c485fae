#include "cells/sources/stl_source.hpp"

#include "base/math/random.hpp"
#include "base/sort_unique.hpp"
#include "base/text/spelling.hpp"
#include "cells/sources/known_places.hpp"
#include "cells/sources/rows.hpp"
#include "cells/sources/text_window.hpp"
#include "io/stl/stl.hpp"
#include "io/text.hpp"

#include <array>
#include <bit>
#include <cstring>
#include <fmt/format.h>

namespace facetmill::cells {

namespace {

constexpr std::size_t stl_head = io::stl::head, stl_record = io::stl::record, normal_size = 12;

using Point = std::array<float, 3>;

std::uint64_t key_of(const Point& p) {
    std::uint64_t key = 0;
    for (const float x : p) key = hashed(key, std::bit_cast<std::uint32_t>(x + 0.0F)); // -0 equals 0
    return key;
}

Vec3 as_vector(const Point& p) { return {p[0], p[1], p[2]}; }

std::array<Point, 3> corners_of(const std::byte* record) {
    std::array<Point, 3> corners;
    std::memcpy(corners.data(), record + normal_size, sizeof corners);
    return corners;
}

std::uint16_t attribute_of(const std::byte* record) {
    std::uint16_t bytes = 0;
    std::memcpy(&bytes, record + stl_record - sizeof bytes, sizeof bytes);
    return bytes;
}

/// Calls take(corners, attribute bytes) for each triangle of a binary file while it returns true. Returns
/// the file's digest; none if take returned false.
template <class Take>
std::string each_triangle(const io::Input& input, const ReadFile& file, Take&& take) {
    const std::uint64_t count = io::stl::held_triangles(input);
    Sha256 sum;
    Stream all(file, 0, input.bytes().size(), &sum);
    all.take(stl_head);
    for (std::uint64_t f = 0; f < count; ++f) {
        const std::byte* const record = all.take(stl_record);
        const std::array<Point, 3> corners = corners_of(record);
        for (const Point& p : corners)
            if (!is_finite(as_vector(p)))
                io::malformed(input.name(), 0, "E-NAN",
                              fmt::format("triangle {} at byte {} has the corner ({}, {}, {}), expected "
                                          "finite numbers",
                                          f, stl_head + f * stl_record, p[0], p[1], p[2]),
                              not_finite_hint);
        if (!take(corners, attribute_of(record))) return {};
    }
    all.skip(all.left());
    return sum.digest();
}

class StlSource final : public FaceSource {
  public:
    StlSource(File file, const io::ReadSettings& settings, Contents contents)
        : FaceSource(std::move(contents)), settings_(settings), file_(file.file),
          count_(io::stl::held_triangles(file.input)) {
        const io::Span all = file.input.bytes();
        head_.assign(all.begin(), all.begin() + stl_head);
        // A piece alone may have no coloured triangle.
        const std::string_view words = io::stl::viscam_words;
        if (io::stl::colouring_of(file.input) == io::stl::Colouring::viscam)
            std::memcpy(head_.data() + stl_head - sizeof(std::uint32_t) - words.size(), words.data(),
                        words.size());
        own_contents().files.push_back(std::move(file));
    }

    void scan(std::size_t) override {
        Box bounds;
        FaceSource::File& file = own_contents().files.front();
        file.sha256 =
            each_triangle(file.input, *file_, [&](const std::array<Point, 3>& corners, std::uint16_t) {
                for (const Point& p : corners) bounds.add(as_vector(p));
                return true;
            });
        own_contents().bounds = bounds;
    }

    void finish_digests() override {
        if (contents().files.front().sha256.empty()) scan(0);
    }

    std::size_t record_size() const override { return stl_record; }

    void each(const Take& take, std::size_t memory) override {
        each_record(
            [&](io::Span record) {
                Vec3 centre;
                for (const Point& p : corners_of(record.data())) centre = centre + as_vector(p) / 3;
                take(centre, record);
            },
            memory);
    }

    void each_record(const TakeRecord& take, std::size_t) override {
        Stream faces(*file_, stl_head, stl_head + count_ * stl_record);
        for (std::uint64_t f = 0; f < count_; ++f) take({faces.take(stl_record), stl_record});
    }

    Piece piece(io::Span records) const override {
        io::Bytes bytes = head_;
        const auto n = static_cast<std::uint32_t>(records.size() / stl_record);
        std::memcpy(bytes.data() + stl_head - sizeof n, &n, sizeof n);
        bytes.insert(bytes.end(), records.begin(), records.end());
        io::ReadLog log;
        Scene scene =
            io::read_scene(io::Input::of(name(), std::move(bytes)), settings_, log, io::codec_named("stl"));
        Piece piece{std::move(scene.parts.front().mesh), {}};
        for (const Vec3& p : piece.mesh.positions)
            piece.names.push_back(
                key_of({static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)}));
        return piece;
    }

    std::vector<std::uint64_t> names(io::Span records) const override {
        std::vector<std::uint64_t> keys;
        keys.reserve(records.size() / stl_record * 3);
        for (std::size_t at = 0; at + stl_record <= records.size(); at += stl_record)
            for (const Point& p : corners_of(records.data() + at)) keys.push_back(key_of(p));
        sort_unique(keys);
        return keys;
    }

  private:
    io::ReadSettings settings_;
    std::shared_ptr<const ReadFile> file_;
    std::uint64_t count_ = 0;
    io::Bytes head_; ///< of each piece
};

/// Reads text like io/stl/read.cpp.
class StlReader final : public RowReader {
  public:
    StlReader(const io::Input& input, const io::ReadSettings& settings, std::size_t memory, bool or_none)
        : input_(input), memory_(memory), or_none_(or_none),
          identity_(settings.weld == io::Weld::off     ? Identity::number
                    : settings.weld == io::Weld::exact ? Identity::place
                                                       : Identity::place_in_group) {
        if (!is_text_stl(input)) coordinate = io::ply::Type::float32;
    }

    std::string read(const std::shared_ptr<const ReadFile>& file, RowWriter& out, bool) override {
        if (io::stl::is_text(input_.bytes())) return read_text(*file, out);
        return read_binary(*file, out);
    }

  private:
    std::string read_binary(const ReadFile& file, RowWriter& out) const {
        constexpr std::uint32_t minus_zero = 0x80000000;
        out.begin_group(identity_, true);
        KnownPositions known(memory_);
        bool signed_zeros = false;
        std::array<std::uint32_t, 3> numbers{};
        const std::string digest =
            each_triangle(input_, file, [&](const std::array<Point, 3>& corners, std::uint16_t attribute) {
                if (or_none_ && attribute != 0) return false;
                for (std::size_t k = 0; k < 3; ++k) {
                    const auto place = std::bit_cast<PlaceBits>(corners[k]);
                    const auto next = static_cast<std::uint32_t>(out.vertices());
                    numbers[k] = identity_ == Identity::number ? next : known.number(place, next);
                    if (numbers[k] == next) out.vertex(as_vector(corners[k]), {});
                    for (const std::uint32_t bits : place) signed_zeros |= bits == minus_zero;
                }
                out.face(numbers);
                return true;
            });
        if (identity_ == Identity::place_in_group && known.are_all() && !signed_zeros)
            out.identify_by_number();
        return digest;
    }

    static void add(RowWriter& out, const std::array<Vec3, 3>& corners) {
        const auto first = static_cast<std::uint32_t>(out.vertices());
        for (const Vec3& p : corners) out.vertex(p, {});
        out.face(std::array{first, first + 1, first + 2});
    }

    static void expect(io::Text& text, std::string_view wanted) {
        io::Text ahead = text;
        if (!same_word(text.word(), wanted)) ahead.expected(fmt::format("'{}'", wanted).c_str());
    }

    std::string read_text(const ReadFile& file, RowWriter& out) const {
        Sha256 sum;
        TextWindow window(file, 0, input_.bytes().size(), input_.name(), "E-STL", 0, &sum);
        while (!window.at_end()) {
            window.item([&](io::Text& text) {
                expect(text, "solid");
                text.next_line();
            });
            out.begin_group(identity_);
            while (read_facet(window, out)) {
            }
        }
        return sum.digest();
    }

    /// False after the last facet of a solid.
    static bool read_facet(TextWindow& window, RowWriter& out) {
        std::array<Vec3, 3> corners;
        bool facet = false;
        window.item([&](io::Text& text) {
            io::Text ahead = text;
            const std::string_view word = text.word();
            facet = same_word(word, "facet");
            if (!facet && !same_word(word, "endsolid")) ahead.expected("'facet' or 'endsolid'");
            if (!facet) {
                text.next_line(); // skips the name, which may differ or be missing
                return;
            }
            text.rest_of_line(); // skips the normal
            expect(text, "outer");
            expect(text, "loop");
            for (Vec3& p : corners) {
                expect(text, "vertex");
                const double x = text.coordinate("x"), y = text.coordinate("y"), z = text.coordinate("z");
                p = {x, y, z};
            }
            expect(text, "endloop");
            text.rest_of_line();
            expect(text, "endfacet");
            text.rest_of_line();
        });
        if (facet) add(out, corners);
        return facet;
    }

    io::Input input_;
    std::size_t memory_;
    bool or_none_;
    Identity identity_;
};

} // namespace

bool is_text_stl(const io::Input& input) {
    return input.bytes().size() < stl_head || io::stl::is_text(input.bytes());
}

std::unique_ptr<FaceSource> open_stl(FaceSource::File file, const io::ReadSettings& settings,
                                     FaceSource::Contents contents) {
    return std::make_unique<StlSource>(std::move(file), settings, std::move(contents));
}

std::unique_ptr<RowReader> stl_rows(const io::Input& input, const io::ReadSettings& settings,
                                    std::size_t memory, bool or_none) {
    return std::make_unique<StlReader>(input, settings, memory, or_none);
}

} // namespace facetmill::cells
