#include "stages/render/measured.hpp"

#include "base/text/spelling.hpp"
#include "geometry/deviation/signed_deviation.hpp"
#include "mesh/placement.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <limits>

namespace facetmill::render_stage {

namespace {

bool any_has(const Scene& scene, const std::string& attribute,
             const std::function<bool(const Part&)>& selects) {
    return std::any_of(scene.parts.begin(), scene.parts.end(), [&](const Part& part) {
        return selects(part) && attribute_to_show(part.mesh, attribute);
    });
}

/// The attribute names of the drawn parts, each once.
std::vector<std::string> attribute_names(const Scene& scene,
                                         const std::function<bool(const Part&)>& selects) {
    std::vector<std::string> names;
    for (const Part& part : scene.parts)
        for (const Attribute& a : part.mesh.attributes)
            if (selects(part) && a.name != primitive_attribute &&
                std::find(names.begin(), names.end(), a.name) == names.end())
                names.push_back(a.name);
    return names;
}

/// The part without attributes, except attributes for the sides of its faces.
Part faces_of(const Part& part) {
    Part out;
    out.name = part.name;
    out.transform = part.transform;
    out.mesh = bare(part.mesh);
    out.mesh.lines = part.mesh.lines;
    out.mesh.line_primitive = part.mesh.line_primitive;
    out.mesh.primitives = part.mesh.primitives;
    if (const Attribute* a = part.mesh.find(primitive_attribute, Domain::face)) out.mesh.attributes = {*a};
    return out;
}

[[noreturn]] void refuse(const std::string& asked, std::vector<std::string> known, const Mark& where) {
    const std::vector<std::string> own = known, words = quantity_words();
    known.insert(known.end(), words.begin(), words.end());
    const std::string lists =
        fmt::format("{}render can measure {}",
                    own.empty() ? "the scene has no attributes; "
                                : fmt::format("the scene has {}; ", fmt::join(own, ", ")),
                    fmt::join(quantity_names(), ", "));
    throw Error(ErrorKind::stage, "E-ATTRIBUTE",
                fmt::format("render: no part has an attribute '{}', and it cannot be measured", asked),
                asked == "failed" ? "use validate: {mark: failed.ply} to write a copy with this attribute"
                                  : did_you_mean(asked, known, lists),
                where);
}

} // namespace

const Quantity* quantity_to_measure(const RenderOptions& o, const Scene& scene, const Scene* other,
                                    const Context& context) {
    if (o.attribute.empty()) return nullptr;
    const auto selects = [&](const Part& part) { return context.selects(part, scene); };
    const auto all = [](const Part&) { return true; };
    if (any_has(scene, o.attribute, selects) || (other && any_has(*other, o.attribute, all))) return nullptr;
    const Quantity* quantity = quantity_called(o.attribute);
    if (!quantity) refuse(o.attribute, attribute_names(scene, selects), context.where());
    return quantity;
}

bool is_from_load(const RenderOptions& o) {
    const Quantity* quantity = o.with ? nullptr : quantity_called(o.attribute);
    return quantity && quantity->compares;
}

std::string unit_of_legend(const RenderOptions& o, const Quantity* quantity, Unit unit,
                           const Context& context) {
    if (!quantity) return o.unit;
    const std::string own = unit_of(*quantity, unit);
    const bool is_length = quantity->measure != Measure::number && quantity->measure != Measure::degrees;
    if (o.unit.empty() || o.unit == own || (is_length && unit == Unit::unknown))
        return o.unit.empty() ? own : o.unit;
    throw Error(ErrorKind::usage, "E-UNIT",
                fmt::format("render: {} is measured in {}, not in {}", quantity->name,
                            own.empty() ? "no unit" : own, o.unit),
                is_length ? "use transform: {unit: mm} first to convert the scene" : "remove unit",
                context.where());
}

Scene measured(const RenderOptions& o, const Quantity& quantity, const Scene& scene,
               const std::function<bool(const Part&)>& selects, const FaceTree* other, bool bind) {
    const bool cuts = quantity.compares && !bind && o.edges != EdgeLines::all;
    Scene out;
    out.unit = scene.unit;
    out.up = scene.up;
    out.documents = scene.documents;
    out.materials = scene.materials;
    for (const Part& part : scene.parts)
        if (selects(part)) out.parts.push_back(cuts ? faces_of(part) : part);
    if (cuts) cut_large_faces(out, scene.bounds().diagonal());
    for (Part& part : out.parts) give_attribute(part, quantity, values_of(quantity, part, other));
    return out;
}

} // namespace facetmill::render_stage
