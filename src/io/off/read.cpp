#include "io/off/off.hpp"

#include "base/progress.hpp"
#include "io/attributes.hpp"
#include "io/not_finite.hpp"
#include "io/srgb_colours.hpp"
#include "io/stated.hpp"
#include "io/text.hpp"
#include "io/trailing.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <fmt/format.h>

namespace facetmill::io::off {

namespace {

/// Parses a keyword: OFF with prefixes in the order that Geomview requires. None for other words.
std::optional<Kind> kind_named(std::string_view word) {
    if (!word.ends_with("OFF")) return {};
    word.remove_suffix(3);
    Kind kind;
    if (word.starts_with("ST")) {
        kind.uvs = true;
        word.remove_prefix(2);
    }
    if (word.starts_with("C")) {
        kind.colours = true;
        word.remove_prefix(1);
    }
    if (word.starts_with("N")) {
        kind.normals = true;
        word.remove_prefix(1);
    }
    return word.empty() ? std::optional(kind) : std::nullopt;
}

/// Colours are bytes or fractions. All numbers of the file decide together, because "1 0 0" alone may be
/// either.
struct Colours {
    std::vector<float> values; ///< four per colour; negative: missing
    std::size_t mapped = 0;    ///< numbers of colours in a colour map, which is not read
    std::size_t most = 0;      ///< the largest count of numbers in a colour
    bool points = false;       ///< true if a number has a decimal point
    double largest = 0;

    void add(std::span<const double> given, bool whole) {
        const bool known = given.size() == 3 || given.size() == 4; // a single number indexes a colour map
        mapped += !known && !given.empty() ? 1 : 0;
        points |= known && !whole;
        for (std::size_t c = 0; c < 4; ++c) {
            const bool there = known && c < given.size();
            values.push_back(there && given[c] > 0 ? static_cast<float>(given[c]) : there ? 0.0F : -1.0F);
            if (there) largest = std::max(largest, given[c]);
        }
        if (known) most = std::max(most, given.size());
    }

    void give(Mesh& mesh, Domain domain) const {
        if (most == 0) return;
        const bool bytes = largest > (points ? 2 : 1);
        std::vector<float> numbers;
        for (std::size_t i = 0; i < values.size(); ++i)
            if (i % 4 < most) numbers.push_back(values[i] >= 0 ? values[i] : bytes ? 255.0F : 1.0F);
        Attribute a{"COLOR_0", domain, Role::colour, static_cast<int>(most), bytes, {}};
        if (bytes) {
            std::vector<std::uint8_t> small;
            small.reserve(numbers.size());
            for (const float x : numbers) small.push_back(static_cast<std::uint8_t>(std::min(x, 255.0F)));
            a.data = std::move(small);
        } else {
            a.data = std::move(numbers);
        }
        add_attribute(mesh, std::move(a));
    }
};

/// The output of both readers.
struct Builder {
    const Input& input;
    const ReadSettings& settings;
    Mesh mesh;
    std::vector<float> normals, uvs;
    Colours vertex_colours, face_colours;
    std::size_t trailing = 0; ///< bytes after the last face

    /// Refuses counts that the remaining bytes cannot fill. line: 0 for a binary file.
    void check(std::int64_t vertices, std::int64_t faces, std::int64_t line, std::size_t left,
               std::size_t per_vertex, std::size_t per_face) const {
        if (vertices < 0 || faces < 0)
            malformed(
                input.name(), line, "E-OFF",
                fmt::format("expected counts of 0 or more, found {} vertices and {} faces", vertices, faces));
        if (static_cast<std::uint64_t>(vertices) > settings.max_vertices || vertices >= none || faces >= none)
            beyond_limit(
                input.name(),
                fmt::format("{} vertices and {} faces are more than facetmill supports", vertices, faces));
        const std::size_t spare = line > 0 ? 1 : 0; // the last line of a text may lack its end
        if (static_cast<std::size_t>(vertices) * per_vertex + static_cast<std::size_t>(faces) * per_face >
            left + spare)
            malformed(
                input.name(), line, "E-OFF",
                fmt::format(
                    "the header gives {} vertices and {} faces, but the remaining {} bytes cannot hold them",
                    vertices, faces, left));
    }

