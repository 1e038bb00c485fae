#include "io/stl/stl.hpp"

#include "base/progress.hpp"
#include "base/text/spelling.hpp"
#include "io/attributes.hpp"
#include "io/not_finite.hpp"
#include "io/srgb_colours.hpp"
#include "io/stated.hpp"
#include "io/text.hpp"
#include "io/trailing.hpp"
#include "mesh/invariants.hpp"
#include "mesh/position_hash.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cstring>
#include <fmt/format.h>
#include <numeric>

namespace facetmill::io::stl {

namespace {

static_assert(std::endian::native == std::endian::little, "STL is read as it lies in memory");

bool has_binary_size(Span bytes) {
    return bytes.size() >= head && bytes.size() == head + record * std::size_t{promised_triangles(bytes)};
}

/// Builds indexed triangles with one vertex per position. Wedges are dropped, because the mesh has no
/// attributes.
void index_by_position(Mesh& mesh, const ReadSettings& settings) {
    mesh.corners.resize(mesh.positions.size());
    std::iota(mesh.corners.begin(), mesh.corners.end(), Index{0});
    if (settings.weld == Weld::off) return;
    weld_exact(mesh);
    if (!mesh.has_seams()) return;
    parallel_for(mesh.corners.size(),
                 [&](std::size_t c) { mesh.corners[c] = mesh.wedge_vertex[mesh.corners[c]]; });
    mesh.wedge_vertex.clear();
}

void check_count(const Input& input, const ReadSettings& settings, std::size_t vertices) {
    if (vertices >= none || vertices > 3 * settings.max_vertices)
        beyond_limit(input.name(),
                     fmt::format("{} triangles are more than facetmill supports", vertices / 3));
}

/// The triangle records of a binary file.
class Records {
  public:
    Records(const Input& input, Span bytes) : input_(input), bytes_(bytes) {}

    std::size_t size() const { return bytes_.size() / record; }
    /// The position of corner c; skips the normal before each triangle.
    std::array<float, 3> corner(std::size_t c) const {
        return at<std::array<float, 3>>(c / 3 * record + 12 * (c % 3 + 1));
    }
    /// The bits that number_places() compares.
    FloatBits operator()(std::size_t c) const {
        auto bits = std::bit_cast<FloatBits>(corner(c));
        for (std::uint32_t& b : bits)
            if (b == 0x80000000) b = 0;
        return bits;
    }
    /// The two attribute bytes after triangle t.
    std::uint16_t extra(std::size_t t) const { return at<std::uint16_t>(t * record + record - 2); }

    /// Marks these corners as read.
    void done(std::size_t begin, std::size_t end) const {
        const std::size_t first = begin / 3, last = (end + 2) / 3;
        std::uint16_t all = 0;
        for (std::size_t t = first; t < last; ++t) all |= extra(t);
        if (all != 0) has_extra_.store(true, std::memory_order_relaxed);
        input_.release(bytes_.subspan(first * record, (last - first) * record));
    }
    /// Whether a triangle read so far has nonzero attribute bytes.
    bool has_extra() const { return has_extra_; }

  private:
    template <class T>
    T at(std::size_t offset) const {
        T t;
        std::memcpy(&t, bytes_.data() + offset, sizeof t);
        return t;
    }

