#include "io/obj/obj.hpp"

#include "base/progress.hpp"
#include "io/not_finite.hpp"
#include "io/text.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <fmt/format.h>
#include <initializer_list>
#include <limits>

namespace facetmill::io::obj {

namespace {

constexpr std::int32_t absent = std::numeric_limits<std::int32_t>::min();
constexpr float not_given = std::numeric_limits<float>::quiet_NaN(); ///< marks a missing colour
constexpr std::size_t chunk_bytes = std::size_t{1} << 20;

/// A corner as written: an index from 0, or an index relative to the first element of the chunk.
struct Corner {
    std::int32_t index[3] = {absent, absent, absent}; ///< position, uv, normal
};

/// The corners of faces in the usual forms: positions alone, or all three indices.
struct Corners {
    std::vector<std::int32_t> index[3]; ///< as in Corner; uv and normal are empty if all are absent
    /// A bit for each index of each corner; empty if all indices count from the start of the file.
    std::vector<std::uint8_t> relative;
    bool has_more = false; ///< a corner has a uv or a normal

    std::size_t size() const { return index[0].size(); }
    void push_back(const Corner& corner, std::uint8_t bits) {
        index[0].push_back(corner.index[0]);
        if (!has_more && !bits && corner.index[1] == absent && corner.index[2] == absent) return;
        has_more = true;
        const std::size_t before = size() - 1;
        for (int k = 1; k < 3; ++k)
            if (corner.index[k] != absent || !index[k].empty()) {
                index[k].resize(before, absent);
                index[k].push_back(corner.index[k]);
            }
        if (bits || !relative.empty()) {
            relative.resize(before);
            relative.push_back(bits);
        }
    }
    void shrink(std::size_t to) {
        for (auto& indices : index)
            if (!indices.empty()) indices.resize(to);
        if (!relative.empty()) relative.resize(to);
    }
    std::int32_t at(std::size_t corner, int k) const { return index[k].empty() ? absent : index[k][corner]; }
    std::uint8_t bits(std::size_t corner) const { return relative.empty() ? 0 : relative[corner]; }
};

/// The contents of a chunk of lines; counts and relative indices are local to the chunk.
struct Chunk {
    Statements own; ///< all statements except corners
    Corners corners;
    std::vector<std::int32_t> line_corners;
    std::vector<std::uint8_t> line_relative; ///< whether the position's index is relative to the chunk
    std::int64_t lines = 0;
    std::optional<Error> error;
};

class ChunkParser {
  public:
    ChunkParser(std::string_view text, const std::string& name, bool any, Chunk& chunk)
        : text_(text, name, "E-OBJ", '#'), chunk_(chunk), out_(chunk.own), any_(any) {}

    void parse() {
        out_.face_offsets.assign(1, 0);
        out_.line_offsets.assign(1, 0);
        do {
            statement(text_.word_on_line());
        } while (text_.next_line());
        chunk_.lines = text_.line() - 1;
    }

  private:
    void statement(std::string_view word) {
        if (word.empty()) return;
        if (word.size() == 1 && word[0] == 'v') return vertex();
        if (word.size() == 1 && word[0] == 'f') return face();
        if (word == "fo") return face();
        if (word == "l") return line();
        if (word == "vn") return numbers(out_.normals, 3, "normal");
        if (word == "vt") return texture_point();
        if (word == "usemtl") return event(Event::Kind::material);
        if (word == "g") return event(Event::Kind::group);
        if (word == "o") return event(Event::Kind::object);
        if (word == "s") return event(Event::Kind::smoothing);
        if (word == "mtllib") return event(Event::Kind::library);
        ++out_.skipped[std::string(word.substr(0, 20))];
        while (!text_.word_on_line().empty()) {
        } // includes continuation lines
    }

    void vertex() {
        double n[8];
        int count = 0;
        for (; count < 8 && !text_.at_line_end(); ++count)
            n[count] = count < 3 ? coordinate(text_, "a coordinate", any_) : text_.real("a number");
        if (count < 3) text_.fail(fmt::format("expected three coordinates, found {}", count));
        out_.positions.push_back({n[0], n[1], n[2]});
        if (count == 4 && n[3] != 1) ++out_.skipped["w of v"];
        if (count < 6) {
            if (!out_.colours.empty()) out_.colours.insert(out_.colours.end(), 3, not_given);
            return;
        }
        out_.colours.resize((out_.positions.size() - 1) * 3, not_given);
        for (int c = 3; c < 6; ++c) out_.colours.push_back(static_cast<float>(n[c]));
    }