    Scene finish(ReadLog& log) {
        warn_of_trailing(log, input.name(), trailing, "the last face");
        if (const std::size_t mapped = vertex_colours.mapped + face_colours.mapped; mapped > 0)
            log.warnings.push_back(
                {Severity::warning, "W-SKIPPED",
                 fmt::format("colours that are numbers of a colour map are skipped ({})", mapped),
                 file_mark(input.name()), "export colours as three or four numbers"});
        if (!normals.empty())
            add_attribute(mesh, {"NORMAL", Domain::wedge, Role::normal, 3, false, std::move(normals)});
        if (!uvs.empty())
            add_attribute(mesh, {"TEXCOORD_0", Domain::wedge, Role::uv, 2, false, std::move(uvs)});
        vertex_colours.give(mesh, Domain::wedge);
        face_colours.give(mesh, Domain::face);
        drop_short_faces(mesh, input.name(), log);
        normalise_offsets(mesh);
        Scene scene;
        scene.parts.emplace_back().mesh = std::move(mesh);
        return scene;
    }
};

class TextReader {
  public:
    TextReader(Builder& out, const Text& text, Kind kind) : out_(out), text_(text), kind_(kind) {}

    void read() {
        const std::int64_t vertices = text_.integer("the number of vertices"),
                           faces = text_.integer("the number of faces");
        out_.check(vertices, faces, text_.line(), text_.left(), 6, 2);
        text_.rest_of_line(); // the number of edges, if given, is unused
        take_unnamed_colours(vertices);
        out_.mesh.positions.reserve(static_cast<std::size_t>(vertices));
        const std::size_t all = text_.left();
        std::vector<Index> corners;
        for (std::int64_t v = 0; v < vertices; ++v, tell(v, all)) vertex();
        for (std::int64_t f = 0; f < faces; ++f, tell(f, all)) face(corners, vertices);
        if (!text_.at_end()) out_.trailing = text_.left();
    }

  private:
    void tell(std::int64_t item, std::size_t all) const {
        if (item % 8192 == 0)
            ProgressScope::report(1 - static_cast<double>(text_.left()) / static_cast<double>(all));
    }

    /// Many programs write colours of vertices under the plain keyword OFF. They are recognised if each line
    /// has a vertex and the same number of further values, and a face follows.
    void take_unnamed_colours(std::int64_t vertices) {
        if (kind_.normals || kind_.colours || kind_.uvs) return;
        Text ahead = text_;
        std::int64_t size = 0;
        bool negative = false;
        for (std::int64_t v = 0; v < vertices; ++v) {
            ahead.at_end();
            std::int64_t n = 0;
            for (auto word = ahead.word_on_line(); !word.empty(); word = ahead.word_on_line())
                negative |= ++n > 3 && word.starts_with('-');
            if (n <= 3 || (v > 0 && n != size)) return;
            size = n;
        }
        std::int64_t corners = 0, words = 0;
        if (!ahead.at_end() && !ahead.take(corners)) return;
        while (!ahead.word_on_line().empty()) ++words;
        if (size == 0 || words < corners) return;
        kind_.colours = (size == 6 || size == 7) && !negative;
        if (!kind_.colours)
            text_.fail(fmt::format("each vertex has {} numbers, but OFF has three", size),
                       "begin the file with NOFF if normals follow the coordinates, or COFF for colours");
    }

    void vertex() {
        const bool any = out_.settings.drop_not_finite; // vertices that are not finite are dropped later
        const double x = coordinate(text_, "x", any), y = coordinate(text_, "y", any),
                     z = coordinate(text_, "z", any);
        out_.mesh.positions.push_back({x, y, z});
        if (kind_.normals)
            for (int c = 0; c < 3; ++c) out_.normals.push_back(static_cast<float>(text_.real("a normal")));
        if (kind_.colours) colour(out_.vertex_colours, kind_.uvs ? 2 : 0);
        if (kind_.uvs) {
            out_.uvs.push_back(static_cast<float>(text_.real("u")));
            out_.uvs.push_back(1 - static_cast<float>(text_.real("v"))); // glTF's v starts at the top
        }
    }

