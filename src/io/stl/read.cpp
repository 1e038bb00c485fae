#include "io/stl/stl.hpp"

#include "base/parallel.hpp"
#include "base/progress.hpp"
#include "base/spelling.hpp"
#include "io/text.hpp"

#include <array>
#include <bit>
#include <cstring>
#include <fmt/format.h>
#include <numeric>

namespace facetmill::io::stl {

namespace {

constexpr std::size_t head = 84, record = 50; ///< bytes before the triangles, and of each

static_assert(std::endian::native == std::endian::little, "STL is read as it lies in memory");

std::uint32_t promised_triangles(Span bytes) {
    std::uint32_t n = 0;
    std::memcpy(&n, bytes.data() + 80, sizeof n);
    return n;
}

bool has_binary_size(Span bytes) {
    return bytes.size() >= head && bytes.size() == head + record * std::size_t{promised_triangles(bytes)};
}

/// The triangles lie three corners a face: one vertex per place, and no attributes to keep wedges apart for.
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
        beyond_limit(input.name(), fmt::format("{} triangles are more than can be held", vertices / 3));
}

Part read_binary(const Input& input, const ReadSettings& settings, ReadLog& log) {
    const Span bytes = input.bytes();
    if (bytes.size() < head)
        malformed(
            input.name(), 0, "E-STL",
            fmt::format("{} bytes are neither STL text nor binary, which has {} before the first triangle",
                        bytes.size(), head));
    const std::size_t n = promised_triangles(bytes), held = (bytes.size() - head) / record;
    if (n > held)
        malformed(input.name(), 0, "E-STL",
                  fmt::format("the file is to have {} triangles and ends in triangle {}, at byte {}", n, held,
                              bytes.size()));
    if (head + n * record != bytes.size())
        log.warnings.push_back({Severity::warning, "W-TRAILING",
                                fmt::format("{} bytes after the last of {} triangles are skipped",
                                            bytes.size() - head - n * record, n),
                                file_mark(input.name()), ""});
    check_count(input, settings, 3 * n);
    Part part;
    part.mesh.positions.resize(3 * n);
    std::vector<std::uint16_t> extra(n);
    ShareOfSteps steps({1, 4});
    Share::loop_tells();
    parallel_for(n, [&](std::size_t t) {
        const std::byte* at = bytes.data() + head + t * record;
        std::array<float, 12> numbers; // the normal, then three corners
        std::memcpy(numbers.data(), at, sizeof numbers);
        std::memcpy(&extra[t], at + sizeof numbers, sizeof extra[t]);
        for (std::size_t k = 0; k < 3; ++k)
            part.mesh.positions[3 * t + k] = {numbers[3 * k + 3], numbers[3 * k + 4], numbers[3 * k + 5]};
    });
    const auto bad = std::find_if(part.mesh.positions.begin(), part.mesh.positions.end(),
                                  [](const Vec3& p) { return !is_finite(p); });
    if (bad != part.mesh.positions.end()) {
        const auto t = static_cast<std::size_t>(bad - part.mesh.positions.begin()) / 3;
        malformed(input.name(), 0, "E-NAN",
                  fmt::format("triangle {} at byte {} has the corner ({}, {}, {}), expected finite numbers",
                              t, head + t * record, bad->x, bad->y, bad->z));
    }
    steps.next();
    index_by_position(part.mesh, settings);
    if (std::any_of(extra.begin(), extra.end(), [](std::uint16_t x) { return x != 0; }))
        part.mesh.attributes.push_back({"attribute", Domain::face, Role::index, 1, false, std::move(extra)});
    return part;
}

class TextReader {
  public:
    explicit TextReader(const Input& input)
        : all_(input.bytes().size()), text_(as_text(input.bytes()), input.name(), "E-STL") {}

    Scene read(const Input& input, const ReadSettings& settings) {
        Scene scene;
        while (!text_.at_end()) {
            expect("solid");
            Part part;
            part.name = text_.rest_of_line();
            text_.next_line();
            read_solid(part.mesh);
            check_count(input, settings, part.mesh.positions.size());
            const Share silent(nullptr); // where the text ends tells how far all is
            index_by_position(part.mesh, settings);
            scene.parts.push_back(std::move(part));
        }
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
                text_.next_line(); // the name again, or another, or none
                return;
            } else {
                ahead.expected("'facet' or 'endsolid'");
            }
        }
    }

    void read_facet(Mesh& mesh) {
        if (mesh.positions.size() % (3 * 8192) == 0)
            Share::tell(1 - static_cast<double>(text_.left()) / static_cast<double>(all_));
        text_.rest_of_line(); // the normal
        expect("outer");
        expect("loop");
        for (int k = 0; k < 3; ++k) {
            expect("vertex");
            const double x = text_.coordinate("x"), y = text_.coordinate("y"), z = text_.coordinate("z");
            mesh.positions.push_back({x, y, z});
        }
        expect("endloop");
        text_.rest_of_line();
        expect("endfacet");
        text_.rest_of_line();
    }

    std::size_t all_;
    Text text_;
};

} // namespace

bool is_text(Span bytes) {
    if (has_binary_size(bytes)) return false;
    static const std::string nameless;
    Text text(as_text(bytes.first(std::min<std::size_t>(bytes.size(), 4096))), nameless, "E-STL");
    if (!same_word(text.word(), "solid")) return false;
    if (!text.next_line()) return true;
    const std::string_view word = text.word();
    return word.empty() || same_word(word, "facet") || same_word(word, "endsolid") || bytes.size() < head;
}

Scene read(const Input& input, const ReadSettings& settings, ReadLog& log) {
    if (is_text(input.bytes())) return TextReader(input).read(input, settings);
    Scene scene;
    scene.parts.push_back(read_binary(input, settings, log));
    return scene;
}

namespace {
const RegisterCodec codec({
    .name = "stl",
    .about = "Stereolithography, text or binary; triangles only, welded exactly",
    .extensions = {"stl"},
    .can = {.shares_vertices = false, .normals = false, .text = true, .attributes = "none"},
    .sniff =
        [](Span bytes) {
            if (is_text(bytes))
                return as_text(bytes.first(std::min<std::size_t>(bytes.size(), 4096))).find("facet") !=
                               std::string_view::npos
                           ? 2
                           : 1;
            return has_binary_size(bytes) && bytes.size() > head ? 2 : 0;
        },
    .read = read,
    .write = write,
});
} // namespace

} // namespace facetmill::io::stl
