// Wavefront OBJ as rows: positions, vertex colours after them, and faces. Texture coordinates, normals,
// materials and groups are dropped and reported.

#include "cells/sources/rows.hpp"
#include "cells/sources/text_window.hpp"
#include "io/obj/obj.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace facetmill::cells {

namespace {

constexpr std::size_t with_colour = 6; ///< count of numbers in a vertex with a colour
constexpr std::size_t longest_word = 20;

/// The kind and data of a statement.
struct Statement {
    enum class Kind { other, vertex, face };
    Kind kind = Kind::other;
    std::string word; ///< keyword of other statements
    std::array<double, 8> numbers{};
    std::size_t count = 0;             ///< count of numbers
    std::vector<std::int64_t> corners; ///< as written: from 1; negative: relative to the last vertex
    std::int64_t line = 0;
};

class ObjReader final : public RowReader {
  public:
    ObjReader(const io::Input& input, const io::ReadSettings& settings)
        : input_(input), identity_(settings.weld == io::Weld::exact ? Identity::place : Identity::number) {
        io::Text text(
            io::as_text(input_.bytes().first(std::min<std::size_t>(input_.bytes().size(), 1 << 20))),
            input_.name(), "E-OBJ", '#');
        bool is_first = true, whole = true;
        double largest = 0;
        do {
            if (text.word_on_line() != "v") continue;
            std::size_t count = 0;
            for (std::string_view word = text.word_on_line(); !word.empty(); word = text.word_on_line()) {
                const char* at = word.data();
                double number = 0;
                if (++count <= 3 || count > with_colour ||
                    !io::scan_real(at, word.data() + word.size(), number))
                    continue;
                largest = std::max(largest, number);
                whole = whole && number == std::floor(number);
            }
            if (is_first && count < with_colour) return;
            if (std::exchange(is_first, false))
                for (const char* name : {"red", "green", "blue"})
                    extra.push_back({name, io::ply::Type::float32});
        } while (text.next_line());
        if (io::obj::count_to_255(largest, whole)) of_one_ = 255;
    }

    std::string read(const std::shared_ptr<const ReadFile>& file, RowWriter& out, bool with_extra) override {
        Sha256 sum;
        TextWindow window(*file, 0, input_.bytes().size(), input_.name(), "E-OBJ", '#', &sum);
        out.begin_group(identity_);
        const std::uint64_t base = out.vertices();
        std::int64_t highest = 0; // highest vertex that faces use, from 1
        Statement s;
        while (window.left() > 0) {
            window.item([&](io::Text& text) { parse(text, s); });
            const auto known = static_cast<std::int64_t>(out.vertices() - base);
            if (s.kind == Statement::Kind::vertex)
                vertex(out, s, with_extra && !extra.empty());
            else if (s.kind == Statement::Kind::face)
                highest = std::max(highest, face(out, s, base, known));
            else
                note(s.word);
        }
        const auto all = static_cast<std::int64_t>(out.vertices() - base);
        if (highest > all) refuse(first_bad(*file, all), all);
        for (const auto& [there, what] :
             {std::pair{uvs_, "texture coordinates"}, std::pair{normals_, "normals"},
              std::pair{materials_, "materials"}, std::pair{groups_ > 1, "objects and groups"},
              std::pair{lines_, "lines and points"}, std::pair{late_colours_, "colours of vertices"}})
            if (there) dropped.emplace_back(what);
        return sum.digest();
    }

  private:
    /// Parses a statement up to the beginning of the next line.
    void parse(io::Text& text, Statement& s) const {
        s.kind = Statement::Kind::other;
        s.count = 0;
        s.corners.clear();
        const std::string_view word = text.word_on_line();
        s.line = text.line();
        if (word == "v") {
            s.kind = Statement::Kind::vertex;
            for (; s.count < s.numbers.size() && !text.at_line_end(); ++s.count)
                s.numbers[s.count] = s.count < 3 ? text.coordinate("a coordinate") : text.real("a number");
            if (s.count < 3) text.fail(fmt::format("expected three coordinates, found {}", s.count));
        } else if (word == "f" || word == "fo") {
            s.kind = Statement::Kind::face;
            while (!text.at_line_end()) s.corners.push_back(corner(text));
        } else {
            s.word.assign(word.substr(0, longest_word));
            while (!text.word_on_line().empty()) {
            } // includes continuation lines
        }
        text.next_line();
    }

