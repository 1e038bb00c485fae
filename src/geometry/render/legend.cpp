#include "geometry/render/legend.hpp"

#include "base/math/numbers.hpp"
#include "geometry/render/font.hpp"
#include "geometry/render/srgb.hpp"

#include <fmt/format.h>
#include <limits>

namespace facetmill {

namespace {

using Ink = std::array<std::uint8_t, 3>;

constexpr int letters_wide = 17; ///< width of the legend in letters
constexpr int bar_letters = 3;   ///< the width of the colours and the ticks, in letters

int letter_scale(const PictureSettings& s) {
    return std::clamp(std::min(s.width / 500, s.height / 300), 1, 8);
}

/// Dark ink on a light or transparent ground, otherwise light.
Ink ink_for(const PictureSettings& s) {
    if (!s.ground) return {64, 64, 64};
    const auto& g = *s.ground;
    const float light = 0.2126f * g[0] + 0.7152f * g[1] + 0.0722f * g[2]; // ITU-R BT.709
    return light < 0.18f ? Ink{235, 235, 235} : Ink{32, 32, 32};
}

std::array<std::uint8_t, 4> bytes_of(const Colour& c) {
    return {srgb_of(c[0]), srgb_of(c[1]), srgb_of(c[2]), 255};
}

void fill(Picture& p, int x0, int y0, int x1, int y1, const std::array<std::uint8_t, 4>& rgba) {
    for (int y = std::max(0, y0); y < std::min(p.height, y1); ++y)
        for (int x = std::max(0, x0); x < std::min(p.width, x1); ++x)
            std::copy(rgba.begin(), rgba.end(),
                      &p.rgba[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(p.width) +
                                   static_cast<std::size_t>(x))]);
}

std::string shortened(const std::string& text) {
    std::size_t count = 0, cut = 0; // number of characters; number of bytes kept before the dots
    for (std::size_t i = 0; i < text.size(); i += character_length(text, i)) {
        if (count == letters_wide - 2) cut = i;
        ++count;
    }
    return count > letters_wide ? text.substr(0, cut) + ".." : text;
}

std::string number_text(double x, int digits = 4) { return fmt::format("{:.{}g}", x == 0 ? 0.0 : x, digits); }

constexpr const char* missing_text = "no value";

/// The lines below the scale. A colour swatch precedes missing_text.
std::vector<std::string> footnotes(const ValueRange& range) {
    std::vector<std::string> lines;
    if (range.percentiles) lines.push_back(range.diverging ? "to the 99th pct" : "1st to 99th pct");
    if (range.beyond()) {
        lines.push_back("all: " + number_text(range.min));
        lines.push_back("  to " + number_text(range.max));
    }
    if (range.missing > 0) lines.push_back(missing_text);
    return lines;
}

int line_height(const PictureSettings& s) { return (letter_height + 3) * letter_scale(s); }

/// The rows of pixels of the colour bar.
struct Bar {
    int top, bottom;
};

Bar bar_of(const PictureSettings& s, const ValueRange& range) {
    const int line = line_height(s);
    return {(s.unit.empty() ? 3 : 4) * line,
            s.height - (2 + static_cast<int>(footnotes(range).size())) * line};
}

/// Whether the text gives the number to within `error`.
bool says(const std::string& text, double x, double error) {
    const auto read = parse_real(text);
    return read && std::abs(*read - x) <= error;
}

/// Copies the picture to the left of a wider picture.
Picture widened(const Picture& picture, const PictureSettings& settings) {
    Picture out = picture;
    out.width = settings.width;
    const std::size_t from = 4 * static_cast<std::size_t>(picture.width),
                      to = 4 * static_cast<std::size_t>(out.width);
    out.rgba.assign(to * static_cast<std::size_t>(out.height), 0);
    for (std::size_t y = 0; y < static_cast<std::size_t>(out.height); ++y)
        std::copy_n(&picture.rgba[y * from], from, &out.rgba[y * to]);
    if (!settings.ground) return out;
    fill(out, picture.width, 0, out.width, out.height, bytes_of(*settings.ground));
    return out;
}

} // namespace

int legend_width(const PictureSettings& settings, const ValueRange& range) {
    if (!settings.legend || (!range.known && range.identifiers.empty())) return 0;
    const int width = letters_wide * letter_width * letter_scale(settings);
    if (!range.known) {
        const int lines = 3 + static_cast<int>(range.identifiers.size());
        return 2 * width <= settings.width && lines * line_height(settings) <= settings.height ? width : 0;
    }
    const Bar bar = bar_of(settings, range);
    return 2 * width <= settings.width && bar.bottom - bar.top >= 2 * line_height(settings) ? width : 0;
}

