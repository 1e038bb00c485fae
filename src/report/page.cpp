#include "report/page.hpp"

#include "geometry/deviation/signed_deviation.hpp"
#include "geometry/triangulate/crossing_faces.hpp"
#include "io/gltf/read/skinned_pose.hpp"
#include "report/check_text.hpp"
#include "report/deviation_view.hpp"
#include "report/page_failures.hpp"
#include "report/scene_picture.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace facetmill::report {

namespace {

// Limits for pictures in base64, for a page of 3 MB.
constexpr std::size_t bytes_of_large = 1'100'000, most_bytes = 1'600'000;
constexpr std::size_t most_results = 8, most_measured = 6, most_failures = 8;
constexpr std::size_t most_faces_of_a_stage = 500'000; // building a larger tree takes too long for its use

std::size_t vertices_in(const Scene& scene) {
    std::size_t count = 0;
    for (const Part& part : scene.parts) count += part.mesh.vertex_count();
    return count;
}

bool is_mesh(const FileRecord& file) { return !file.read_back.is_null(); }

} // namespace

Page::Shown::Shown(const Scene& scene) {
    const auto posed = io::posed(scene);
    surface_ = surface_or_points_of(posed ? *posed : scene, filled_surface);
}

bool Page::Shown::is_same(const Shown& other) const {
    return surface_.positions == other.surface_.positions && surface_.corners == other.surface_.corners;
}

const Box& Page::Shown::bounds() {
    if (!bounds_) bounds_ = surface_.bounds();
    return *bounds_;
}

const FaceTree& Page::Shown::tree() {
    if (!tree_) tree_ = tree_of_earlier(surface_, bounds());
    return *tree_;
}

std::shared_ptr<Page::Reference> Page::reference_to(const Scene& scene, std::string name) {
    return std::make_shared<Reference>(
        Reference{std::move(name), std::make_shared<Shown>(scene), last_cap(scene), {}, scene.face_count()});
}

bool Page::is_full() const { return bytes_ > most_bytes; }

/// part: the size relative to the largest pictures.
PictureSettings Page::sized_for_page(double part) const {
    PictureSettings settings = page_settings();
    if (bytes_ > bytes_of_large) {
        part /= 2;
        record_.pictures_shrunk = true;
    }
    settings.width = static_cast<int>(settings.width * part);
    settings.height = static_cast<int>(settings.height * part);
    return settings;
}

/// The camera of the previous picture, so that the two can be compared. A new camera is used if the scene
/// extends far beyond its view, or is much smaller. All pictures use the up axis of the first one.
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

void Page::add_picture(const Scene& scene, StageRecord& stage) {
    if (is_full()) {
        ++record_.pictures_left_out;
        return;
    }
    // A digest takes a large part of the time of a picture, so it is computed only if the numbers of vertices
    // and faces match. So the first repetition of a scene is drawn once more than necessary.
    const std::pair size{vertices_in(scene), scene.face_count()};
    std::string digest = size == pictured_size_ ? digest_(scene) : std::string();
    if (!digest.empty() && digest == pictured_) return;
    materials_.materials(scene, record_.not_drawn); // reports each texture once, and decodes it in advance
    PictureSettings settings = sized_for_page(1);
    const auto posed = io::posed(scene);
    settings.camera = camera_for(posed ? *posed : scene);
    std::string shown = scene_picture(scene, settings, materials_);
    pictured_size_ = size;
    pictured_ = std::move(digest);
    if (shown == last_picture_) return;
    bytes_ += shown.size();
    stage.camera = cameras_;
    last_picture_ = stage.picture = std::move(shown);
}

DeviationView Page::distances(const Scene& scene, Reference& from) {
    const auto posed = io::posed(scene);
    const Scene& seen = posed ? *posed : scene;
    std::optional<PictureSettings> settings; // empty: only numbers
    if (with_pictures_ && is_full()) record_.pictures_left_out += 3;
    if (with_pictures_ && !is_full()) {
        settings = sized_for_page(0.75); // three pictures are side by side
        settings->camera = camera_for(seen);
    }
    Shown& earlier = *from.shown;
    auto view = deviation_view(seen, {from.name, earlier.bounds().diagonal(), earlier.tree(), from.last_cap},
                               settings);
    view.posed = posed.has_value();
    bytes_ += view.picture.size() + view.behind.size() + view.close.size();
    return view;
}

void Page::before(const PageStep& step, const Scene& scene) {
    entering_.reset();
    if (step.loads || !step.measures || measured_stages_ >= most_measured) return;
    if (scene.face_count() > most_faces_of_a_stage) return;
    entering_ = reference_to(scene, fmt::format("the scene before '{}'", step.name));
    if (loaded_ && loaded_->shown->is_same(*entering_->shown))
        entering_->shown = loaded_->shown; // both share a tree
}