    const Input& input_;
    Span bytes_;
    mutable std::atomic<bool> has_extra_ = false;
};

/// One vertex per position, without an intermediate list of all corners in doubles.
void add_triangles(Mesh& mesh, const Records& records, const ReadSettings& settings) {
    const std::size_t corners = 3 * records.size();
    mesh.corners.resize(corners);
    const auto put = [&](std::size_t place, const std::array<float, 3>& p) {
        mesh.positions[place] = {p[0], p[1], p[2]};
    };
    if (settings.weld == Weld::off) {
        mesh.positions.resize(corners);
        std::iota(mesh.corners.begin(), mesh.corners.end(), Index{0});
        parallel_chunks(corners, [&](std::size_t begin, std::size_t end) {
            for (std::size_t c = begin; c < end; ++c) put(c, records.corner(c));
            records.done(begin, end);
        });
        return;
    }
    const std::size_t expected = records.size() / 2; // vertices of a closed surface
    number_places(
        mesh.corners, expected, records,
        [&](std::size_t places) {
            mesh.positions.resize(places);
            return true;
        },
        [&](std::size_t place, std::size_t c, const FloatBits& key) {
            const bool zero = key[0] == 0 || key[1] == 0 || key[2] == 0; // may be -0 in this corner
            put(place, zero ? records.corner(c) : std::bit_cast<std::array<float, 3>>(key));
        });
}

void refuse_not_finite(const Mesh& mesh, const std::string& name) {
    const std::size_t bad = first_not_finite(mesh.positions); // positions are in the order of the corners
    if (bad == mesh.positions.size()) return;
    const auto c = static_cast<std::size_t>(std::find(mesh.corners.begin(), mesh.corners.end(), bad) -
                                            mesh.corners.begin());
    const Vec3& p = mesh.positions[bad];
    malformed(name, 0, "E-NAN",
              fmt::format("triangle {} at byte {} has the corner ({}, {}, {}), expected finite numbers",
                          c / 3, head + c / 3 * record, p.x, p.y, p.z),
              drop_not_finite_hint);
}

/// The words in the head of Magics before the colour of the whole, in four bytes.
constexpr std::string_view magics_words = "COLOR=";

std::string_view title_of(Span bytes) {
    return as_text(bytes.first(std::min(bytes.size(), head - sizeof(std::uint32_t))));
}

/// The three bytes of a triangle's colour.
std::array<std::uint8_t, 3> colour_of(std::uint16_t bits, Colouring colouring,
                                      const std::array<std::uint8_t, 3>& of_whole) {
    constexpr int most = 31; // of five bits
    std::array<std::uint8_t, 3> colour{};
    for (std::size_t c = 0; c < 3; ++c)
        colour[c] = static_cast<std::uint8_t>(((bits >> 5 * c & most) * 255 + most / 2) / most);
    if (colouring == Colouring::viscam) std::swap(colour[0], colour[2]);
    const bool own = (bits & 0x8000) != 0 ? colouring == Colouring::viscam : colouring == Colouring::magics;
    return own ? colour : of_whole;
}

/// Keeps attribute bytes, which some programs use for colours; most files have zeros.
void add_attribute_bytes(Mesh& mesh, const Records& records, const Input& input) {
    const Colouring colouring = colouring_of(input);
    if (colouring != Colouring::none) {
        std::array<std::uint8_t, 3> of_whole{255, 255, 255};
        const std::string_view title = title_of(input.bytes());
        const std::size_t at = title.find(magics_words) + magics_words.size();
        if (colouring == Colouring::magics && at + of_whole.size() <= title.size())
            std::memcpy(of_whole.data(), title.data() + at, of_whole.size());
        std::vector<std::uint8_t> colours(3 * records.size());
        parallel_for(records.size(), [&](std::size_t t) {
            // Without any bytes, the head alone has a colour.
            const auto colour =
                records.has_extra() ? colour_of(records.extra(t), colouring, of_whole) : of_whole;
            std::copy(colour.begin(), colour.end(), colours.begin() + static_cast<std::ptrdiff_t>(3 * t));
        });
        mesh.attributes.push_back({"COLOR_0", Domain::face, Role::colour, 3, true, std::move(colours)});
    } else if (records.has_extra()) {
        std::vector<std::uint16_t> extra(records.size());
        parallel_for(extra.size(), [&](std::size_t t) { extra[t] = records.extra(t); });
        mesh.attributes.push_back({stl_attribute, Domain::face, Role::index, 1, false, std::move(extra)});
    }
}

Part read_binary(const Input& input, const ReadSettings& settings, ReadLog& log) {
    const Span bytes = input.bytes();
    const std::size_t n = held_triangles(input);
    warn_of_trailing(log, input.name(), bytes.size() - head - n * record,
                     fmt::format("the last of {} triangles", n));
    if (n != promised_triangles(bytes))
        log.warnings.push_back(
            {Severity::warning, "W-COUNT",
             fmt::format("the header counts {} triangles, but the file has {}: all are read",
                         promised_triangles(bytes), n),
             file_mark(input.name()), "", false});
    check_count(input, settings, 3 * n);
    Part part;
    const Records records(input, bytes.subspan(head, n * record));
    add_triangles(part.mesh, records, settings);
    add_attribute_bytes(part.mesh, records, input);
    if (!settings.drop_not_finite) refuse_not_finite(part.mesh, input.name());
    return part;
}

class TextReader {
  public:
    explicit TextReader(const Input& input)
        : all_(input.bytes().size()), text_(as_text(input.bytes()), input.name(), "E-STL") {}