    /// Reads the numbers left on the line except the last `more`: a colour of one to four numbers.
    void colour(Colours& colours, int more) {
        int left = 0;
        for (Text ahead = text_; !ahead.word_on_line().empty();) ++left;
        std::array<double, 4> values{};
        const int count = std::clamp(left - more, 0, 4);
        bool whole = count > 0;
        for (int c = 0; c < count; ++c) {
            Text ahead = text_;
            whole &= ahead.word_on_line().find_first_of(".eE") == std::string_view::npos;
            values[static_cast<std::size_t>(c)] = text_.real("a colour");
        }
        colours.add({values.data(), static_cast<std::size_t>(count)}, whole);
    }

    void face(std::vector<Index>& corners, std::int64_t vertices) {
        const std::int64_t n = text_.integer("the number of corners");
        if (n < 0 || static_cast<std::size_t>(n) > text_.left() / 2 + 1)
            text_.fail(fmt::format("a face of {} corners, which the rest of the file cannot hold", n));
        corners.clear();
        for (std::int64_t k = 0; k < n; ++k) {
            const std::int64_t v = text_.integer("a vertex");
            if (v < 0 || v >= vertices)
                text_.fail(fmt::format("a face refers to vertex {}, but the file has {}", v, vertices));
            corners.push_back(static_cast<Index>(v));
        }
        add_face(out_.mesh, corners);
        colour(out_.face_colours, 0);
    }

    Builder& out_;
    Text text_;
    Kind kind_;
};

/// Binary: 32-bit integers and floats in a byte order that the counts reveal.
class BinaryReader {
  public:
    BinaryReader(Builder& out, Kind kind, std::size_t at)
        : out_(out), kind_(kind), bytes_(out.input.bytes()), at_(at) {}

    void read() {
        need(12, "the counts");
        choose_order();
        const std::int64_t vertices = integer(), faces = integer();
        integer();
        const std::size_t vertex_size =
            12 + (kind_.normals ? 12 : 0) + (kind_.colours ? 16 : 0) + (kind_.uvs ? 8 : 0);
        out_.check(vertices, faces, 0, bytes_.size() - at_, vertex_size, 4);
        const auto items = static_cast<std::size_t>(vertices + faces);
        std::size_t item = 0;
        for (std::int64_t v = 0; v < vertices; ++v, ProgressScope::report_item(++item, items)) vertex();
        const bool colours = faces_have_colours(faces);
        std::vector<Index> corners;
        for (std::int64_t f = 0; f < faces; ++f, ProgressScope::report_item(++item, items))
            face(corners, vertices, colours);
        out_.trailing = bytes_.size() - at_;
    }

  private:
    void need(std::size_t size, const char* what) const {
        if (bytes_.size() - at_ < size)
            malformed(out_.input.name(), 0, "E-OFF",
                      fmt::format("the file ends in {}, at byte {}", what, bytes_.size()));
    }
    std::uint32_t word(std::size_t at) const {
        std::uint32_t w = 0;
        std::memcpy(&w, bytes_.data() + at, sizeof w);
        return swap_ ? __builtin_bswap32(w) : w;
    }
    std::int32_t integer() { return static_cast<std::int32_t>(word((at_ += 4) - 4)); }
    float real() { return std::bit_cast<float>(word((at_ += 4) - 4)); }

    /// Geomview specifies big-endian, but other programs write their native order. Read in the wrong order,
    /// the counts are huge.
    void choose_order() {
        const auto too_many = [&] {
            return word(at_) > bytes_.size() / 12 || word(at_ + 4) > bytes_.size() / 4;
        };
        swap_ = std::endian::native == std::endian::little;
        if (too_many()) swap_ = !swap_;
        if (too_many()) swap_ = !swap_;
    }

    void vertex() {
        const float x = real(), y = real(), z = real();
        out_.mesh.positions.push_back({x, y, z});
        if (!out_.settings.drop_not_finite && !is_finite(out_.mesh.positions.back()))
            malformed(out_.input.name(), 0, "E-NAN",
                      fmt::format("vertex {} at byte {} is ({}, {}, {}), expected finite numbers",
                                  out_.mesh.positions.size() - 1, at_ - 12, x, y, z),
                      drop_not_finite_hint);
        for (int c = 0; kind_.normals && c < 3; ++c) out_.normals.push_back(real());
        if (kind_.colours) {
            const std::array<double, 4> rgba{real(), real(), real(), real()};
            out_.vertex_colours.add(rgba, false);
        }
        if (kind_.uvs) {
            out_.uvs.push_back(real());
            out_.uvs.push_back(1 - real());
        }
    }