void Page::after(const PageStep& step, const Scene& scene, StageRecord& stage, std::size_t first_output) {
    const bool only_looks =
        step.checks || std::any_of(record_.outputs.begin() + static_cast<std::ptrdiff_t>(first_output),
                                   record_.outputs.end(), is_mesh);
    if (!only_looks) add_picture(scene, stage);
    set_loaded(step, scene);
    if (entering_) {
        auto now = std::make_shared<const Shown>(scene);
        const Surface& earlier = entering_->shown->surface();
        if (!now->is_same(*entering_->shown) && earlier.size() > 0 && now->surface().size() > 0) {
            ++measured_stages_;
            stage.deviation = distances(scene, *entering_);
            shown_ = std::move(now);
            shown_from_ = entering_->shown;
            shown_at_ = fmt::format("at '{}'", step.name);
            shown_stage_ = step.name;
        }
        entering_.reset();
    }
    add_results(first_output, scene);
}

void Page::set_loaded(const PageStep& step, const Scene& scene) {
    if (!step.loads && !step.moves) return;
    loaded_ = reference_to(scene, step.loads ? std::string("the input")
                                             : fmt::format("the scene after '{}'", step.name));
    if (with_pictures_) loaded_->shape = shape_histograms(scene);
}

void Page::add_results(std::size_t first_output, const Scene& scene) {
    for (std::size_t i = first_output; i < record_.outputs.size(); ++i)
        if (is_mesh(record_.outputs[i])) add_result(record_.outputs[i].path, scene);
}

bool Page::is_measured(const PageStep& step, std::size_t first_output) const {
    return step.loads || step.moves ||
           std::any_of(record_.outputs.begin() + static_cast<std::ptrdiff_t>(first_output),
                       record_.outputs.end(), is_mesh);
}

void Page::measure(const PageStep& step, const Scene& scene, std::size_t first_output) {
    set_loaded(step, scene);
    add_results(first_output, scene);
}

void Page::add_result(const std::string& name, const Scene& scene) {
    if (record_.views.size() >= most_results) return;
    OutputView view;
    view.name = name;
    view.unit = scene.unit == Unit::unknown ? "" : to_string(scene.unit);
    view.faces = scene.face_count();
    if (with_pictures_) view.shape = shape_histograms(scene);
    if (loaded_) {
        view.input_shape = loaded_->shape;
        view.input_faces = loaded_->faces;
        auto now = std::make_shared<const Shown>(scene);
        if (now->surface().size() == 0 || loaded_->shown->surface().size() == 0)
            view.no_deviation = "No distances were measured, because one of the scenes is empty.";
        else if (now->is_same(*loaded_->shown))
            view.no_deviation = fmt::format("The surface is unchanged from {}.", loaded_->name);
        else if (shown_ && now->is_same(*shown_) && shown_from_->is_same(*loaded_->shown)) {
            view.no_deviation = fmt::format("The distances from {} are shown {}.", loaded_->name, shown_at_);
            view.same_as = shown_stage_;
            view.differs = true;
        } else {
            view.deviation = distances(scene, *loaded_);
            view.differs = true;
            shown_ = std::move(now);
            shown_from_ = loaded_->shown;
            shown_at_ = fmt::format("for '{}'", name);
            shown_stage_.clear();
        }
    }
    record_.views.push_back(std::move(view));
}

std::string Page::picture_of_failure(const Scene& scene, const Check& check) {
    const std::vector<Vec3> locations = failing_locations(check);
    const Scene marked = with_failing_faces(scene, check);
    PictureSettings whole = page_settings();
    if (!io::posed(scene)) whole.camera = camera_for(scene);
    whole.attribute = failing_attribute;
    whole.range = {ColourRange::Kind::given, -1, 1, true};
    CloseView close = close_view(marked, check, whole);
    whole.marks = locations;
    close.settings.marks = {locations.front()};
    close.settings.at = locations.front();
    close.settings.camera = camera_of(marked, close.settings);
    close.settings.edges = EdgeLines::all;
    return page_text(sheet_of({picture_of(marked, whole), picture_of(close.scene, close.settings)}, 2));
}

void Page::failures(const std::string& step, const Scene& scene, std::size_t first_check) {
    bool fails = false;
    for (std::size_t i = first_check; i < record_.checks.size(); ++i) {
        Check& check = record_.checks[i];
        fails |= !check.passed && check.severity == Severity::error;
        if (!with_pictures_ || failing_locations(check).empty()) continue;
        if (is_full() || failures_shown_ >= most_failures) {
            ++record_.pictures_left_out;
            continue;
        }
        ++failures_shown_;
        check.picture = picture_of_failure(scene, check);
        bytes_ += check.picture.size();
    }
    if (fails) add_result(fmt::format("the scene at '{}'", step), scene);
}

bool Page::differs(const std::string& name) const {
    return std::any_of(record_.views.begin(), record_.views.end(),
                       [&](const OutputView& view) { return view.name == name && view.differs; });
}

void Page::at_end(const Scene& scene) {
    if (record_.views.empty()) add_result("the final scene", scene);
}

} // namespace facetmill::report