std::vector<double> round_numbers(double low, double high, std::size_t most) {
    const double span = high - low;
    if (!(span > 0) || !std::isfinite(span)) return {low, high};
    double step = 1;
    while (step * static_cast<double>(most) < span) step *= 10;
    while (step / 10 * static_cast<double>(most) >= span) step /= 10;
    for (const double part : {5.0, 2.0}) // the smallest of 1/5, 1/2 and 1 that is wide enough
        if (step / part * static_cast<double>(most - 1) >= span) {
            step /= part;
            break;
        }
    std::vector<double> numbers;
    for (double k = std::ceil(low / step); k * step <= high && numbers.size() < most; ++k) {
        if (k + 1 == k) return {low, high}; // beyond 2^53: neighbouring doubles are farther apart than steps
        numbers.push_back(k * step);
    }
    return numbers.size() < 2 ? std::vector<double>{low, high} : numbers;
}

std::vector<std::string> number_texts(const std::vector<double>& numbers, std::size_t letters) {
    double gap = HUGE_VAL;
    for (std::size_t i = 1; i < numbers.size(); ++i)
        if (numbers[i] > numbers[i - 1]) gap = std::min(gap, numbers[i] - numbers[i - 1]);
    std::vector<std::string> texts;
    for (int digits = 4; digits <= std::numeric_limits<double>::max_digits10; ++digits) {
        std::vector<std::string> longer;
        bool fit = true, enough = true;
        for (const double x : numbers) {
            longer.push_back(number_text(x, digits));
            fit = fit && longer.back().size() <= letters;
            enough = enough && says(longer.back(), x, gap / 100);
        }
        if (!fit && digits > 4) break;
        texts = std::move(longer);
        if (enough) break;
    }
    return texts;
}

namespace {
/// The colour of each identifier, next to its number.
Picture with_identifiers(const Picture& picture, const PictureSettings& settings, const ValueRange& range) {
    Picture out = widened(picture, settings);
    const int scale = letter_scale(settings), line = line_height(settings);
    const Ink ink = ink_for(settings);
    const int left = picture.width, right = left + letter_width * scale * 2;
    write_text(out, left, line, scale, shortened(settings.attribute), ink);
    int y = 3 * line;
    for (const std::uint64_t id : range.identifiers) {
        fill(out, left, y, right, y + letter_height * scale, bytes_of(distinct_colour(id)));
        write_text(out, right + 5 * scale, y, scale, fmt::format("{}", id), ink);
        y += line;
    }
    return out;
}
} // namespace

Picture with_legend(const Picture& picture, const PictureSettings& settings, const ValueRange& range) {
    if (!range.known) return with_identifiers(picture, settings, range);
    Picture out = widened(picture, settings);
    const int scale = letter_scale(settings), line = line_height(settings);
    const Ink ink = ink_for(settings);
    const int left = picture.width, bar = left + letter_width * scale * 2;
    const std::vector<std::string> notes = footnotes(range);
    const auto [top, bottom] = bar_of(settings, range);
    write_text(out, left, line, scale, shortened(settings.attribute), ink);
    if (!settings.unit.empty()) write_text(out, left, 2 * line, scale, shortened("in " + settings.unit), ink);
    for (int y = top; y < bottom; ++y) {
        const Colour c = on_the_scale_of(range, (bottom - y - 0.5) / (bottom - top));
        fill(out, left, y, bar, y + 1, bytes_of(c));
    }
    const auto most = static_cast<std::size_t>(std::clamp((bottom - top) / (3 * line), 2, 9));
    const std::vector<double> numbers = round_numbers(range.low, range.high, most);
    const std::vector<std::string> texts = number_texts(numbers, letters_wide - bar_letters);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const double at = bottom - in_range(numbers[i], range) * (bottom - top);
        const int y = static_cast<int>(std::floor(std::clamp<double>(at, top, bottom) + 0.5));
        fill(out, bar, y - scale / 2, bar + 3 * scale, y - scale / 2 + scale, {ink[0], ink[1], ink[2], 255});
        write_text(out, bar + 5 * scale, y - letter_height * scale / 2, scale, texts[i], ink);
    }
    for (std::size_t i = 0; i < notes.size(); ++i) {
        const int y = bottom + line + static_cast<int>(i) * line;
        const bool missing = notes[i] == missing_text;
        if (missing) fill(out, left, y, bar, y + letter_height * scale, bytes_of(missing_colour));
        write_text(out, missing ? bar + 5 * scale : left, y, scale, shortened(notes[i]), ink);
    }
    return out;
}

} // namespace facetmill
