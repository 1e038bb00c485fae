#include "io/off/off.hpp"

#include "base/progress.hpp"
#include "io/flatten.hpp"
#include "io/metadata.hpp"
#include "io/stated.hpp"

#include <fmt/format.h>

namespace facetmill::io::off {

namespace {

/// A colour attribute that OFF can hold in this domain, or null.
const Attribute* colours_of(const Mesh& mesh, Domain domain) {
    const Attribute* a = mesh.find("COLOR_0", domain);
    return a && (a->components == 3 || a->components == 4) ? a : nullptr;
}

/// Writes " 255 0 0 255" for bytes and " 1.0 0.0 0.0" for fractions, so that readers can distinguish them by
/// the decimal point.
void put_colour(std::string& out, const Attribute& a, std::size_t i) {
    const auto* bytes = std::get_if<std::vector<std::uint8_t>>(&a.data);
    const auto n = static_cast<std::size_t>(a.components);
    for (std::size_t c = 0; c < n; ++c) {
        out += ' ';
        if (bytes) {
            put_number(out, static_cast<std::int64_t>((*bytes)[i * n + c]));
            continue;
        }
        const std::size_t before = out.size();
        put_number(out, static_cast<float>(a.value(i, static_cast<int>(c))));
        if (out.find_first_of(".e", before) == std::string::npos) out += ".0";
    }
}

struct Rows {
    const Mesh& mesh;
    bool split; ///< a row per wedge, because OFF has a single colour per vertex
    std::size_t count() const { return split ? mesh.wedge_count() : mesh.vertex_count(); }
    Index vertex(std::size_t row) const {
        return split ? mesh.vertex_of_wedge(static_cast<Index>(row)) : static_cast<Index>(row);
    }
    Index of(Index wedge) const { return split ? wedge : mesh.vertex_of_wedge(wedge); }
};

/// The wedge of each row.
std::vector<Index> row_wedges(const Rows& rows) {
    std::vector<Index> wedges(rows.count(), none);
    for (Index w = 0; w < rows.mesh.wedge_count(); ++w)
        if (Index& slot = wedges[rows.of(w)]; slot == none) slot = w;
    return wedges;
}

/// Whether wedges of a vertex have different colours: only then is a split needed.
bool colours_differ(const Mesh& mesh, const Attribute& a) {
    const std::vector<Index> first = row_wedges({mesh, false});
    for (Index w = 0; w < mesh.wedge_count(); ++w)
        for (int c = 0; c < a.components; ++c)
            if (a.value(w, c) != a.value(first[mesh.vertex_of_wedge(w)], c)) return true;
    return false;
}

void put_rows(Bytes& bytes, const Rows& rows, const Attribute* colour, const Attribute* normal,
              bool all_digits) {
    const std::vector<Index> wedges = row_wedges(rows);
    append_text(bytes, rows.count(), [&](std::size_t begin, std::size_t end, std::string& out) {
        for (std::size_t i = begin; i < end; ++i) {
            const Vec3& p = rows.mesh.positions[rows.vertex(i)];
            for (std::size_t c = 0; c < 3; ++c) {
                if (c > 0) out += ' ';
                if (all_digits)
                    put_number(out, p[c]);
                else
                    put_number(out, static_cast<float>(p[c]));
            }
            const Index w = wedges[i] == none ? 0 : wedges[i];
            for (int c = 0; normal && c < 3; ++c) {
                out += ' ';
                put_number(out, static_cast<float>(normal->value(w, c)));
            }
            if (colour) put_colour(out, *colour, w);
            out += '\n';
        }
    });
}

} // namespace

Written write(const Scene& scene, const WriteSettings& settings) {
    const WorldMesh world(scene);
    if (!settings.double_positions) require_floats(*world, "the scene");
    const Attribute* colour = colours_of(*world, Domain::wedge);
    const Attribute* face_colour = colours_of(*world, Domain::face);
    const Attribute* normal = world->has_seams() ? nullptr : world->find("NORMAL", Domain::wedge);
    const Rows rows{*world, world->has_seams() && colour && colours_differ(*world, *colour)};
    Written written;
    Bytes bytes;
    append(bytes, fmt::format("{}{}OFF\n{}{} {} 0\n", colour ? "C" : "", normal ? "N" : "",
                              stated_comments(scene, "# ") + metadata_comments(scene, "# "), rows.count(),
                              world->face_count()));
    ProgressSteps steps({2, 3});
    put_rows(bytes, rows, colour, normal, settings.double_positions);
    steps.next();
    append_text(bytes, world->face_count(), [&](std::size_t begin, std::size_t end, std::string& out) {
        for (auto f = static_cast<Index>(begin); f < end; ++f) {
            put_number(out, static_cast<std::int64_t>(world->face_size(f)));
            for (const Index w : world->face_wedges(f)) {
                out += ' ';
                put_number(out, static_cast<std::int64_t>(rows.of(w)));
            }
            if (face_colour) put_colour(out, *face_colour, f);
            out += '\n';
        }
    });
    for (const auto& a : world->attributes)
        if (&a != colour && &a != face_colour && &a != normal)
            dropped(written, a,
                    a.name == "NORMAL" ? "OFF has one normal at a vertex, and seams need several"
                                       : "OFF cannot represent it");
    if (rows.split)
        written.changes.push_back(
            {"vertices", Domain::vertex, AttributeChange::Kind::recomputed,
             fmt::format(
                 "{} vertices became {}: OFF has one colour at a vertex, so vertices on seams were split",
                 world->vertex_count(), world->wedge_count())});
    leave_documents(written, scene, "OFF", {"metadata"});
    warn_of_dropped(written, scene, "OFF", false);
    warn_of_parts(written, scene, "OFF");
    drop_materials(written, scene, "OFF");
    written.files.push_back({settings.title + ".off", std::move(bytes)});
    return written;
}

} // namespace facetmill::io::off
