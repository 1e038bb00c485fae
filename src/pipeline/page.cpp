#include "pipeline/page.hpp"

#include "geometry/triangulate/crossing_faces.hpp"
#include "io/gltf/pose.hpp"
#include "mesh/face.hpp"
#include "report/check_text.hpp"
#include "report/deviation_view.hpp"
#include "report/scene_picture.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace facetmill::pipeline {

namespace {

// Base64 of pictures, of a page of 3 MB.
constexpr std::size_t bytes_of_large = 1'100'000, most_bytes = 1'600'000;
constexpr std::size_t most_results = 8, most_measured = 6, most_failures = 8;
constexpr std::size_t most_faces_of_a_stage = 500'000; // a tree of more takes too long for what it shows
constexpr int close_zoom = 10;

bool is_same(const Surface& a, const Surface& b) {
    return a.positions == b.positions && a.corners == b.corners;
}

bool measures(const Step& step) {
    return step.stage->measures_deviation || (step.ensure && step.ensure->deviation);
}

/// 1 on the faces that the check names, else 0; in colours, red on grey.
Scene with_failing_faces(const Scene& scene, const report::Check& check) {
    Scene out = scene;
    for (Part& part : out.parts) {
        std::vector<float> failing(part.mesh.face_count());
        for (const auto& entry : *check.evidence)
            if (entry.name == part.name)
                for (const auto& face : {entry.face, entry.with})
                    if (face && *face < failing.size()) failing[*face] = 1;
        std::erase_if(part.mesh.attributes, [](const Attribute& a) { return a.name == "failing"; });
        part.mesh.attributes.push_back(
            {"failing", Domain::face, Role::generic, 1, false, std::move(failing)});
    }
    return out;
}

/// The first face that the check names, seen from its front and taking a sixth of the picture.
void look_at_first(const Scene& scene, const report::Check& check, PictureSettings& settings) {
    const report::EvidenceEntry& first = check.evidence->front();
    const double whole = scene.bounds().diagonal();
    settings.zoom = close_zoom;
    if (!first.face || !(whole > 0)) return;
    for (const Part& part : scene.parts) {
        if (part.name != first.name || *first.face >= part.mesh.face_count()) continue;
        Box box;
        const auto f = static_cast<Index>(*first.face);
        for (Index c = part.mesh.face_begin(f); c < part.mesh.face_end(f); ++c)
            box.add(part.transform.point(part.mesh.point(c)));
        const double zoom = whole / (6 * box.diagonal());
        if (std::isfinite(zoom)) settings.zoom = std::clamp(zoom, 3.0, 400.0);
        const Vec3 normal = area_vector(part.mesh, f, part.transform);
        if (is_finite(normal) && length(normal) > 0) settings.from = normal;
        return;
    }
}

} // namespace

const FaceTree& Page::Reference::tree() {
    if (!tree_) tree_ = std::make_shared<const FaceTree>(*surface, FaceTree::Use::few);
    return *tree_;
}

std::shared_ptr<Page::Reference> Page::reference_to(const Scene& scene, std::string name) {
    auto reference = std::make_shared<Reference>();
    reference->name = std::move(name);
    reference->surface = std::make_shared<const Surface>(surface_or_points_of(scene, filled_surface));
    reference->faces = scene.face_count();
    return reference;
}

bool Page::is_full() const { return bytes_ > most_bytes; }

/// part: of the size of the largest pictures.
PictureSettings Page::sized_for_page(double part) const {
    PictureSettings settings = report::page_settings();
    if (bytes_ > bytes_of_large) {
        part /= 2;
        record_.pictures_shrunk = true;
    }
    settings.width = static_cast<int>(settings.width * part);
    settings.height = static_cast<int>(settings.height * part);
    return settings;
}

/// The camera of the picture before, so that the two can be compared, unless the scene goes far beyond it or
/// became much smaller. Which way is up stays as it was in the first picture.
const Camera& Page::camera_for(const Scene& scene) {
    PictureSettings as_before;
    const Box before = camera_.seen;
    if (!before.empty() && camera_up_ == scene.up) as_before.camera = camera_;
    const Camera own = camera_of(scene, as_before);
    const Box& now = own.seen;
    const Vec3 size = before.extent(), left = before.min - size * 0.04, right = before.max + size * 0.04;
    const bool inside = as_before.camera && !now.empty() && now.min.x >= left.x && now.min.y >= left.y &&
                        now.max.x <= right.x && now.max.y <= right.y;
    if (!inside || now.diagonal() < before.diagonal() / 3) {
        camera_ = own;
        camera_up_ = scene.up;
        ++cameras_;
    }
    return camera_;
}

void Page::add_picture(const Scene& scene, report::StageRecord& stage) {
    if (is_full()) {
        ++record_.pictures_left_out;
        return;
    }
    PictureSettings settings = sized_for_page(1);
    const auto posed = io::posed(scene);
    settings.camera = camera_for(posed ? *posed : scene);
    std::string shown = report::scene_picture(scene, settings, looks_);
    if (shown == last_picture_) return;
    bytes_ += shown.size();
    stage.camera = cameras_;
    last_picture_ = stage.picture = std::move(shown);
}