    void note(std::string_view word) {
        uvs_ |= word == "vt";
        normals_ |= word == "vn";
        materials_ |= word == "usemtl";
        groups_ += word == "o" || word == "g";
        lines_ |= word == "l" || word == "p";
    }

    /// v, v/vt, v//vn, v/vt/vn; a trailing slash is accepted. Returns the position's index.
    static std::int64_t corner(io::Text& text) {
        const io::Text start = text;
        std::int64_t found = 0;
        for (int k = 0; k < 3; ++k) {
            std::int64_t index = 0;
            if (text.take(index)) {
                if (index == 0) text.fail("indices count from 1, found 0");
                if (index > INT32_MAX || index < -INT32_MAX)
                    text.fail(fmt::format("index {} is out of range", index));
                if (k == 0) found = index;
            } else if (k == 0) {
                break;
            }
            if (!text.take('/')) break;
        }
        if (found == 0 || !text.at_word_end()) {
            io::Text again = start;
            again.expected("a corner (v, v/vt, v//vn or v/vt/vn)");
        }
        return found;
    }

    void vertex(RowWriter& out, const Statement& s, bool coloured) {
        std::array<float, 3> colour{1, 1, 1}; // the default without a colour in the file
        for (std::size_t c = 0; s.count >= with_colour && c < 3; ++c) {
            colour[c] = static_cast<float>(s.numbers[3 + c]);
            if (of_one_ > 1) colour[c] = std::min(colour[c] / of_one_, 1.0F);
        }
        late_colours_ |= s.count >= with_colour && extra.empty();
        out.vertex({s.numbers[0], s.numbers[1], s.numbers[2]},
                   coloured ? std::as_bytes(std::span(colour)) : io::Span{});
    }

    /// Returns the highest vertex that the face names, from 1, because vertices may follow their faces.
    std::int64_t face(RowWriter& out, const Statement& s, std::uint64_t base, std::int64_t known) {
        std::int64_t highest = 0;
        rows_.clear();
        for (const std::int64_t index : s.corners) {
            const std::int64_t number = index > 0 ? index : known + 1 + index;
            if (number < 1 && s.corners.size() >= 3) refuse(s.line, known);
            highest = std::max(highest, number);
            rows_.push_back(static_cast<std::uint32_t>(base + static_cast<std::uint64_t>(number) - 1));
        }
        out.face(rows_);
        return s.corners.size() >= 3 ? highest : 0;
    }

    /// The line of the first face that names a missing vertex.
    std::int64_t first_bad(const ReadFile& file, std::int64_t all) const {
        TextWindow window(file, 0, input_.bytes().size(), input_.name(), "E-OBJ", '#', nullptr);
        Statement s;
        while (window.left() > 0) {
            window.item([&](io::Text& text) { parse(text, s); });
            if (s.kind == Statement::Kind::face && s.corners.size() >= 3 &&
                *std::max_element(s.corners.begin(), s.corners.end()) > all)
                return s.line;
        }
        return 0;
    }

    [[noreturn]] void refuse(std::int64_t line, std::int64_t all) const {
        io::malformed(input_.name(), line, "E-OBJ",
                      fmt::format("a face refers to a vertex that does not exist: the file has {}", all));
    }

    io::Input input_;
    Identity identity_;
    std::vector<std::uint32_t> rows_;
    /// Contents of the file that rows do not hold.
    bool uvs_ = false, normals_ = false, materials_ = false, lines_ = false, late_colours_ = false;
    float of_one_ = 1; ///< the number of a full colour in the file, from its beginning
    std::size_t groups_ = 0;
};

} // namespace

std::unique_ptr<RowReader> obj_rows(const io::Input& input, const io::ReadSettings& settings) {
    return std::make_unique<ObjReader>(input, settings);
}

} // namespace facetmill::cells
