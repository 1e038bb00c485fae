// OFF text as rows: positions and faces. Normals, colours and texture coordinates are dropped and reported.

#include "cells/sources/off_rows.hpp"

#include "cells/sources/rows.hpp"
#include "cells/sources/text_window.hpp"
#include "io/off/off.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::cells {

namespace {

class OffReader final : public RowReader {
  public:
    OffReader(const io::Input& input, const io::ReadSettings& settings)
        : input_(input), identity_(settings.weld == io::Weld::exact ? Identity::place : Identity::number) {}

    std::string read(const std::shared_ptr<const ReadFile>& file, RowWriter& out, bool) override {
        Sha256 sum;
        TextWindow window(*file, 0, input_.bytes().size(), input_.name(), "E-OFF", '#', &sum);
        out.begin_group(identity_);
        base_ = static_cast<std::uint32_t>(out.vertices());
        std::int64_t vertices = 0, faces = 0;
        window.item([&](io::Text& text) {
            kind_ = io::off::read_kind(text);
            vertices = text.integer("the number of vertices");
            faces = text.integer("the number of faces");
            check(text, vertices, faces, text.left() + window.left() - window.text().left());
            text.rest_of_line(); // the number of edges, if given, is unused
        });
        for (std::int64_t v = 0; v < vertices; ++v) vertex(window, out);
        for (std::int64_t f = 0; f < faces; ++f) face(window, vertices, out);
        while (!window.at_end()) window.item([](io::Text& text) { text.word(); });
        if (kind_.normals) dropped.emplace_back("normals");
        if (kind_.colours) dropped.emplace_back("colours of vertices");
        if (kind_.uvs) dropped.emplace_back("texture coordinates");
        if (face_colours_) dropped.emplace_back("colours of faces");
        return sum.digest();
    }

  private:
    /// Refuses counts that the remaining bytes cannot fill.
    static void check(const io::Text& text, std::int64_t vertices, std::int64_t faces, std::uint64_t left) {
        constexpr std::uint64_t per_vertex = 6, per_face = 2;
        if (vertices < 0 || faces < 0)
            text.fail(
                fmt::format("expected counts of 0 or more, found {} vertices and {} faces", vertices, faces));
        if (static_cast<std::uint64_t>(vertices) > (left + 1) / per_vertex ||
            static_cast<std::uint64_t>(faces) > (left + 1) / per_face)
            text.fail(fmt::format(
                "the header gives {} vertices and {} faces, but the remaining {} bytes cannot hold them",
                vertices, faces, left));
    }

    /// Skips a colour of at most four numbers. The last `more` numbers of the line are not part of it.
    static void pass_colour(io::Text& text, int more) {
        int left = 0;
        for (io::Text ahead = text; !ahead.word_on_line().empty();) ++left;
        for (int c = std::clamp(left - more, 0, 4); c > 0; --c) text.real("a colour");
    }

    void vertex(TextWindow& window, RowWriter& out) const {
        Vec3 p;
        window.item([&](io::Text& text) {
            const double x = text.coordinate("x"), y = text.coordinate("y"), z = text.coordinate("z");
            p = {x, y, z};
            for (int c = 0; kind_.normals && c < 3; ++c) text.real("a normal");
            if (kind_.colours) pass_colour(text, kind_.uvs ? 2 : 0);
            for (int c = 0; kind_.uvs && c < 2; ++c) text.real(c == 0 ? "u" : "v");
        });
        out.vertex(p, {});
    }

    void face(TextWindow& window, std::int64_t vertices, RowWriter& out) {
        window.item([&](io::Text& text) {
            corners_.clear();
            const std::int64_t n = text.integer("the number of corners");
            if (n < 0 || static_cast<std::uint64_t>(n) > window.left() / 2 + 1)
                text.fail(fmt::format("a face of {} corners, which the rest of the file cannot hold", n));
            for (std::int64_t k = 0; k < n; ++k) {
                const std::int64_t v = text.integer("a vertex");
                if (v < 0 || v >= vertices)
                    text.fail(fmt::format("a face refers to vertex {}, but the file has {}", v, vertices));
                corners_.push_back(base_ + static_cast<std::uint32_t>(v));
            }
            face_colours_ |= !text.at_line_end();
            pass_colour(text, 0);
        });
        out.face(corners_);
    }

    io::Input input_;
    Identity identity_;
    io::off::Kind kind_{};
    std::uint32_t base_ = 0;
    bool face_colours_ = false;
    std::vector<std::uint32_t> corners_;
};

} // namespace

std::optional<std::string> why_off_not_streamed(const io::Input& input) {
    io::Text text(io::as_text(input.bytes().first(std::min<std::size_t>(input.bytes().size(), 4096))),
                  input.name(), "E-OFF", '#');
    return io::off::read_kind(text).binary ? std::optional<std::string>("it is binary OFF") : std::nullopt;
}

std::uint64_t off_faces(const io::Input& input) {
    io::Text text(io::as_text(input.bytes().first(std::min<std::size_t>(input.bytes().size(), 4096))),
                  input.name(), "E-OFF", '#');
    io::off::read_kind(text);
    text.integer("the number of vertices");
    return static_cast<std::uint64_t>(std::max<std::int64_t>(text.integer("the number of faces"), 0));
}

std::unique_ptr<RowReader> off_rows(const io::Input& input, const io::ReadSettings& settings) {
    return std::make_unique<OffReader>(input, settings);
}

} // namespace facetmill::cells
