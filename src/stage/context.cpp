#include "stage/context.hpp"

#include "base/progress.hpp"
#include "base/text/glob.hpp"
#include "mesh/power_scale.hpp"
#include "mesh/primitives_in_use.hpp"
#include "parallel/parallel.hpp"

#include <fmt/format.h>

namespace facetmill {

namespace fs = std::filesystem;

namespace {

/// True if the pattern matches the part, or a material of its faces, lines or points.
bool names(std::string_view pattern, const Part& part, const Scene& scene) {
    if (glob_matches(pattern, part.name)) return true;
    std::vector<bool> used; // computed when a name matches
    for (std::size_t p = 0; p < part.mesh.primitives.size(); ++p) {
        const Index material = part.mesh.primitives[p].material;
        if (material >= scene.materials.size() || !glob_matches(pattern, scene.materials[material].name))
            continue;
        if (used.empty()) used = primitives_in_use(part.mesh);
        if (used[p]) return true;
    }
    return false;
}

fs::path placed(const fs::path& base, const std::string& text) {
    if (text == "-") return text;
    const fs::path path(text);
    return (path.is_absolute() ? path : base / path).lexically_normal();
}

/// The diagonal of the part's box in world space. Boxes do not depend on the order of points, so chunks may
/// be merged in any order.
double world_diagonal(const Part& part) {
    const Transform to_world = part.transform;
    const auto& points = part.mesh.positions;
    const Box box = parallel_reduce(
        points.size(), Box{},
        [&](std::size_t begin, std::size_t end) {
            Box b;
            for (std::size_t i = begin; i < end; ++i) b.add(to_world.point(points[i]));
            return b;
        },
        [](Box a, const Box& b) {
            a.add(b);
            return a;
        });
    return diagonal(box);
}

} // namespace

bool PartFilter::selects(const Part& part, const Scene& scene) const {
    bool any_positive = false, named = false;
    for (const auto& pattern : patterns) {
        if (pattern.starts_with('!')) {
            if (names(std::string_view(pattern).substr(1), part, scene)) return false;
        } else {
            any_positive = true;
            named = named || names(pattern, part, scene);
        }
    }
    return named || !any_positive;
}

fs::path Folders::input(const std::string& text) const { return placed(input_base, text); }
fs::path Folders::output(const std::string& text) const { return placed(output_base, text); }

Context::Context(RunState& run, report::StageRecord& record, const PartFilter& only, Box entering,
                 const Mark& where)
    : run_(run), record_(record), only_(only), entering_(entering), where_(where) {}

void Context::for_each_part(Scene& scene, const std::function<void(Part&)>& body) {
    double all = 0, done = 0; // numbers of faces
    for (const auto& part : scene.parts)
        if (selects(part, scene)) all += static_cast<double>(1 + part.mesh.face_count());
    for (auto& part : scene.parts) {
        if (!selects(part, scene)) continue;
        const double faces = static_cast<double>(1 + part.mesh.face_count());
        const ProgressScope share(done / all, (done + faces) / all);
        body(part);
        done += faces;
        part.changed = true;
    }
}

std::size_t Context::leave_lines(const Scene& scene) {
    const auto count = std::count_if(scene.parts.begin(), scene.parts.end(), [&](const Part& part) {
        return part.mesh.line_count() > 0 && selects(part, scene);
    });
    leaves_lines_ = true;
    return static_cast<std::size_t>(count);
}

double Context::resolve(const Length& length, const Scene& scene, std::string_view option, const Part* part) {
    double is = length.amount;
    if (length.kind == Length::Kind::physical) {
        const double unit = metres(scene.unit);
        if (!(unit > 0))
            throw Error(ErrorKind::usage, "E-UNIT",
                        fmt::format("'{}' is {}, but the scene has no unit", option, length.text),
                        "give the unit of the file (load: {unit: mm}), or use a bare number or a percentage");
        is = length.amount / unit;
    } else if (length.kind == Length::Kind::percent) {
        const double whole = length.of == Length::Of::load           ? run_.load_diagonal
                             : length.of == Length::Of::part && part ? world_diagonal(*part)
                                                                     : diagonal(entering_);
        is = length.amount / 100 * whole;
    }
    if (!std::isfinite(is))
        throw Error(ErrorKind::stage, "E-RANGE",
                    fmt::format("'{}' is {}, beyond 1.8e308, the largest number", option, length.text),
                    "use transform: {scale: 1e-300} first");
    const bool of_part = length.kind == Length::Kind::percent && length.of == Length::Of::part && part;
    set_resolved(
        record_.resolved,
        {of_part ? fmt::format("{} ({})", option, part->name) : std::string(option), length.text, is});
    return is;
}

SurfaceSize Context::size_before(const Scene& scene, std::size_t part) const {
    if (part < sizes_before_.size() && sizes_before_[part]) return *sizes_before_[part];
    return surface_size(scene.parts[part].mesh, scene.parts[part].transform);
}

void Context::keep_size(std::size_t part, const SurfaceSize& size) {
    if (part >= sizes_after_.size()) sizes_after_.resize(part + 1);
    sizes_after_[part] = size;
}

std::vector<std::optional<SurfaceSize>> Context::kept_sizes(const Scene& scene) const {
    if (sizes_after_.size() > scene.parts.size()) return {};
    auto sizes = sizes_after_;
    if (!sizes.empty()) sizes.resize(scene.parts.size());
    return sizes;
}

void Context::know_surfaces(const std::vector<PartSurface>& surfaces) {
    sizes_before_.clear();
    sizes_after_.clear();
    for (const PartSurface& s : surfaces) sizes_before_.push_back(s.size);
}

void Context::warn(std::string id, std::string message, std::string hint) {
    record_.warnings.push_back(
        {Severity::warning, std::move(id), std::move(message), where_, std::move(hint)});
}

void Context::report(const Fields& fields, const void* result) {
    Json made = fields.json(result);
    if (record_.result.empty()) // the usual case; for many parts, a copy would dominate the time
        record_.result = std::move(made);
    else
        record_.result.update(made);
    say(fields.lines(result));
}

void Context::output(const std::string& path, io::Span bytes) {
    const auto& staged = run_.outputs.add(run_.places.output(path), bytes, where_);
    run_.record.outputs.push_back(
        {fs::path(path).lexically_normal().generic_string(), staged.bytes, staged.sha256, {}});
}

void Context::wrote(WrittenScene written) {
    written.scene = run_.trail.scene;
    run_.trail.written.push_back(std::move(written));
}

void Context::record_input(report::FileRecord file) {
    run_.outputs.protect(file.path, file.sha256);
    run_.record.inputs.push_back(std::move(file));
}

void Context::attribute_changes(const Part& part, const AttributeChanges& changes) {
    for (const auto& change : changes) record_.attribute_changes.push_back({part.name, change});
}

void Context::check(report::Check check) {
    if (check.stage.empty()) check.stage = record_.name;
    if (!check.where.known()) check.where = where_;
    run_.record.checks.push_back(std::move(check));
}

} // namespace facetmill
