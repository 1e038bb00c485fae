#include "geometry/preview/loose.hpp"

#include "geometry/preview/gathered.hpp"

#include <algorithm>
#include <numeric>

namespace facetmill {

namespace {

/// The colours of a part without faces.
class LooseColours {
  public:
    LooseColours(const Part& part, const Scene& scene, const ResolvedMaterials* materials)
        : mesh_(part.mesh), scene_(scene), materials_(materials), own_(colours_in(part.mesh)) {
        if (own_ && own_->domain != Domain::vertex && own_->domain != Domain::wedge) own_ = nullptr;
    }

    Texel of(Index wedge, Index primitive) const {
        Texel colour = of_material(primitive);
        if (!own_) return colour[0] < 1 || colour[1] < 1 || colour[2] < 1 ? colour : loose_colour;
        const std::size_t at = own_->domain == Domain::vertex ? mesh_.vertex_of_wedge(wedge) : wedge;
        for (int c = 0; c < std::min(own_->components, 4); ++c) {
            const double x = own_->value(at, c);
            colour[static_cast<std::size_t>(c)] *=
                std::isfinite(x) ? std::clamp(static_cast<float>(x), 0.0f, 1.0f) : 0.0f;
        }
        return colour;
    }

  private:
    Texel of_material(Index primitive) const {
        const Index m = primitive < mesh_.primitives.size() ? mesh_.primitives[primitive].material : none;
        if (materials_ && m < materials_->size()) return (*materials_)[m].base;
        Texel colour{1, 1, 1, 1};
        if (m < scene_.materials.size())
            for (std::size_t c = 0; c < 4; ++c)
                colour[c] = static_cast<float>(std::clamp(scene_.materials[m].base_colour[c], 0.0, 1.0));
        return colour;
    }

    const Mesh& mesh_;
    const Scene& scene_;
    const ResolvedMaterials* materials_;
    const Attribute* own_;
};

std::size_t every(std::size_t all, std::size_t most) { return all == 0 ? 1 : (all + most - 1) / most; }

void push(LooseParts& out, const Vec3& place, const Texel& colour) {
    out.points.push_back(place);
    out.colours.insert(out.colours.end(), colour.begin(), colour.end());
}

} // namespace

LooseParts loose_parts(const Scene& scene, const ResolvedMaterials* materials, std::size_t most) {
    LooseParts out;
    for (const Part& part : scene.parts) {
        out.all_lines += part.mesh.line_count();
        if (part.mesh.face_count() == 0 && part.mesh.line_count() == 0)
            out.all_dots += part.mesh.vertex_count();
    }
    const auto for_each = [&](bool lines, auto&& visit) {
        const std::size_t step = every(lines ? out.all_lines : out.all_dots, std::max<std::size_t>(1, most));
        std::size_t number = 0;
        for (const Part& part : scene.parts) {
            const Mesh& mesh = part.mesh;
            if (mesh.face_count() > 0 || (mesh.line_count() > 0) != lines) continue;
            const LooseColours colours(part, scene, materials);
            for (std::size_t i = 0; i < (lines ? mesh.line_count() : mesh.vertex_count()); ++i)
                if (number++ % step == 0) visit(part, i, colours);
        }
    };
    for_each(true, [&](const Part& part, std::size_t line, const LooseColours& colours) {
        const Mesh& mesh = part.mesh;
        const Index ends[] = {mesh.lines[2 * line], mesh.lines[2 * line + 1]};
        const auto place = [&](Index w) {
            return part.transform.point(mesh.positions[mesh.vertex_of_wedge(w)]);
        };
        if (!is_finite(place(ends[0])) || !is_finite(place(ends[1]))) return;
        for (const Index w : ends) push(out, place(w), colours.of(w, mesh.primitive_of_line(line)));
    });
    out.first_dot = out.points.size();
    for_each(false, [&](const Part& part, std::size_t v, const LooseColours& colours) {
        const Vec3 place = part.transform.point(part.mesh.positions[v]);
        if (is_finite(place)) push(out, place, colours.of(static_cast<Index>(v), 0));
    });
    return out;
}

void append_loose(Preview& preview, const LooseParts& loose) {
    Mesh& mesh = preview.mesh;
    const std::size_t surface = mesh.wedge_count(), count = loose.points.size();
    preview.first_loose = surface;
    preview.first_dot = surface + loose.first_dot;
    preview.all_lines = loose.all_lines;
    preview.all_dots = loose.all_dots;
    if (count == 0) return;
    if (mesh.has_seams())
        for (std::size_t i = 0; i < count; ++i)
            mesh.wedge_vertex.push_back(static_cast<Index>(mesh.positions.size() + i));
    mesh.positions.insert(mesh.positions.end(), loose.points.begin(), loose.points.end());
    if (!mesh.find("COLOR_0", Domain::wedge))
        mesh.attributes.push_back(
            {"COLOR_0", Domain::wedge, Role::colour, 4, false, std::vector<float>(4 * surface, 1.0f)});
    for (Attribute& a : mesh.attributes) {
        if (a.domain != Domain::wedge) continue;
        auto& values = std::get<std::vector<float>>(a.data);
        if (a.name == "COLOR_0")
            values.insert(values.end(), loose.colours.begin(), loose.colours.end());
        else
            values.resize(values.size() + count * static_cast<std::size_t>(a.components));
    }
}

} // namespace facetmill
