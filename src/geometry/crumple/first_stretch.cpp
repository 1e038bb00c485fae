#include "geometry/crumple/first_stretch.hpp"

#include "base/math/random.hpp"
#include "geometry/split/split.hpp"

#include <bit>
#include <cmath>
#include <limits>

namespace facetmill {

namespace {

// The sample: faces in one of `one_cube_in` cubes, each `cube_width` mean edges wide.
constexpr std::uint64_t one_cube_in = 16;
constexpr double cube_width = 16;
// If at most half of the faces are stretched by this much, no sample is needed.
constexpr double little_stretch = 0.5;

/// The region of a sample of the faces: some of the cubes that divide space.
class SampledCubes {
  public:
    explicit SampledCubes(double width) : width_(width) {}
    bool has(const Vec3& p) const {
        std::uint64_t key = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const double cell = std::floor(p[i] / width_);
            key = hashed(key, std::bit_cast<std::uint64_t>(cell == 0 ? 0.0 : cell));
        }
        return key % one_cube_in == 0;
    }

  private:
    double width_;
};

/// The sheet's faces that begin in the cubes, as a separate sheet.
struct SampledSheet {
    Mesh mesh;
    CrumpleSheet sheet;

    SampledSheet(const CrumpleSheet& from, const SampledCubes& cubes) {
        const Mesh& all = *from.mesh;
        constexpr Index unused = std::numeric_limits<Index>::max();
        std::vector<Index> number(all.vertex_count(), unused);
        for (Index f = 0; f < all.face_count(); ++f) {
            if (!cubes.has(all.point(all.face_begin(f)))) continue;
            std::vector<Index> corners;
            for (Index c = all.face_begin(f); c < all.face_end(f); ++c) {
                const Index v = all.vertex(c);
                if (number[v] == unused) {
                    number[v] = static_cast<Index>(mesh.positions.size());
                    mesh.positions.push_back(all.positions[v]);
                    sheet.moves.keys.push_back(from.moves.keys[v]);
                    sheet.moves.moves.push_back(from.moves.moves[v]);
                }
                corners.push_back(number[v]);
            }
            add_face(mesh, corners);
        }
    }
};

/// Whether more than an eighth of the faces intersect if stretched by up to `stretch` times their longest
/// edge. Lowers levels.
bool mostly_in_trouble(std::vector<TestSheet>& tests, std::vector<std::uint8_t>& levels, double stretch) {
    FacesOfSheets found(tests.size());
    slacken(tests, levels, stretch, found);
    std::size_t faces = 0, meeting = 0;
    for (TestSheet& test : tests) {
        test.place(levels, {});
        const MeetingFaces trouble = test.in_trouble(levels);
        const std::size_t count = test.face_count();
        faces += count;
        meeting += trouble.too_many
                       ? count
                       : static_cast<std::size_t>(std::count(trouble.faces.begin(), trouble.faces.end(), 1));
    }
    return 8 * meeting > faces;
}

/// The largest first stretch of faces for which at most an eighth intersect, estimated from a sample.
/// Otherwise a round would lower most positions, after examining very many pairs.
double sampled_stretch(std::span<const CrumpleSheet> sheets, double mean_edge, std::size_t max_pairs) {
    const SampledCubes cubes(cube_width * mean_edge);
    std::vector<SampledSheet> samples;
    samples.reserve(sheets.size());
    std::vector<CrumpleSheet> sampled;
    sampled.reserve(sheets.size());
    for (const CrumpleSheet& sheet : sheets) samples.emplace_back(sheet, cubes);
    for (SampledSheet& sample : samples) sampled.push_back({&sample.mesh, std::move(sample.sheet.moves)});
    const CrumplePlaces places(sampled);
    std::vector<std::uint8_t> levels(places.count);
    std::vector<TestSheet> tests = tests_of(sampled, places, max_pairs);
    double stretch = max_stretch;
    while (stretch > least_stretch && mostly_in_trouble(tests, levels, stretch)) stretch /= 2;
    return stretch;
}

} // namespace

double first_stretch(std::span<const CrumpleSheet> sheets, const std::vector<TestSheet>& tests,
                     const std::vector<std::uint8_t>& levels, std::size_t max_pairs) {
    std::size_t faces = 0, drawn = 0;
    double edges = 0;
    for (const TestSheet& test : tests) {
        const auto far = test.overstretched(levels, little_stretch);
        faces += far.size();
        drawn += static_cast<std::size_t>(std::count(far.begin(), far.end(), 1));
        edges += mean_edge(test.mesh_before(), {}) * static_cast<double>(far.size());
    }
    if (2 * drawn <= faces || !(edges > 0) || !std::isfinite(edges)) return max_stretch;
    return sampled_stretch(sheets, edges / static_cast<double>(faces), max_pairs);
}

} // namespace facetmill
