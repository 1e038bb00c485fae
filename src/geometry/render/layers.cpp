#include "geometry/render/layers.hpp"

namespace facetmill {

Layers::Layers(const std::vector<std::uint32_t>& numbers, int first_row, int last_row, const Canvas& canvas,
               const SceneDrawing& drawing, const Shader& shader, LastFacings& last)
    : first_(first_row), last_(last_row), width_(canvas.width / Canvas::samples) {
    // Deep layers are dropped once many have accumulated, so that memory does not grow with the depth.
    constexpr std::size_t enough = bytes / sizeof(Layer);
    std::size_t limit = enough;
    for (const std::uint32_t number : numbers) {
        const PartDrawing& part = drawing.part_of(number);
        add(number, part, canvas, shader, last);
        if (layers_.size() < limit) continue;
        sort_and_cut();
        limit = std::max(enough, 2 * layers_.size());
    }
    sort_and_cut();
}

void Layers::add(std::uint32_t number, const PartDrawing& part, const Canvas& canvas, const Shader& shader,
                 LastFacings& last) {
    constexpr int n = Canvas::samples;
    const CanvasTriangle t = part.triangle(number - part.first());
    if (!t.drawn()) return;
    const std::size_t before = layers_.size();
    // Samples come row by row, so a pixel's samples are not consecutive.
    const SampleBox box = samples_around(t.p[0], t.p[1], t.p[2], first_, last_, canvas.width);
    for_each_sample(t, part.front(t.p), box, [&](int x, int y, double z) {
        if (!(static_cast<float>(z) > canvas.depth(canvas.at(x, y)))) return;
        const auto pixel = static_cast<std::uint32_t>((y - first_) / n * width_ + x / n);
        layers_.push_back(
            {pixel, number, static_cast<float>(z), static_cast<std::uint8_t>(1 << (y % n * n + x % n)), {}});
    });
    const auto begin = layers_.begin() + static_cast<std::ptrdiff_t>(before);
    std::stable_sort(begin, layers_.end(), [](const Layer& a, const Layer& b) { return a.pixel < b.pixel; });
    std::size_t kept = before;
    for (std::size_t i = before; i < layers_.size();) {
        Layer one = layers_[i];
        double sum_x = 0, sum_y = 0, count = 0;
        for (; i < layers_.size() && layers_[i].pixel == one.pixel; ++i) {
            one.samples |= layers_[i].samples;
            one.depth = std::max(one.depth, layers_[i].depth);
            const int bit = layers_[i].samples == 1   ? 0
                            : layers_[i].samples == 2 ? 1
                            : layers_[i].samples == 4 ? 2
                                                      : 3;
            sum_x += bit % n + 0.5;
            sum_y += bit / n + 0.5;
            ++count;
        }
        const double x = static_cast<double>(one.pixel % static_cast<std::uint32_t>(width_)) * n;
        const double y = static_cast<double>(one.pixel / static_cast<std::uint32_t>(width_)) * n + first_;
        one.shade = shader.colour(number, x + sum_x / count, y + sum_y / count, 1, last);
        layers_[kept++] = one;
    }
    layers_.resize(kept);
}

void Layers::sort_and_cut() {
    std::sort(layers_.begin(), layers_.end(), [](const Layer& a, const Layer& b) {
        if (a.pixel != b.pixel) return a.pixel < b.pixel;
        return a.depth != b.depth ? a.depth > b.depth : a.number < b.number;
    });
    std::size_t kept = 0;
    std::uint32_t pixel_before = 0;
    std::array<std::size_t, Canvas::samples * Canvas::samples> over{}; // each sample of the pixel
    for (std::size_t i = 0; i < layers_.size(); ++i) {
        Layer layer = layers_[i];
        if (layer.pixel != pixel_before) over = {};
        for (std::size_t k = 0; k < over.size(); ++k)
            if ((layer.samples >> k & 1) && ++over[k] > most)
                layer.samples = static_cast<std::uint8_t>(layer.samples & ~(1U << k));
        pixel_before = layer.pixel;
        if (layer.samples != 0) layers_[kept++] = layer;
    }
    layers_.resize(kept);
}

void Layers::lay_over(int x, int y, std::array<Texel, Canvas::samples * Canvas::samples>& shades) const {
    if (layers_.empty()) return;
    const auto pixel = static_cast<std::uint32_t>((y - first_ / Canvas::samples) * width_ + x);
    const auto begin = std::lower_bound(layers_.begin(), layers_.end(), pixel,
                                        [](const Layer& layer, std::uint32_t p) { return layer.pixel < p; });
    auto end = begin;
    while (end != layers_.end() && end->pixel == pixel) ++end;
    while (end != begin) {
        const Layer& layer = *--end;
        const float alpha = std::clamp(layer.shade[3], 0.0f, 1.0f);
        for (std::size_t i = 0; i < shades.size(); ++i) {
            if (!(layer.samples >> i & 1)) continue;
            for (std::size_t c = 0; c < 3; ++c)
                shades[i][c] = shades[i][c] * (1 - alpha) + std::min(layer.shade[c], 1.0f) * alpha;
            shades[i][3] = shades[i][3] * (1 - alpha) + alpha;
        }
    }
}

} // namespace facetmill