    void numbers(std::vector<float>& to, int wanted, const char* what) {
        for (int c = 0; c < wanted; ++c) {
            if (text_.at_line_end())
                text_.fail(fmt::format("expected {} numbers of a {}, found {}", wanted, what, c));
            to.push_back(static_cast<float>(text_.real("a number")));
        }
    }

    void texture_point() {
        if (text_.at_line_end()) text_.fail("expected the numbers of a texture point, found none");
        out_.uvs.push_back(static_cast<float>(text_.real("a number")));
        out_.uvs.push_back(text_.at_line_end() ? 0.0F : static_cast<float>(text_.real("a number")));
    }

    void event(Event::Kind kind) {
        out_.events.push_back(
            {kind, out_.faces(), out_.positions.size(), out_.lines(), std::string(text_.rest_of_line())});
    }

    void line() {
        const std::size_t first = chunk_.corners.size();
        while (!text_.at_line_end()) corner();
        bool has_texture_points = false;
        for (std::size_t i = first; i < chunk_.corners.size(); ++i) {
            has_texture_points |= chunk_.corners.at(i, 1) != absent;
            chunk_.line_corners.push_back(chunk_.corners.at(i, 0));
            chunk_.line_relative.push_back(chunk_.corners.bits(i) & 1);
        }
        if (has_texture_points) ++out_.skipped["texture points of l"];
        chunk_.corners.shrink(first);
        out_.line_offsets.push_back(static_cast<Index>(chunk_.line_corners.size()));
    }

    void face() {
        const std::size_t first = chunk_.corners.size();
        while (!text_.at_line_end()) corner();
        if (chunk_.corners.size() - first < 3) {
            chunk_.corners.shrink(first);
            ++out_.short_faces;
        } else {
            out_.face_offsets.push_back(static_cast<Index>(chunk_.corners.size()));
        }
    }

    /// v, v/vt, v//vn, v/vt/vn; a trailing slash is accepted.
    void corner() {
        Corner corner;
        if (text_.take_natural(corner.index[0])) { // the usual form
            --corner.index[0];
            return chunk_.corners.push_back(corner, 0);
        }
        const Text start = text_;
        std::uint8_t relative = 0;
        const std::size_t counts[3] = {out_.positions.size(), out_.uvs.size() / 2, out_.normals.size() / 3};
        for (int k = 0; k < 3; ++k) {
            std::int64_t index = 0;
            if (text_.take(index)) {
                if (index == 0) text_.fail("indices count from 1, found 0");
                if (index > INT32_MAX || index < -INT32_MAX)
                    text_.fail(fmt::format("index {} is out of range", index));
                if (index < 0) relative |= static_cast<std::uint8_t>(1 << k);
                corner.index[k] = static_cast<std::int32_t>(
                    index > 0 ? index - 1 : static_cast<std::int64_t>(counts[k]) + index);
            } else if (k == 0) {
                break;
            }
            if (!text_.take('/')) break;
        }
        if (corner.index[0] == absent || !text_.at_word_end()) {
            Text again = start;
            again.expected("a corner (v, v/vt, v//vn or v/vt/vn)");
        }
        chunk_.corners.push_back(corner, relative);
    }