    Scene read(const Input& input, const ReadSettings& settings, ReadLog& log) {
        any_ = settings.drop_not_finite;
        Scene scene;
        while (!text_.at_end()) {
            expect("solid");
            Part part;
            part.name = text_.rest_of_line();
            text_.next_line();
            read_solid(part.mesh);
            check_count(input, settings, part.mesh.positions.size());
            const ProgressScope silent(nullptr); // progress follows the position in the text
            index_by_position(part.mesh, settings);
            scene.parts.push_back(std::move(part));
        }
        if (more_ > 0)
            log.warnings.push_back(
                {Severity::warning, "W-SKIPPED",
                 fmt::format("words after endloop or endfacet are skipped ({}), for example colours", more_),
                 file_mark(input.name()), "write colours with a format that has them, such as PLY"});
        return scene;
    }

  private:
    void expect(std::string_view wanted) {
        Text ahead = text_;
        if (!same_word(text_.word(), wanted)) ahead.expected(fmt::format("'{}'", wanted).c_str());
    }

    void read_solid(Mesh& mesh) {
        while (true) {
            Text ahead = text_;
            const std::string_view word = text_.word();
            if (same_word(word, "facet")) {
                read_facet(mesh);
            } else if (same_word(word, "endsolid")) {
                text_.next_line(); // skips the name, which may differ or be missing
                return;
            } else {
                ahead.expected("'facet' or 'endsolid'");
            }
        }
    }

    void read_facet(Mesh& mesh) {
        if (mesh.positions.size() % (3 * 8192) == 0)
            ProgressScope::report(1 - static_cast<double>(text_.left()) / static_cast<double>(all_));
        text_.rest_of_line(); // skips the normal
        expect("outer");
        expect("loop");
        for (int k = 0; k < 3; ++k) {
            expect("vertex");
            const double x = coordinate(text_, "x", any_), y = coordinate(text_, "y", any_),
                         z = coordinate(text_, "z", any_);
            mesh.positions.push_back({x, y, z});
        }
        expect("endloop");
        skip_end();
        expect("endfacet");
        skip_end();
    }
    void skip_end() {
        if (!text_.rest_of_line().empty()) ++more_;
    }