report::DeviationView Page::distances(const Scene& scene, Reference& from) {
    std::optional<PictureSettings> settings;
    if (is_full())
        record_.pictures_left_out += 3;
    else
        settings = sized_for_page(0.75); // three beside each other
    if (settings && !io::posed(scene))
        settings->camera = camera_for(scene); // distances are those in bind pose
    auto view =
        report::deviation_view(scene, {from.name, from.surface->bounds().diagonal(), from.tree()}, settings);
    bytes_ += view.picture.size() + view.behind.size() + view.close.size();
    return view;
}

void Page::before(const Step& step, const Scene& scene) {
    entering_.reset();
    if (step.stage->loads || !measures(step) || measured_stages_ >= most_measured) return;
    if (scene.face_count() > most_faces_of_a_stage) return;
    entering_ = reference_to(scene, fmt::format("the scene before '{}'", step.name));
}

void Page::after(const Step& step, const Scene& scene, report::StageRecord& stage, std::size_t first_output) {
    const auto is_mesh = [](const report::FileRecord& file) { return !file.read_back.is_null(); };
    const bool only_looks =
        step.stage->checks || std::any_of(record_.outputs.begin() + static_cast<std::ptrdiff_t>(first_output),
                                          record_.outputs.end(), is_mesh);
    if (!only_looks) add_picture(scene, stage);
    if (step.stage->loads || step.stage->moves) {
        loaded_ = reference_to(scene, step.stage->loads ? std::string("the scene as loaded")
                                                        : fmt::format("the scene after '{}'", step.name));
        loaded_->shape = shape_histograms(scene);
    }
    if (entering_) {
        auto now = std::make_shared<const Surface>(surface_or_points_of(scene, filled_surface));
        if (!is_same(*now, *entering_->surface) && entering_->surface->size() > 0 && now->size() > 0) {
            ++measured_stages_;
            stage.deviation = distances(scene, *entering_);
            shown_ = std::move(now);
            shown_from_ = entering_->surface;
            shown_at_ = fmt::format("at '{}'", step.name);
        }
        entering_.reset();
    }
    for (std::size_t i = first_output; i < record_.outputs.size(); ++i)
        if (!record_.outputs[i].read_back.is_null()) add_result(record_.outputs[i].path, scene);
}

void Page::add_result(const std::string& name, const Scene& scene) {
    if (record_.views.size() >= most_results) return;
    report::OutputView view;
    view.name = name;
    view.unit = scene.unit == Unit::unknown ? "" : to_string(scene.unit);
    view.faces = scene.face_count();
    view.shape = shape_histograms(scene);
    if (loaded_) {
        view.input_shape = loaded_->shape;
        view.input_faces = loaded_->faces;
        auto now = std::make_shared<const Surface>(surface_or_points_of(scene, filled_surface));
        if (now->size() == 0 || loaded_->surface->size() == 0)
            view.no_deviation = "There are no distances: one of the scenes is empty.";
        else if (is_same(*now, *loaded_->surface))
            view.no_deviation = fmt::format("Its surface is that of {}.", loaded_->name);
        else if (shown_ && is_same(*now, *shown_) && is_same(*shown_from_, *loaded_->surface))
            view.no_deviation = fmt::format("How far it is from {} is shown {}.", loaded_->name, shown_at_);
        else {
            view.deviation = distances(scene, *loaded_);
            shown_ = std::move(now);
            shown_from_ = loaded_->surface;
            shown_at_ = fmt::format("for '{}'", name);
        }
    }
    record_.views.push_back(std::move(view));
}

std::string Page::picture_of_failure(const Scene& scene, const report::Check& check) {
    const std::vector<Vec3> locations = report::failing_locations(check);
    const Scene marked = with_failing_faces(scene, check);
    PictureSettings whole = report::page_settings();
    if (!io::posed(scene)) whole.camera = camera_for(scene);
    whole.attribute = "failing";
    whole.range = {ColourRange::Kind::given, -1, 1, true};
    PictureSettings close = whole;
    whole.marks = locations;
    close.marks = {locations.front()};
    close.at = locations.front();
    look_at_first(scene, check, close);
    if (close.camera) close.camera = camera_of(marked, close);
    close.edges = EdgeLines::all;
    return report::page_text(sheet_of({picture_of(marked, whole), picture_of(marked, close)}, 2));
}

bool Page::failures(const std::string& step, const Scene& scene, std::size_t first_check) {
    bool fails = false;
    for (std::size_t i = first_check; i < record_.checks.size(); ++i) {
        report::Check& check = record_.checks[i];
        fails |= !check.passed && check.severity == Severity::error;
        if (report::failing_locations(check).empty()) continue;
        if (is_full() || failures_shown_ >= most_failures) {
            ++record_.pictures_left_out;
            continue;
        }
        ++failures_shown_;
        check.picture = picture_of_failure(scene, check);
        bytes_ += check.picture.size();
    }
    if (fails) add_result(fmt::format("the scene at '{}'", step), scene);
    return fails;
}

void Page::at_end(const Scene& scene) {
    if (record_.views.empty()) add_result("the scene at the end", scene);
}

} // namespace facetmill::pipeline
