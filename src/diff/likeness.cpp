#include "diff/likeness.hpp"

#include "base/math/portable_math.hpp"
#include "io/gltf/contents/resolved_materials.hpp"
#include "io/gltf/read/skinned_pose.hpp"

#include <utility>

namespace facetmill::report {

namespace {

std::vector<PictureSettings> views_of(const Scene& scene, int pixels, Likeness::Views views) {
    PictureSettings common;
    common.width = common.height = pixels;
    common.edges = EdgeLines::no;
    common.occlusion = false; // it is an estimate from depths, with noise of its own
    const bool six = views == Likeness::Views::six;
    std::vector<PictureSettings> all(six ? 6 : 8, common);
    for (std::size_t i = 0; i < (six ? 4U : 8U); ++i) all[i].turn = static_cast<double>(i % 4) * pi / 2;
    if (six) {
        all[4].viewpoint = Viewpoint::top;
        all[5].viewpoint = Viewpoint::bottom;
    } else {
        // The direction of Viewpoint::corner, from below.
        const Camera camera = camera_of(scene, common);
        const Vec3 below = camera.front + cross(camera.up, camera.front) * 0.55 - camera.up * 0.45;
        for (std::size_t i = 4; i < 8; ++i) all[i].from = below;
    }
    for (PictureSettings& view : all) view.camera = camera_of(scene, view);
    return all;
}

std::vector<Picture> pictures_of(const Scene& given, std::vector<PictureSettings> views) {
    const auto posed = io::posed(given);
    const Scene& scene = posed ? *posed : given;
    std::vector<Diagnostic> ignored; // stages that draw or write report missing images
    const auto materials = io::MaterialResolver().materials(scene, ignored);
    std::vector<Picture> all;
    all.reserve(views.size());
    for (PictureSettings& view : views) {
        view.materials = materials;
        all.push_back(picture_of(scene, view));
    }
    return all;
}

struct PixelSum {
    std::uint64_t squares = 0, covered = 0; // below 2^63 for pictures of 8192 pixels a side
};

std::uint64_t square(std::int64_t x) { return static_cast<std::uint64_t>(x * x); }

void add_difference(const Picture& a, const Picture& b, PixelSum& sum) {
    for (std::size_t i = 0; i < a.rgba.size(); i += 4) {
        const std::int64_t alpha_a = a.rgba[i + 3], alpha_b = b.rgba[i + 3];
        if (alpha_a == 0 && alpha_b == 0) continue;
        ++sum.covered;
        const std::int64_t whiter = 255 * (alpha_b - alpha_a); // the background seen through a, less b
        for (std::size_t c = 0; c < 3; ++c) {
            const std::int64_t on_black = a.rgba[i + c] * alpha_a - b.rgba[i + c] * alpha_b;
            sum.squares += (square(on_black) + square(on_black + whiter)) >> 8;
        }
    }
}

double difference_of(const PixelSum& sum) {
    constexpr double full = 6.0 * 255 * 255 * 255 * 255 / 256; // three colours on two backgrounds
    return sum.covered == 0 ? 0 : static_cast<double>(sum.squares) / static_cast<double>(sum.covered) / full;
}

/// The brightness on white, from 0 to 255 (ITU-R BT.601).
double brightness_of(const Picture& p, std::size_t pixel) {
    const std::uint8_t* c = &p.rgba[4 * pixel];
    return (0.299 * c[0] + 0.587 * c[1] + 0.114 * c[2]) * c[3] / 255 + (255 - c[3]);
}

struct WindowSum {
    double similarity = 0, windows = 0;
};

/// Adds the similarity of a window of 8 x 8 pixels.
void add_window(const Picture& a, const Picture& b, int left, int top, WindowSum& sum) {
    constexpr int side = 8;
    double n = 0, sa = 0, sb = 0, saa = 0, sbb = 0, sab = 0;
    bool covered = false;
    for (int y = top; y < std::min(top + side, a.height); ++y)
        for (int x = left; x < std::min(left + side, a.width); ++x) {
            const auto at =
                static_cast<std::size_t>(y) * static_cast<std::size_t>(a.width) + static_cast<std::size_t>(x);
            covered = covered || a.rgba[4 * at + 3] > 0 || b.rgba[4 * at + 3] > 0;
            const double p = brightness_of(a, at), q = brightness_of(b, at);
            n += 1;
            sa += p;
            sb += q;
            saa += p * p;
            sbb += q * q;
            sab += p * q;
        }
    if (!covered) return;
    const double ma = sa / n, mb = sb / n, va = saa / n - ma * ma, vb = sbb / n - mb * mb,
                 cov = sab / n - ma * mb;
    constexpr double c1 = 0.01 * 255 * 0.01 * 255, c2 = 0.03 * 255 * 0.03 * 255; // the paper's constants
    sum.similarity += (2 * ma * mb + c1) * (2 * cov + c2) / ((ma * ma + mb * mb + c1) * (va + vb + c2));
    sum.windows += 1;
}

/// Four times the difference of each colour, on black.
Picture difference_picture(const Picture& a, const Picture& b) {
    Picture out = a;
    for (std::size_t i = 0; i < out.rgba.size(); i += 4) {
        for (std::size_t c = 0; c < 3; ++c) {
            const int on_white = (a.rgba[i + c] * a.rgba[i + 3] - b.rgba[i + c] * b.rgba[i + 3]) / 255 +
                                 (b.rgba[i + 3] - a.rgba[i + 3]);
            out.rgba[i + c] = static_cast<std::uint8_t>(std::min(255, 4 * std::abs(on_white)));
        }
        out.rgba[i + 3] = 255;
    }
    return out;
}

} // namespace

Likeness::Likeness(const Scene& scene, int pixels, Views views) {
    const auto posed = io::posed(scene);
    settings_ = views_of(posed ? *posed : scene, pixels, views);
    pictures_ = pictures_of(scene, settings_);
}

double Likeness::difference(const Scene& other) const {
    const std::vector<Picture> pictures = pictures_of(other, settings_);
    PixelSum sum;
    for (std::size_t i = 0; i < pictures.size(); ++i) add_difference(pictures_[i], pictures[i], sum);
    return difference_of(sum);
}

Likeness::Comparison Likeness::compared(const Scene& other) const {
    const std::vector<Picture> pictures = pictures_of(other, settings_);
    PixelSum sum;
    WindowSum windows;
    std::vector<Picture> cells;
    cells.reserve(3 * pictures.size());
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        const Picture &a = pictures_[i], &b = pictures[i];
        add_difference(a, b, sum);
        for (int y = 0; y < a.height; y += 4)
            for (int x = 0; x < a.width; x += 4) add_window(a, b, x, y, windows);
        cells.push_back(a);
        cells.push_back(b);
        cells.push_back(difference_picture(a, b));
    }
    return {difference_of(sum), windows.windows > 0 ? windows.similarity / windows.windows : 1,
            sheet_of(cells, 3)};
}

} // namespace facetmill::report
