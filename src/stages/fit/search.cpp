#include "stages/fit/search.hpp"

#include "base/progress.hpp"

#include <algorithm>
#include <cmath>

namespace facetmill::fit_stage {

namespace {

constexpr int finest_quality = 85; // of images; above, files grow much faster than their likeness

/// Mean squared differences above this are not worth measuring: a root of 17 %, or twice the given look.
double hopeless(const FitOptions& o) { return o.look ? 4 * o.look->value * o.look->value : 0.03; }

std::size_t triangles_of(const Scene& scene) {
    std::size_t count = 0;
    for (const Part& part : scene.parts)
        count += part.mesh.corner_count() -
                 std::min<std::size_t>(2 * part.mesh.face_count(), part.mesh.corner_count());
    return count;
}

/// The bytes besides the scene's images. At least 1, because a file stores equal images once.
double without_images(const TrialFile& file, const Scene& scene) {
    return std::max(1.0, static_cast<double>(file.bytes) - static_cast<double>(image_sides(scene).bytes));
}

bool has_attribute(const Scene& scene, std::string_view prefix) {
    for (const Part& part : scene.parts)
        for (const Attribute& a : part.mesh.attributes)
            if (std::string_view(a.name).starts_with(prefix)) return true;
    return false;
}

} // namespace

Search::Search(const Scene& scene, const FitOptions& o, Context& context)
    : scene_(scene), o_(o), trials_(scene, o, context), original_(scene, static_cast<int>(o.pixels)) {}

bool Search::fits(const Candidate& c) const { return c.bytes <= o_.most_bytes() && c.error <= aim_error(); }

/// With `look`, fewer bytes are better; otherwise less difference.
bool Search::better(const Candidate& a, const Candidate& b) const {
    if (fits(a) != fits(b)) return fits(a);
    if (o_.look ? a.bytes != b.bytes : a.error != b.error)
        return o_.look ? a.bytes < b.bytes : a.error < b.error;
    return o_.look ? a.error < b.error : a.bytes < b.bytes;
}

Candidate Search::tried(const Choice& choice) {
    for (const Candidate& c : known_)
        if (c.choice == choice) return c;
    Scene made = trials_.simplified(choice.keep);
    if (last_images_.empty() || choice.colours != last_colours_ || choice.normals != last_normals_) {
        last_images_ = trials_.with_images(scene_, choice.colours, choice.normals).documents;
        last_colours_ = choice.colours;
        last_normals_ = choice.normals;
    }
    made.documents = last_images_; // simplify does not change them
    const TrialFile file = trials_.file(made, choice.bits, true);
    ++tried_;
    known_.push_back({choice, file.bytes, triangles_of(made), original_.difference(file.decoded)});
    return known_.back();
}

void Search::measure_ratios() {
    // Images as sharp as the pictures keep the trials of shapes quick. Their reference has the same images.
    const ImageChoice proxy{static_cast<std::size_t>(o_.pixels), 90};
    const ImageSides sides = image_sides(scene_);
    const bool large = std::max(sides.colours, sides.normals) > proxy.side;
    const Scene whole = large ? trials_.with_images(scene_, proxy, proxy) : scene_;
    proxies_ = whole.documents;
    const report::Likeness like(whole, static_cast<int>(o_.pixels));
    constexpr std::size_t levels = 14, fewest_triangles = 48;
    for (std::size_t level = 0; level < levels; ++level) {
        const ProgressScope share(static_cast<double>(level) / levels, (level + 1.0) / levels);
        // The first steps are short, because most results lie in this range.
        const double keep = level < 4 ? 1 - 0.2 * static_cast<double>(level)
                                      : std::ldexp(0.5, 3 - static_cast<int>(level)) * 1.2;
        Scene reduced = trials_.simplified(keep);
        reduced.documents = proxies_;
        const TrialFile file = trials_.file(reduced, {}, false);
        ++tried_;
        const MeasuredRatio now{keep, {without_images(file, reduced), like.difference(file.decoded)}};
        if (!curves_.ratios.empty() && now.cost.bytes > 0.995 * curves_.ratios.back().cost.bytes) break;
        curves_.ratios.push_back(now);
        if (now.cost.error > hopeless(o_) || triangles_of(reduced) < fewest_triangles) break;
    }
}

std::vector<MeasuredBits> Search::measured_bits(const std::vector<int>& ladder, int Bits::*member,
                                                const Scene& scene, const report::Likeness& like) {
    std::vector<MeasuredBits> all;
    Cost finest;
    for (const int bits : ladder) {
        Bits choice;
        choice.*member = bits;
        const TrialFile file = trials_.file(scene, choice, false);
        ++tried_;
        const Cost now{without_images(file, scene), like.difference(file.decoded)};
        if (all.empty()) finest = now;
        all.push_back({bits, 1 - now.bytes / finest.bytes, std::max(0.0, now.error - finest.error)});
        if (now.error > hopeless(o_)) break;
    }
    return all;
}

/// Bits are measured where the mesh is small, because their effect hardly depends on the number of triangles.
void Search::measure_bits() {
    const Bits finest;
    curves_.position = {{finest.position, 0, 0}};
    curves_.normal = {{finest.normal, 0, 0}};
    curves_.uv = {{finest.uv, 0, 0}};
    if (o_.compression == Compression::none) return;
    constexpr double enough_triangles = 30000;
    double keep = 1;
    for (const MeasuredRatio& r : curves_.ratios)
        if (static_cast<double>(triangles_of(scene_)) * keep > enough_triangles) keep = r.keep;
    Scene reduced = trials_.simplified(keep);
    reduced.documents = proxies_;
    const report::Likeness like(reduced, static_cast<int>(o_.pixels));
    curves_.position = measured_bits({16, 14, 12, 11, 10, 9}, &Bits::position, reduced, like);
    if (has_attribute(scene_, "NORMAL"))
        curves_.normal = measured_bits({12, 10, 8, 7, 6, 5}, &Bits::normal, reduced, like);
    if (has_attribute(scene_, "TEXCOORD_"))
        curves_.uv = measured_bits({14, 12, 11, 10, 9}, &Bits::uv, reduced, like);
}

ImageChoice Search::largest(std::size_t longest) const {
    const auto most = static_cast<std::size_t>(o_.max_size.value_or(16384));
    return longest > most ? ImageChoice{most, finest_quality} : ImageChoice{};
}

void Search::measure_images(bool of_normals) {
    const ImageSides whole = image_sides(scene_);
    const std::size_t given = of_normals ? whole.normals : whole.colours;
    auto& curve = of_normals ? curves_.normals : curves_.colours;
    const ImageChoice first = largest(given);
    // The bytes of all images count for the colours, and the bytes of normal maps are relative to them.
    const double base = of_normals ? static_cast<double>(whole.bytes) : 0;
    if (first.side == 0) curve = {{{}, {static_cast<double>(whole.bytes) - base, 0}}};
    const std::size_t longest = first.side > 0 ? first.side : given;
    constexpr std::size_t shortest = 16;
    for (std::size_t side = longest; side >= std::min(shortest, longest) && side > 0; side /= 2) {
        // Images that are larger than the pictures hardly change them, so two qualities show enough.
        const bool large = side > 2 * static_cast<std::size_t>(o_.pixels);
        bool hope = false;
        for (const int quality :
             large ? std::vector<int>{finest_quality, 40} : std::vector<int>{finest_quality, 55, 25}) {
            const ImageChoice choice{side, quality};
            const Scene made = trials_.with_images(scene_, of_normals ? ImageChoice{} : choice,
                                                   of_normals ? choice : ImageChoice{});
            ++tried_;
            const Cost cost{static_cast<double>(image_sides(made).bytes) - base, original_.difference(made)};
            curve.push_back({choice, cost});
            if (cost.error >= hopeless(o_)) break;
            hope = true;
            if (o_.images == "png") break; // has no quality
        }
        if (!hope) break;
    }
}

/// Tries the predictions of the model, and corrects the limit by the real file.
void Search::try_choices(const Model& model, std::size_t rounds, std::optional<Candidate>& best) {
    const std::size_t last = tried_ + rounds;
    for (int step = 0; step < 60 && tried_ < last; ++step) {
        const double limit = o_.look ? aim_error() : static_cast<double>(o_.most_bytes());
        const auto choice =
            o_.look ? model.smallest_within(limit * correction_) : model.best_within(limit * correction_);
        if (!choice) return;
        const std::size_t before = tried_;
        const Candidate c = tried(*choice);
        const bool is_new = tried_ > before;
        if (fits(c) && (!best || better(c, *best))) best = c;
        const double real = o_.look ? c.error : static_cast<double>(c.bytes);
        const double nearest = o_.look ? 0.93 : 0.985; // closer is not worth another trial
        if (real <= limit && (real > nearest * limit || !is_new)) return;
        const double factor = std::clamp(limit / std::max(real, 1e-12), 0.5, 2.0);
        correction_ *= real > limit ? 0.99 * factor : factor;
    }
}

Candidate Search::best(const Search* other) {
    ProgressSteps steps({1, 4, 2, 3, 3, 5});
    const ImageSides sides = image_sides(scene_);
    const Candidate whole = tried({1, {}, largest(sides.colours), largest(sides.normals)});
    if (!o_.look && fits(whole)) return whole;
    steps.next();
    measure_ratios();
    steps.next();
    measure_bits();
    steps.next();
    if (other && !other->curves_.colours.empty()) {
        curves_.colours = other->curves_.colours;
        curves_.normals = other->curves_.normals;
        steps.next();
    } else {
        measure_images(false);
        steps.next();
        measure_images(true);
    }
    steps.next();
    std::optional<Candidate> best;
    if (fits(whole)) best = whole;
    const Model plain(curves_, 1);
    try_choices(plain, 6, best);
    if (!best) try_choices(plain, 6, best); // the predictions were far off
    // Choices with more and with fewer triangles, because measured differences do not quite add up.
    for (const double weight : {1e4, 4.0, 0.3}) try_choices(Model(curves_, weight), 2, best);
    if (best) return *best;
    if (!o_.look) return tried(plain.smallest());
    // The fewest bytes that look the same are more than the budget, or even all bits do not look the same.
    const Candidate* nearest = &known_.front();
    for (const Candidate& c : known_)
        if (c.error <= aim_error() && (nearest->error > aim_error() || c.bytes < nearest->bytes))
            nearest = &c;
    return *nearest;
}

} // namespace facetmill::fit_stage