    std::size_t all_;
    std::size_t more_ = 0; ///< ends of loops and facets with further words, for example colours
    bool any_ = false;     ///< coordinates that are not finite are dropped later
    Text text_;
};

} // namespace

std::uint32_t promised_triangles(Span bytes) {
    std::uint32_t n = 0;
    std::memcpy(&n, bytes.data() + head - sizeof n, sizeof n);
    return n;
}

std::uint32_t held_triangles(const Input& input) {
    const std::size_t bytes = input.bytes().size();
    if (bytes < head)
        malformed(
            input.name(), 0, "E-STL",
            fmt::format("{} bytes are neither STL text nor binary, which has {} before the first triangle",
                        bytes, head));
    const std::uint32_t n = promised_triangles(input.bytes());
    const std::size_t held = (bytes - head) / record;
    const bool is_counted = n != 0 && n != UINT32_MAX;
    if (!is_counted && (bytes - head) % record == 0 && held < UINT32_MAX)
        return static_cast<std::uint32_t>(held);
    if (n > held)
        malformed(input.name(), 0, "E-STL",
                  fmt::format("the file should have {} triangles, but ends in triangle {}, at byte {}", n,
                              held, bytes));
    return n;
}

Colouring colouring_of(const Input& input) {
    const std::string_view title = title_of(input.bytes());
    if (title.find(magics_words) != std::string_view::npos) return Colouring::magics;
    if (title.find(viscam_words) != std::string_view::npos) return Colouring::viscam;
    const Span records = input.bytes().subspan(head, record * std::size_t{held_triangles(input)});
    const int marks = parallel_reduce(
        records.size() / record, 0,
        [&](std::size_t begin, std::size_t end) {
            int mark = 0;
            for (std::size_t t = begin; t < end; ++t)
                mark |= std::to_integer<int>(records[t * record + record - 1]) & 0x80;
            return mark;
        },
        [](int a, int b) { return a | b; });
    return marks != 0 ? Colouring::viscam : Colouring::none;
}

bool is_text(Span bytes) {
    if (has_binary_size(bytes)) return false;
    const Span start = bytes.first(std::min<std::size_t>(bytes.size(), 4096));
    if (std::find(start.begin(), start.end(), std::byte{0}) != start.end()) return false;
    static const std::string nameless;
    Text text(as_text(bytes.first(std::min<std::size_t>(bytes.size(), 4096))), nameless, "E-STL");
    if (!same_word(text.word(), "solid")) return false;
    if (!text.next_line()) return true;
    const std::string_view word = text.word();
    return word.empty() || same_word(word, "facet") || same_word(word, "endsolid") || bytes.size() < head;
}

namespace {

/// The unit and axis stated between semicolons in the bytes before the count.
Stated stated_in_head(Span bytes) {
    std::string_view words = title_of(bytes);
    words = words.substr(0, words.find('\0'));
    Stated stated;
    while (!words.empty()) {
        const std::size_t end = std::min(words.find(';'), words.size());
        take_comment(words.substr(0, end), stated);
        words.remove_prefix(std::min(end + 1, words.size()));
    }
    return stated;
}

} // namespace

Scene read(const Input& input, const ReadSettings& settings, ReadLog& log) {
    if (is_text(input.bytes())) return TextReader(input).read(input, settings, log);
    Scene scene;
    scene.parts.push_back(read_binary(input, settings, log));
    take_stated(scene, stated_in_head(input.bytes()), input.name(), settings, log);
    return scene;
}

namespace {
const RegisterCodec codec({
    .name = "stl",
    .about = "Stereolithography, text or binary; triangles only, welded exactly",
    .extensions = {"stl"},
    .can = {.shares_vertices = false,
            .normals = false,
            .options = {{"ascii", &WriteSettings::ascii}},
            .attributes = "colours of faces, in binary files"},
    .sniff =
        [](Span bytes) {
            if (is_text(bytes))
                return as_text(bytes.first(std::min<std::size_t>(bytes.size(), 4096))).find("facet") !=
                               std::string_view::npos
                           ? 2
                           : 1;
            return has_binary_size(bytes) && bytes.size() > head ? 2 : 0;
        },
    .read = with_linear_colours(read),
    .write = with_srgb_colours(write),
    .peek =
        [](const Input& input, FileHeader& header) {
            if (!is_text(input.bytes())) take_stated(header, stated_in_head(input.bytes()));
        },
});
} // namespace

} // namespace facetmill::io::stl