    Text text_;
    Chunk& chunk_;
    Statements& out_;
    bool any_; ///< accepts coordinates that are not finite; they are dropped later
};

/// Splits the text into pieces of about chunk_bytes at line ends that are not continued.
std::vector<std::string_view> pieces(std::string_view text) {
    std::vector<std::string_view> all;
    while (text.size() > chunk_bytes) {
        std::size_t end = chunk_bytes;
        while (true) {
            end = text.find('\n', end);
            if (end == std::string_view::npos) break;
            const char before = end > 1 && text[end - 1] == '\r' ? text[end - 2] : text[end - 1];
            ++end;
            if (before != '\\') break;
        }
        if (end == std::string_view::npos) break;
        all.push_back(text.substr(0, end));
        text.remove_prefix(end);
    }
    all.push_back(text);
    return all;
}

/// The first error of the file, its line counted from the beginning.
void rethrow_first(const std::vector<Chunk>& chunks, const std::string& name) {
    std::int64_t before = 0;
    for (const auto& chunk : chunks) {
        if (chunk.error) {
            Diagnostic d = chunk.error->diagnostics().front();
            malformed(name, d.where.line + before, d.id.c_str(), d.message, d.hint);
        }
        before += chunk.lines;
    }
}

/// The line of the statement with this number, counted from 0 among statements with one of these words and
/// at least `least` corners.
std::int64_t line_of(const Input& input, std::initializer_list<std::string_view> words, int least,
                     std::size_t number) {
    Text text(as_text(input.bytes()), input.name(), "E-OBJ", '#');
    std::size_t met = 0;
    do {
        const std::string_view word = text.word_on_line();
        const std::int64_t line = text.line();
        if (std::find(words.begin(), words.end(), word) == words.end()) continue;
        int corners = 0;
        while (!text.word_on_line().empty()) ++corners;
        if (corners >= least && met++ == number) return line;
    } while (text.next_line());
    return 0;
}

struct Counts {
    std::size_t element[3] = {0, 0, 0}; ///< positions, uvs, normals
    std::size_t corners = 0, faces = 0, line_points = 0, lines = 0;
};

/// Joins the chunks and makes relative indices absolute.
class Joiner {
  public:
    Joiner(const Input& input, std::vector<Chunk>& chunks)
        : input_(input), chunks_(chunks), before_(chunks.size() + 1), dangling_(chunks.size()) {
        for (std::size_t c = 0; c < chunks.size(); ++c) {
            const Statements& own = chunks[c].own;
            const std::size_t sizes[3] = {own.positions.size(), own.uvs.size() / 2, own.normals.size() / 3};
            for (int k = 0; k < 3; ++k) before_[c + 1].element[k] = before_[c].element[k] + sizes[k];
            before_[c + 1].corners = before_[c].corners + chunks[c].corners.size();
            before_[c + 1].faces = before_[c].faces + own.faces();
            before_[c + 1].line_points = before_[c].line_points + chunks[c].line_corners.size();
            before_[c + 1].lines = before_[c].lines + own.lines();
        }
    }

    Statements join(const ReadSettings& settings) {
        const Counts& all = before_.back();
        if (all.element[0] > settings.max_vertices || all.element[0] >= none || all.corners >= none ||
            all.line_points >= none)
            beyond_limit(input_.name(),
                         fmt::format("{} vertices and {} corners are more than facetmill supports",
                                     all.element[0], all.corners + all.line_points));
        bool coloured = false, keyed = false;
        for (const auto& chunk : chunks_) coloured |= !chunk.own.colours.empty();
        for (const auto& chunk : chunks_)
            for (const auto* indices : {&chunk.corners.index[1], &chunk.corners.index[2]})
                keyed |= std::any_of(indices->begin(), indices->end(), [](auto i) { return i != absent; });
        out_.positions.resize(all.element[0]);
        out_.uvs.resize(all.element[1] * 2);
        out_.normals.resize(all.element[2] * 3);
        out_.colours.assign(coloured ? all.element[0] * 3 : 0, not_given);
        out_.corners.resize(all.corners);
        out_.corner_keys.resize(keyed ? all.corners : 0);
        out_.face_offsets.resize(all.faces + 1);
        out_.line_points.resize(all.line_points);
        out_.line_offsets.resize(all.lines + 1);
        std::vector<std::size_t> bad(chunks_.size(), SIZE_MAX);
        ProgressScope::report_next_loop();
        parallel_for(
            chunks_.size(), [&](std::size_t c) { bad[c] = join_chunk(c); }, 1);
        for (const std::size_t corner : bad)
            if (corner != SIZE_MAX) refuse(corner);
        for (std::size_t c = 0; c < chunks_.size(); ++c) join_lines(c);
        for (std::size_t c = 0; c < chunks_.size(); ++c) join_rest(c);
        for (const std::size_t count : dangling_) out_.dangling += count;
        return std::move(out_);
    }

  private:
    /// Copies a chunk. Returns the first corner (of the file) with an invalid position index, or SIZE_MAX.
    std::size_t join_chunk(std::size_t c) {
        Statements& own = chunks_[c].own;
        const Counts& base = before_[c];
        std::copy(own.positions.begin(), own.positions.end(),
                  out_.positions.begin() + static_cast<std::ptrdiff_t>(base.element[0]));
        std::copy(own.uvs.begin(), own.uvs.end(),
                  out_.uvs.begin() + static_cast<std::ptrdiff_t>(2 * base.element[1]));
        std::copy(own.normals.begin(), own.normals.end(),
                  out_.normals.begin() + static_cast<std::ptrdiff_t>(3 * base.element[2]));
        std::copy(own.colours.begin(), own.colours.end(),
                  out_.colours.begin() +
                      static_cast<std::ptrdiff_t>(own.colours.empty() ? 0 : 3 * base.element[0]));
        for (std::size_t f = 0; f < own.faces(); ++f)
            out_.face_offsets[base.faces + f + 1] =
                static_cast<Index>(base.corners + own.face_offsets[f + 1]);
        const std::size_t corners = chunks_[c].corners.size();
        std::size_t i = 0;
        if (!chunks_[c].corners.has_more && out_.corner_keys.empty())
            while (i < corners && resolve_position(c, i)) ++i;
        else
            while (i < corners && resolve(c, i)) ++i;
        return i < corners ? base.corners + i : SIZE_MAX;
    }