    /// Geomview writes a count of colour numbers after each face; other programs do not. The interpretation
    /// that ends exactly at the end of the file is correct.
    bool faces_have_colours(std::int64_t faces) const {
        std::size_t at = at_;
        for (std::int64_t f = 0; f < faces; ++f) {
            for (const std::size_t most : {bytes_.size() / 4, std::size_t{4}}) {
                if (at + 4 > bytes_.size()) return false;
                const std::size_t n = word(at);
                if (n > most || (bytes_.size() - at - 4) / 4 < n) return false;
                at += 4 + 4 * n;
            }
        }
        return at == bytes_.size();
    }

    void face(std::vector<Index>& corners, std::int64_t vertices, bool coloured) {
        need(4, "a face");
        const std::uint32_t n = word((at_ += 4) - 4);
        need(4 * std::size_t{n}, "a face");
        corners.clear();
        for (std::uint32_t k = 0; k < n; ++k) {
            const std::int64_t v = integer();
            if (v < 0 || v >= vertices)
                malformed(out_.input.name(), 0, "E-OFF",
                          fmt::format("a face refers to vertex {}, but the file has {}, at byte {}", v,
                                      vertices, at_ - 4));
            corners.push_back(static_cast<Index>(v));
        }
        add_face(out_.mesh, corners);
        if (!coloured) return;
        std::array<double, 4> colour{};
        const std::uint32_t count = word((at_ += 4) - 4); // at most four, see faces_have_colours
        for (std::uint32_t c = 0; c < count; ++c) colour[c] = real();
        out_.face_colours.add({colour.data(), count}, false);
    }

    Builder& out_;
    Kind kind_;
    Span bytes_;
    std::size_t at_;
    bool swap_ = false;
};

} // namespace

Kind read_kind(Text& text) {
    const Text start = text;
    std::string_view word = text.word();
    auto kind = kind_named(word);
    if (!kind && word.starts_with("OFF") && word.size() > 3) {
        // In "OFF8 6 12", no space separates the keyword and the count.
        text = start;
        text.at_end();
        for (const char c : {'O', 'F', 'F'}) text.take(c);
        kind.emplace();
    } else if (!kind && (word.starts_with('4') || word.find("OFF") != std::string_view::npos) &&
               word.ends_with("OFF")) {
        text.fail(fmt::format("facetmill cannot read {}: it supports only points with three coordinates",
                              in_quotes(word)),
                  "expected OFF with any of the prefixes ST, C and N, in this order");
    } else if (!kind) {
        // The keyword may be left out.
        text = start;
        kind.emplace();
    }
    Text ahead = text;
    kind->binary = ahead.word_on_line() == "BINARY";
    if (kind->binary) {
        ahead.next_line();
        text = ahead;
    }
    return *kind;
}

Scene read(const Input& input, const ReadSettings& settings, ReadLog& log) {
    Text text(as_text(input.bytes()), input.name(), "E-OFF", '#');
    Builder out{input, settings, {}, {}, {}, {}, {}, 0};
    const Kind kind = read_kind(text);
    if (kind.binary)
        BinaryReader(out, kind, text.offset()).read();
    else
        TextReader(out, text, kind).read();
    Scene scene = out.finish(log);
    if (!kind.binary)
        take_stated(scene, stated_in_lines(as_text(input.bytes()), "OFF"), input.name(), settings, log);
    return scene;
}

namespace {
const RegisterCodec codec({
    .name = "off",
    .about = "Geomview object file, text or binary; polygons with colours",
    .extensions = {"off", "coff", "noff"},
    .can = {.polygons = true,
            .points = true,
            .points_and_faces = true,
            .full_precision = true,
            .attributes = "normals, colours of vertices or faces"},
    .sniff =
        [](Span bytes) {
            static const std::string nameless;
            Text text(as_text(bytes.first(std::min<std::size_t>(bytes.size(), 4096))), nameless, "E-OFF",
                      '#');
            const std::string_view word = text.word();
            return kind_named(word) ? 2 : word.starts_with("OFF") ? 1 : 0;
        },
    .read = with_linear_colours(read),
    .write = with_srgb_colours(write),
    .peek = [](const Input& input,
               FileHeader& header) { take_stated(header, stated_in_lines(as_text(input.bytes()), "OFF")); },
});
} // namespace

} // namespace facetmill::io::off
