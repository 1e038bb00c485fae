#include "cells/sources/ply_rows.hpp"

#include "cells/sources/rows.hpp"
#include "cells/sources/text_window.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <limits>

namespace facetmill::cells {

namespace {

namespace ply = io::ply;

bool is_index_list(const ply::Property& p) {
    return p.list && (p.name == "vertex_indices" || p.name == "vertex_index");
}

bool has_list(const ply::Element& e) {
    return std::any_of(e.properties.begin(), e.properties.end(), [](const auto& p) { return p.list; });
}

/// The locations of vertices and faces in a binary file.
Rows rows_of(const io::Input& input, const std::shared_ptr<const ReadFile>& file, const ply::Header& header) {
    const std::uint64_t bytes = input.bytes().size();
    Rows rows;
    rows.swap = header.encoding == ply::Encoding::big_endian;
    std::uint64_t at = header.size;
    for (const auto& e : header.elements) {
        if (e.name == "vertex") {
            rows.vertices_at = at;
            rows.vertex_count = e.count;
            rows.vertex = e.properties;
            rows.vertex_line = e.line;
        }
        if (e.name == "face") {
            rows.faces_at = at;
            rows.faces_end = bytes;
            rows.face_count = e.count;
            rows.face = e.properties;
            rows.face_line = e.line;
            break;
        }
        if (e.count > bytes / std::max<std::size_t>(1, row_size(e.properties)))
            ends_in(input.name(), bytes, e.name, 0, e.count);
        at += e.count * row_size(e.properties);
    }
    if (at > bytes)
        ends_in(input.name(), bytes, "vertex", (bytes - rows.vertices_at) / row_size(rows.vertex),
                rows.vertex_count);
    rows.vertices = rows.faces = file;
    return rows;
}

void name_dropped(const ply::Header& header, std::vector<std::string>& dropped) {
    for (const auto& e : header.elements) {
        if (e.name != "vertex" && e.name != "face" && e.count > 0)
            dropped.push_back(fmt::format("element '{}' ({})", e.name, e.count));
        for (const auto& p : e.properties)
            if (e.name == "face" && !p.list) dropped.push_back(fmt::format("'{}' of faces", p.name));
    }
}

bool is_coordinate(const ply::Property& p) { return p.name == "x" || p.name == "y" || p.name == "z"; }

/// Vertex properties except the position.
std::vector<ply::Property> others(const std::vector<ply::Property>& properties) {
    std::vector<ply::Property> all;
    for (const auto& p : properties)
        if (!is_coordinate(p)) all.push_back(p);
    return all;
}

class PlyReader final : public RowReader {
  public:
    PlyReader(const io::Input& input, const io::ReadSettings& settings)
        : input_(input), header_(ply::read_header(input_)),
          identity_(settings.weld == io::Weld::exact ? Identity::place : Identity::number) {
        for (const auto& e : header_.elements)
            if (e.name == "vertex") {
                extra = others(e.properties);
                if (std::all_of(e.properties.begin(), e.properties.end(), [](const ply::Property& p) {
                        return !is_coordinate(p) || p.type == ply::Type::float32;
                    }))
                    coordinate = ply::Type::float32;
            }
        name_dropped(header_, dropped);
    }

    std::string read(const std::shared_ptr<const ReadFile>& file, RowWriter& out, bool with_extra) override {
        out.begin_group(identity_);
        base_ = static_cast<std::uint32_t>(out.vertices());
        return header_.encoding == ply::Encoding::ascii ? read_text(*file, out, with_extra)
                                                        : read_binary(file, out, with_extra);
    }

  private:
    void give(RowWriter& out, std::vector<std::uint32_t>& corners) const {
        for (std::uint32_t& corner : corners) corner += base_;
        out.face(corners);
    }

    std::string read_binary(const std::shared_ptr<const ReadFile>& file, RowWriter& out, bool with_extra) {
        const Rows rows = rows_of(input_, file, header_);
        Sha256 sum;
        Stream all(*rows.vertices, 0, input_.bytes().size(), &sum);
        io::Bytes more;
        const Coordinates coordinates(rows, input_.name());
        const std::size_t stride = row_size(rows.vertex);
        all.skip(rows.vertices_at);
        for (std::uint64_t v = 0; v < rows.vertex_count; ++v) {
            const std::byte* row = all.take(stride);
            const Vec3 p = finite_place(coordinates, row, v, input_.name());
            more.clear();
            for (const auto& property : rows.vertex) {
                const std::size_t size = ply::size_of(property.type);
                if (with_extra && !is_coordinate(property)) {
                    more.insert(more.end(), row, row + size);
                    if (rows.swap) std::reverse(more.end() - static_cast<std::ptrdiff_t>(size), more.end());
                }
                row += size;
            }
            out.vertex(p, more);
        }
        all.skip(rows.faces_at - rows.vertices_at - rows.vertex_count * row_size(rows.vertex));
        std::vector<std::uint32_t> corners;
        for (std::uint64_t f = 0; f < rows.face_count; ++f) {
            read_face(rows, input_.name(), f, all, corners);
            give(out, corners);
        }
        all.skip(all.left());
        return sum.digest();
    }