    /// Like resolve, for a chunk with positions only, counted from the start of the file.
    bool resolve_position(std::size_t c, std::size_t i) {
        const auto vertex = static_cast<Index>(chunks_[c].corners.index[0][i]);
        out_.corners[before_[c].corners + i] = vertex;
        return vertex < out_.positions.size();
    }

    bool resolve(std::size_t c, std::size_t i) {
        const Corners& corners = chunks_[c].corners;
        const std::uint8_t relative = corners.bits(i);
        Index found[3] = {none, none, none};
        for (int k = 0; k < 3; ++k) {
            const bool from_here = relative >> k & 1;
            const std::int32_t given = corners.at(i, k);
            if (given == absent && !from_here) continue;
            const std::int64_t index =
                given + (from_here ? static_cast<std::int64_t>(before_[c].element[k]) : 0);
            if (index >= 0 && index < static_cast<std::int64_t>(before_.back().element[k]))
                found[k] = static_cast<Index>(index);
            else if (k == 0)
                return false;
            else
                ++dangling_[c]; // the surface is complete without this index
        }
        const std::size_t at = before_[c].corners + i;
        out_.corners[at] = found[0];
        if (!out_.corner_keys.empty()) out_.corner_keys[at] = std::uint64_t{found[1]} << 32 | found[2];
        return true;
    }

    void join_lines(std::size_t c) {
        const Chunk& chunk = chunks_[c];
        for (std::size_t l = 0; l < chunk.own.lines(); ++l) {
            for (Index i = chunk.own.line_offsets[l]; i < chunk.own.line_offsets[l + 1]; ++i) {
                const std::int64_t index =
                    chunk.line_corners[i] +
                    (chunk.line_relative[i] ? static_cast<std::int64_t>(before_[c].element[0]) : 0);
                if (index < 0 || index >= static_cast<std::int64_t>(before_.back().element[0]))
                    refuse("a line", line_of(input_, {"l"}, 0, before_[c].lines + l));
                out_.line_points[before_[c].line_points + i] = static_cast<Index>(index);
            }
            out_.line_offsets[before_[c].lines + l + 1] =
                static_cast<Index>(before_[c].line_points + chunk.own.line_offsets[l + 1]);
        }
    }

    [[noreturn]] void refuse(std::size_t corner) {
        const auto at =
            std::upper_bound(out_.face_offsets.begin(), out_.face_offsets.end(), static_cast<Index>(corner));
        const auto face = static_cast<std::size_t>(at - out_.face_offsets.begin()) - 1;
        refuse("a face", line_of(input_, {"f", "fo"}, 3, face));
    }

    [[noreturn]] void refuse(const char* what, std::int64_t line) {
        malformed(input_.name(), line, "E-OBJ",
                  fmt::format("{} refers to a vertex that does not exist: the file has {}", what,
                              before_.back().element[0]));
    }

    void join_rest(std::size_t c) {
        for (auto& e : chunks_[c].own.events) {
            e.face += before_[c].faces;
            e.vertex += before_[c].element[0];
            e.line += before_[c].lines;
            out_.events.push_back(std::move(e));
        }
        for (const auto& [word, count] : chunks_[c].own.skipped) out_.skipped[word] += count;
        out_.short_faces += chunks_[c].own.short_faces;
    }

    const Input& input_;
    std::vector<Chunk>& chunks_;
    std::vector<Counts> before_;        ///< [chunks + 1]
    std::vector<std::size_t> dangling_; ///< [chunks]
    Statements out_;
};

} // namespace

Statements parse(const Input& input, const ReadSettings& settings) {
    ProgressSteps steps({5, 1});
    const auto texts = pieces(as_text(input.bytes()));
    std::vector<Chunk> chunks(texts.size());
    ProgressScope::report_next_loop();
    parallel_for(
        texts.size(),
        [&](std::size_t c) {
            try {
                ChunkParser(texts[c], input.name(), settings.drop_not_finite, chunks[c]).parse();
                input.release(std::as_bytes(std::span(texts[c])));
            } catch (const Error& error) {
                chunks[c].error = error;
            }
        },
        1);
    rethrow_first(chunks, input.name());
    steps.next();
    return Joiner(input, chunks).join(settings);
}

} // namespace facetmill::io::obj