    std::string read_text(const ReadFile& file, RowWriter& out, bool with_extra) {
        Sha256 sum;
        sum.add(input_.bytes().first(header_.size));
        TextWindow window(file, header_.size, input_.bytes().size(), input_.name(), "E-PLY", 0, &sum,
                          header_.lines + 1);
        for (const auto& e : header_.elements) {
            for (std::uint64_t i = 0; i < e.count && !e.properties.empty(); ++i) {
                if (e.name == "vertex")
                    read_vertex(window, e, out, with_extra);
                else
                    read_item(window, e, i, e.name == "face" ? &out : nullptr);
            }
            if (e.name == "vertex") count_ = e.count;
        }
        while (!window.at_end()) window.item([](io::Text& text) { text.word(); });
        return sum.digest();
    }

    /// Appends the number in a binary file's form.
    static void put(io::Text& text, const ply::Property& p, double value, io::Bytes& to) {
        AttributeData one = ply::array_of(p.type);
        std::visit(
            [&](auto& values) {
                using T = typename std::decay_t<decltype(values)>::value_type;
                if constexpr (std::is_integral_v<T>)
                    if (!(value >= static_cast<double>(std::numeric_limits<T>::min()) &&
                          value <= static_cast<double>(std::numeric_limits<T>::max())))
                        text.fail(fmt::format("{} does not fit the type of '{}'", value, p.name));
                const T number = static_cast<T>(value);
                const auto raw = std::as_bytes(std::span(&number, 1));
                to.insert(to.end(), raw.begin(), raw.end());
            },
            one);
    }

    /// A coordinate rounded to the file's type.
    static double rounded(const ply::Property& p, double value) {
        return p.type == ply::Type::float32 ? static_cast<double>(static_cast<float>(value)) : value;
    }

    void read_vertex(TextWindow& window, const ply::Element& e, RowWriter& out, bool with_extra) {
        Vec3 p;
        window.item([&](io::Text& text) {
            more_.clear();
            for (const auto& property : e.properties) {
                const double value = text.real(property.name.c_str());
                if (is_coordinate(property)) {
                    io::Bytes ignored;
                    if (property.type != ply::Type::float32 && property.type != ply::Type::float64)
                        put(text, property, value, ignored);
                    p[static_cast<std::size_t>(property.name[0] - 'x')] = rounded(property, value);
                } else if (with_extra) {
                    put(text, property, value, more_);
                }
            }
        });
        if (!is_finite(p))
            io::malformed(input_.name(), 0, "E-NAN",
                          fmt::format("vertex {} is at ({}, {}, {}), expected finite numbers",
                                      out.vertices() - base_, p.x, p.y, p.z),
                          not_finite_hint);
        out.vertex(p, more_);
    }

    /// faces: receives the faces; null for skipped elements.
    void read_item(TextWindow& window, const ply::Element& e, std::uint64_t number, RowWriter* faces) {
        window.item([&](io::Text& text) {
            corners_.clear();
            for (const auto& property : e.properties) {
                const char* const name = property.name.c_str();
                std::int64_t n = 1;
                if (property.list) {
                    n = text.integer("the length of a list");
                    if (n < 0 || static_cast<std::uint64_t>(n) > window.left() / 2 + 1)
                        text.fail(
                            fmt::format("a list of {} values, which the rest of the file cannot hold", n));
                }
                for (; n > 0; --n) {
                    const double value = text.real(name);
                    if (!faces || !property.list) continue;
                    if (!(value >= 0 && value < static_cast<double>(count_)))
                        io::malformed(input_.name(), e.line, "E-PLY",
                                      fmt::format("face {} of {} refers to vertex {}, but the file has {}",
                                                  number, e.count, value, count_));
                    corners_.push_back(static_cast<std::uint32_t>(value));
                }
            }
        });
        if (faces) give(*faces, corners_);
    }

    io::Input input_;
    const ply::Header header_;
    Identity identity_;
    std::uint32_t base_ = 0;
    std::uint64_t count_ = 0;
    io::Bytes more_;
    std::vector<std::uint32_t> corners_;
};

} // namespace

std::optional<std::string> why_ply_not_streamed(const io::Input& input) {
    const ply::Header header = ply::read_header(input);
    const ply::Element *vertices = nullptr, *faces = nullptr;
    for (const auto& e : header.elements) {
        if (e.name == "tristrips") return "it has triangle strips";
        if (e.name == "vertex") vertices = &e;
        if (e.name == "face") faces = &e;
        if (e.name == "face" && !vertices) return "its faces come before its vertices";
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

bool is_text_ply(const io::Input& input) { return ply::read_header(input).encoding == ply::Encoding::ascii; }

std::unique_ptr<FaceSource> open_ply(FaceSource::File file, const io::ReadSettings& settings,
                                     FaceSource::Contents contents) {
    const ply::Header header = ply::read_header(file.input);
    Rows rows = rows_of(file.input, file.file, header);
    name_dropped(header, contents.dropped);
    file.is_rows = true;
    contents.files.push_back(std::move(file));
    return source_of(std::move(rows), std::move(contents), settings);
}

std::unique_ptr<RowReader> ply_rows(const io::Input& input, const io::ReadSettings& settings) {
    return std::make_unique<PlyReader>(input, settings);
}

} // namespace facetmill::cells
