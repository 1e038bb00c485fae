#include "support/catch.hpp"

#include "base/math/random.hpp"
#include "geometry/deviation/deviation.hpp"
#include "geometry/spatial/closest_point.hpp"
#include "mesh/shapes.hpp"
#include "mesh/surface.hpp"
#include "parallel/parallel.hpp"
#include "support/meshes.hpp"

#include <algorithm>

using namespace facetmill;

TEST_CASE("a surface does not deviate from itself", "[geometry]") {
    const Mesh mesh = test::noisy_icosphere(3, 0.1, 1);
    const auto d = deviation(mesh, mesh, {.samples = 2000, .certify = true});
    CHECK(d.maximum() == 0);
    CHECK(d.rms() == 0);
    CHECK(d.forward.samples == 2000);
    CHECK(d.forward.vertices == mesh.vertex_count());
    CHECK(*d.bound() <= 1e-6 * d.diagonal);
}

TEST_CASE("a surface against itself has the figures of a search that finds nothing", "[geometry]") {
    Surface flat; // without an area: vertices are measured
    flat.positions = {{0, 0, 0}, {1, 2, 3}, {2, 4, 6}, {9, 9, 9}};
    flat.corners = {0, 1, 2};
    for (const Surface& surface :
         {surface_of(test::noisy_icosphere(2, 0.1, 1)), surface_of(shapes::grid(3, 2)), flat, Surface{}}) {
        Surface other = surface;
        other.positions.push_back({0.5, 0.5, 0.5}); // no triangle uses it, but the arrays differ
        const DeviationSettings settings{.samples = 500, .seed = 7};
        const auto quick = deviation(surface, surface, settings),
                   searched = deviation(surface, other, settings);
        CHECK(quick.diagonal == searched.diagonal);
        CHECK(quick.seed == searched.seed);
        for (const auto way : {&DeviationResult::forward, &DeviationResult::backward}) {
            const DirectedDeviation &a = quick.*way, &b = searched.*way;
            CHECK(a.maximum == 0);
            CHECK(a.maximum == b.maximum);
            CHECK(a.rms == b.rms);
            CHECK(a.mean == b.mean);
            CHECK(a.samples == b.samples);
            CHECK(a.averaged == b.averaged);
            CHECK(a.vertices == b.vertices);
            CHECK(a.face == b.face);
            CHECK(a.from == b.from);
            CHECK(a.to == b.to);
        }
    }
}

TEST_CASE("a lifted sheet is apart by the lift, both ways", "[geometry]") {
    const auto d = deviation(shapes::grid(4, 3), test::moved(shapes::grid(4, 3), {0, 0, 0.25}));
    for (const auto* way : {&d.forward, &d.backward}) {
        CHECK(way->maximum == Approx(0.25));
        CHECK(way->rms == Approx(0.25));
        CHECK(way->mean == Approx(0.25));
    }
    CHECK(d.diagonal == 5);
    CHECK(d.percent(d.maximum()) == Approx(5));
}

TEST_CASE("a surface with a part missing is far one way only", "[geometry]") {
    const auto d = deviation(shapes::grid(2, 1), shapes::grid(1, 1), {.mean_error = 0, .certify = true});
    CHECK(d.forward.maximum == 1); // at a vertex, because vertices are samples too
    CHECK(d.forward.from.x == 2);
    CHECK(d.forward.to.x == 1);
    CHECK(d.forward.face == none);
    CHECK(d.forward.mean == Approx(0.25).epsilon(1e-3)); // half of the area is 0 away, the rest 0 to 1
    CHECK(d.forward.rms == Approx(std::sqrt(1.0 / 6)).epsilon(1e-3));
    CHECK(d.backward.maximum < 1e-15);
    CHECK(d.maximum() == 1);
    CHECK(*d.bound() == Approx(1).epsilon(0.011));
}

TEST_CASE("the farthest point may be inside a face; the bound knows", "[geometry]") {
    // A flat square against a square with a peak: with no samples at all, the corners alone see 0.
    Mesh flat = shapes::grid(1, 1), peak;
    peak.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 1}};
    peak.corners = {0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4};
    const auto blind = deviation(flat, peak, {.samples = 0});
    CHECK(blind.forward.maximum == 0);
    const auto sure =
        deviation_to(surface_of(flat), FaceTree(surface_of(peak)), {.samples = 0, .certify = true});
    const double truth = 0.5 / std::sqrt(1.25); // from the middle to the plane of a side, 1 up and 0.5 aside
    CHECK(sure.maximum <= truth * (1 + 1e-12));
    CHECK(*sure.bound >= truth * (1 - 1e-12));
    CHECK(*sure.bound <= truth * 1.011);
    const auto both = deviation(flat, peak, {.samples = 0, .certify = true});
    CHECK(both.backward.maximum == 1);
    CHECK(*both.bound() >= 1);
    CHECK(*both.bound() <= 1.01 + 1e-6 * both.diagonal);
}

TEST_CASE("the bound of a corrugated sheet is what its slopes say", "[geometry]") {
    // Ridges along y, each 1 wide on either side, against a flat square: below a ridge the slopes are
    // nearest.
    const double height = GENERATE(0.02, 0.25, 2.0);
    Mesh ridges = shapes::grid(24, 24), flat = shapes::grid(1, 1);
    for (Vec3& p : ridges.positions) p.z = static_cast<int>(p.x) % 2 * height;
    for (Vec3& p : flat.positions) p *= 24;
    const double truth = height / std::sqrt(1 + height * height);
    for (const std::size_t samples : {std::size_t{0}, std::size_t{2000}}) {
        const auto d = deviation(ridges, flat, {.samples = samples, .certify = true});
        CHECK(*d.forward.bound >= height);
        CHECK(*d.forward.bound <= height * 1.01 + 1e-6 * d.diagonal);
        CHECK(d.backward.maximum <= truth * (1 + 1e-12));
        CHECK(*d.backward.bound >= truth * (1 - 1e-12));
        CHECK(*d.backward.bound <= height * 1.01 + 1e-6 * d.diagonal); // only the larger direction is bounded
        const auto back = deviation_to(surface_of(flat), FaceTree(surface_of(ridges)),
                                       {.samples = samples, .certify = true});
        CHECK(*back.bound >= truth * (1 - 1e-12));
        CHECK(*back.bound <= truth * 1.01 + 1e-6 * d.diagonal);
    }
}

TEST_CASE("most of rough surfaces is bounded without looking up closest points", "[geometry]") {
    const Mesh fine = test::noisy_icosphere(6, 0.004, 1), coarse = test::noisy_icosphere(4, 0.004, 2);
    const auto d = deviation(fine, coarse, {.certify = true});
    for (const auto* way : {&d.forward, &d.backward}) {
        CHECK(way->looked_up < 10000);
        CHECK(*way->bound >= way->maximum);
        CHECK(*way->bound <= d.maximum() * 1.01 + 1e-6 * d.diagonal);
    }
    // No point of many more is beyond the bound.
    const auto many = deviation(fine, coarse, {.samples = 1000000, .mean_error = 0, .seed = 3});
    CHECK(*d.forward.bound >= many.forward.maximum);
    CHECK(*d.backward.bound >= many.backward.maximum);
    for (const int count : {1, 3}) {
        set_threads(count);
        const auto again = deviation(fine, coarse, {.certify = true});
        set_threads(0);
        CHECK(*again.forward.bound == *d.forward.bound);
        CHECK(*again.backward.bound == *d.backward.bound);
        CHECK(again.backward.from == d.backward.from);
        CHECK(again.backward.looked_up == d.backward.looked_up);
    }
}

TEST_CASE("the bound of each way is at least the maximum of both", "[geometry]") {
    // A square with a hole against the whole: its middle is found only while the way back is bounded.
    Surface ring, whole;
    ring.positions = {{0, 0, 0},   {2, 0, 0},    {2, 2, 0},     {0, 2, 0},
                      {.5, .5, 0}, {1.5, .5, 0}, {1.5, 1.5, 0}, {.5, 1.5, 0}};
    for (Index k = 0; k < 4; ++k) {
        const Index next = (k + 1) % 4;
        ring.corners.insert(ring.corners.end(), {k, next, 4 + next, k, 4 + next, 4 + k});
    }
    whole.positions = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}};
    whole.corners = {0, 1, 2, 0, 2, 3};
    for (const std::size_t samples : {0, 1000}) {
        const auto d = deviation(ring, whole, {.samples = samples, .certify = true});
        CHECK(d.maximum() == Approx(0.5).epsilon(0.01));
        CHECK(*d.forward.bound >= d.maximum());
        CHECK(*d.backward.bound >= d.maximum());
        CHECK(*d.bound() <= 0.505 + 1e-6 * d.diagonal);
    }
}

TEST_CASE("little work is enough for a bound where little of a surface is far", "[geometry]") {
    // A large triangle is near many small triangles, and its pieces are cut again before the next triangle.
    const Surface coarse = surface_of(test::noisy_icosphere(3, 0.004, 2)),
                  fine = surface_of(test::noisy_icosphere(6, 0.004, 1));
    const auto d = deviation_to(coarse, FaceTree(fine), {.certify = true, .certify_work = 400});
    CHECK(d.looked_up < 2000);
    CHECK(*d.bound >= d.maximum);
    CHECK(*d.bound <= d.maximum * 1.01 + 1e-6 * coarse.bounds().diagonal());
}

TEST_CASE("little work is enough for the bound of slivers that are far longer than they are apart",
          "[geometry]") {
    // A thin prism of 200 sides, compared with a prism of 160 sides. More slivers are near each sliver than
    // are tested together.
    const auto prism = [](Index sides) {
        Surface s;
        for (Index i = 0; i < sides; ++i)
            for (const double z : {0.0, 100.0}) {
                const double angle = 6.283185307179586 * i / sides;
                s.positions.push_back({0.5 * std::cos(angle), 0.5 * std::sin(angle), z});
            }
        for (Index i = 0; i < sides; ++i) {
            const Index a = 2 * i, b = 2 * ((i + 1) % sides);
            s.corners.insert(s.corners.end(), {a, b, a + 1, b, b + 1, a + 1});
        }
        return s;
    };
    Surface rough = prism(1000);
    for (std::size_t v = 0; v < rough.positions.size(); ++v)
        rough.positions[v].x += 0.05 * uniform(hashed(3, v));
    rough.positions[0].x += 0.3;
    const auto d = deviation(prism(1000), rough, {.samples = 1000, .certify = true});
    CHECK(d.forward.looked_up + d.backward.looked_up < 5000);
    CHECK(*d.bound() >= d.maximum());
    CHECK(*d.bound() <= d.maximum() * 1.01 + 1e-6 * d.diagonal);
}

TEST_CASE("little work leaves a bound that holds", "[geometry]") {
    const Mesh fine = test::noisy_icosphere(5, 0.004, 1), coarse = test::noisy_icosphere(3, 0.004, 2);
    const auto tight = deviation(fine, coarse, {.certify = true});
    for (const std::size_t work : {4, 400, 40000}) {
        const auto d = deviation(fine, coarse, {.certify = true, .certify_work = work});
        CHECK(*d.forward.bound >= tight.forward.maximum);
        CHECK(*d.backward.bound >= tight.backward.maximum);
    }
}

TEST_CASE("with no work to spend the bound is loose but holds", "[geometry]") {
    const Mesh fine = shapes::icosphere(4), coarse = shapes::icosphere(1);
    const auto loose = deviation(fine, coarse, {.certify = true, .certify_work = 0});
    const auto tight = deviation(fine, coarse, {.certify = true});
    CHECK(loose.forward.looked_up == 0);
    CHECK(*loose.bound() >= *tight.bound());
    CHECK(*tight.bound() >= tight.maximum());
    CHECK(*tight.bound() <= tight.maximum() * 1.01 + 1e-6 * tight.diagonal);
}

TEST_CASE("the samples depend on the seed and not on the threads", "[geometry]") {
    const Mesh a = test::noisy_icosphere(3, 0.1, 1), b = test::noisy_icosphere(3, 0.1, 2);
    const auto one = deviation(a, b, {.samples = 5000, .certify = true});
    set_threads(1);
    const auto same = deviation(a, b, {.samples = 5000, .certify = true});
    set_threads(0);
    CHECK(one.rms() == same.rms());
    CHECK(one.maximum() == same.maximum());
    CHECK(one.forward.from == same.forward.from);
    CHECK(*one.bound() == *same.bound());
    const auto other = deviation(a, b, {.samples = 5000, .seed = 2});
    CHECK(other.rms() != one.rms());
    CHECK(other.rms() == Approx(one.rms()).epsilon(0.05));
}

TEST_CASE("samples are spread by area", "[geometry]") {
    Mesh mesh = shapes::grid(1, 1); // two triangles of half a square
    mesh.positions[3] = {1, 1, 0};
    for (auto& p : mesh.positions) p.x *= 3;
    const Surface surface = surface_of(mesh);
    std::size_t left = 0;
    for (const auto& s : sample_area(surface, 3000, 7)) left += s.point.x < 1;
    CHECK(left == Approx(1000).margin(60));
}

TEST_CASE("nothing is infinitely far from something, and not from nothing", "[geometry]") {
    const auto d = deviation(shapes::cube(), Mesh{}, {.certify = true});
    CHECK(d.maximum() == HUGE_VAL);
    CHECK(deviation(Mesh{}, shapes::cube()).rms() == HUGE_VAL);
    CHECK(deviation(Mesh{}, Mesh{}, {.certify = true}).maximum() == 0);
}

TEST_CASE("points are measured as points: all of them, to the nearest, by any number of threads",
          "[geometry]") {
    const auto cloud = [](std::uint64_t seed, std::size_t count) {
        Scene scene;
        for (std::size_t i = 0; i < count; ++i) {
            scene.parts.resize(1);
            scene.parts[0].mesh.positions.push_back({uniform(hashed(seed, 3 * i)),
                                                     uniform(hashed(seed, 3 * i + 1)),
                                                     uniform(hashed(seed, 3 * i + 2))});
        }
        return isolated_vertices_of(scene);
    };
    const Surface a = cloud(1, 400), b = cloud(2, 300);
    const auto nearest = [](const Surface& from, const Surface& to) {
        std::vector<double> all;
        for (const Vec3& p : from.positions) {
            double least = HUGE_VAL;
            for (const Vec3& q : to.positions) least = std::min(least, length(p - q));
            all.push_back(least);
        }
        return all;
    };
    const auto d = deviation(a, b, {.certify = true});
    for (const auto& [way, all] :
         {std::pair(d.forward, nearest(a, b)), std::pair(d.backward, nearest(b, a))}) {
        double sum = 0, squares = 0;
        for (const double x : all) {
            sum += x;
            squares += x * x;
        }
        CHECK(way.maximum == *std::max_element(all.begin(), all.end()));
        CHECK(way.mean == Approx(sum / static_cast<double>(all.size())).epsilon(1e-12));
        CHECK(way.rms == Approx(std::sqrt(squares / static_cast<double>(all.size()))).epsilon(1e-12));
        CHECK(way.samples == 0);
        CHECK(way.vertices == all.size());
        CHECK(way.face == none);
        CHECK(length(way.from - way.to) == way.maximum);
        CHECK(*way.bound == Approx(d.maximum()).epsilon(1e-9));
    }
    set_threads(1);
    const auto alone = deviation(a, b);
    set_threads(0);
    CHECK(alone.forward.mean == d.forward.mean);
    CHECK(alone.backward.rms == d.backward.rms);
}

TEST_CASE("isolated vertices are those without faces, in the world", "[geometry]") {
    Scene scene;
    scene.parts.resize(2);
    scene.parts[0].mesh = shapes::cube();
    scene.parts[0].mesh.positions.push_back({1, 2, 3});
    scene.parts[0].transform.m[0][3] = 10;
    scene.parts[1].mesh.positions = {{5, 5, 5}};
    const Surface points = isolated_vertices_of(scene);
    REQUIRE(points.positions == std::vector<Vec3>{{11, 2, 3}, {5, 5, 5}});
    CHECK(points.size() == 2);
    const Surface all = joined(surface_of(scene.parts[0]), points);
    CHECK(all.size() == 14);
    CHECK(all.face(11) == 11);
    CHECK(all.face(12) == none);
    CHECK(all.point(13, 2) == Vec3{5, 5, 5});
}

namespace {

/// The deviation by definition, computed for each point separately.
struct Plain {
    double maximum = 0, rms = 0, mean = 0;
};

Plain plainly(const Surface& from, const Surface& to, std::size_t count) {
    const FaceTree tree(to);
    Plain plain;
    double squares = 0;
    const auto samples = sample_area(from, count, 1);
    for (const SurfaceSample& s : samples) {
        const double distance = closest_point(tree, s.point).distance;
        plain.maximum = std::max(plain.maximum, distance);
        plain.mean += distance / static_cast<double>(samples.size());
        squares += distance * distance;
    }
    for (const Index v : from.corners)
        if (is_finite(from.positions[v]))
            plain.maximum = std::max(plain.maximum, closest_point(tree, from.positions[v]).distance);
    plain.rms = std::sqrt(squares / static_cast<double>(samples.size()));
    return plain;
}

/// A triangle far from everything else.
Mesh with_stray(Mesh mesh, double away) {
    const auto first = static_cast<Index>(mesh.positions.size());
    for (const Vec3& p : {Vec3{0, 0, 0}, Vec3{0.1, 0, 0}, Vec3{0, 0.1, 0}})
        mesh.positions.push_back(p + Vec3{away, 0, 0});
    for (Index k = 0; k < 3; ++k) mesh.corners.push_back(first + k);
    return mesh;
}

} // namespace

TEST_CASE("a deviation is what each point by itself says, by any number of threads", "[geometry]") {
    Mesh thin = test::noisy_torus(30, 16, 0.03, 5);
    for (Vec3& p : thin.positions) p.z *= 1e-5;
    Mesh broken = test::noisy_icosphere(3, 0.05, 3);
    broken.positions[5].x = std::nan("");
    broken.positions[9].y = HUGE_VAL;
    Mesh lifted = shapes::cube();
    lifted.positions[7].x += 1e-9;
    const std::pair<Mesh, Mesh> pairs[] = {
        {shapes::icosphere(4), shapes::icosphere(2)},
        {test::noisy_icosphere(4, 0.1, 1), test::noisy_icosphere(2, 0.1, 2)},
        {test::noisy_torus(30, 16, 0.03, 5), shapes::cube()},
        {thin, test::noisy_torus(12, 8, 0.01, 5)},
        {test::moved(shapes::icosphere(3), {30, 0, 0}), shapes::icosphere(3)},
        {test::random_triangles(300, 0.2, 1), test::random_triangles(40, 0.9, 2)},
        {with_stray(shapes::icosphere(3), 1e4), shapes::icosphere(2)},
        {with_stray(shapes::icosphere(3), 1e9), with_stray(shapes::icosphere(2), -1e9)},
        {shapes::cube(), lifted},
        {broken, shapes::icosphere(2)}};
    for (const auto& [a, b] : pairs) {
        const Surface x = surface_of(a), y = surface_of(b);
        constexpr std::size_t samples = 3000;
        const auto d = deviation(x, y, {.samples = samples, .mean_error = 0});
        for (const auto& [way, plain] :
             {std::pair(d.forward, plainly(x, y, samples)), std::pair(d.backward, plainly(y, x, samples))}) {
            CHECK(way.maximum == plain.maximum);
            CHECK(way.rms == Approx(plain.rms).epsilon(1e-4));
            CHECK(way.mean == Approx(plain.mean).epsilon(1e-4));
            CHECK(way.samples == samples);
            CHECK(way.averaged == samples);
            CHECK(length(way.from - way.to) == Approx(way.maximum));
        }
        for (const int count : {1, 3}) {
            set_threads(count);
            const auto again = deviation(x, y, {.samples = samples, .mean_error = 0});
            CHECK(again.rms() == d.rms());
            CHECK(again.forward.mean == d.forward.mean);
            CHECK(again.backward.mean == d.backward.mean);
            CHECK(again.forward.from == d.forward.from);
            CHECK(again.backward.to == d.backward.to);
            const auto without = deviation(x, y, {.samples = samples, .means = false});
            for (const auto& [way, with] :
                 {std::pair(without.forward, d.forward), std::pair(without.backward, d.backward)}) {
                CHECK(way.maximum == with.maximum);
                CHECK(length(way.from - way.to) == Approx(way.maximum));
                CHECK(way.samples == samples);
                CHECK((way.rms == 0 && way.mean == 0 && way.averaged == 0));
            }
        }
        set_threads(0);
    }
}

TEST_CASE("means of some of the samples are those of all, and the maximum is that of all", "[geometry]") {
    const std::pair<Mesh, Mesh> pairs[] = {
        {shapes::icosphere(4), shapes::icosphere(2)},
        {shapes::icosphere(3), shapes::icosphere(5)},
        {test::noisy_icosphere(4, 0.1, 1), test::noisy_icosphere(3, 0.1, 2)},
        {test::noisy_icosphere(6, 0.02, 1), test::noisy_icosphere(5, 0.02, 2)},
        {test::noisy_torus(60, 32, 0.01, 5), test::noisy_torus(30, 16, 0.01, 5)},
        {test::noisy_torus(30, 16, 0.03, 5), shapes::cube()},
        {with_stray(shapes::icosphere(4), 1e4), shapes::icosphere(3)},
        {test::random_triangles(300, 0.2, 1), test::random_triangles(40, 0.9, 2)}};
    std::size_t fewer = 0, uneven = 0;
    for (const auto& [a, b] : pairs) {
        const Surface x = surface_of(a), y = surface_of(b);
        const auto d = deviation(x, y);
        for (const auto& [way, all] :
             {std::pair(d.forward, plainly(x, y, 100000)), std::pair(d.backward, plainly(y, x, 100000))}) {
            CHECK(way.maximum >= all.maximum);
            CHECK(way.rms == Approx(all.rms).epsilon(0.01));
            CHECK(way.mean == Approx(all.mean).epsilon(0.01));
            CHECK(way.samples == 100000);
            CHECK(way.averaged <= way.samples);
            fewer += way.averaged < way.samples;
            uneven += (18 * way.averaged + way.samples / 2) / way.samples % 2 != 0;
        }
        for (const int count : {1, 3}) {
            set_threads(count);
            const auto again = deviation(x, y);
            CHECK(again.rms() == d.rms());
            CHECK(again.maximum() == d.maximum());
            CHECK(again.backward.to == d.backward.to);
        }
        set_threads(0);
    }
    CHECK(fewer >= 8);
    CHECK(uneven > 0); // no more 18ths than needed, which need not be ninths
}

TEST_CASE("where deviation is rare all samples are averaged", "[geometry]") {
    Mesh dented = shapes::grid(60, 60);
    dented.positions[30 * 61 + 30].z += 0.05;
    const auto d = deviation(dented, shapes::grid(60, 60));
    CHECK(d.forward.averaged == 100000);
    CHECK(d.forward.maximum == Approx(0.05));
    Mesh touched = shapes::grid(60, 60); // by less than a sample in nine
    touched.positions.insert(touched.positions.end(), {{70, 0, 0.5}, {70.1, 0, 0.5}, {70, 0.1, 0.5}});
    for (Index k = 3; k > 0; --k) touched.corners.push_back(static_cast<Index>(touched.positions.size()) - k);
    CHECK(deviation(touched, shapes::grid(60, 60)).forward.averaged == 100000);
}

TEST_CASE("figures keep their digits at any size", "[geometry]") {
    const Mesh fine = test::noisy_icosphere(3, 0.05, 1), coarse = shapes::icosphere(2);
    const auto d = deviation(fine, coarse, {.samples = 2000});
    for (const double size : {0x1p-900, 0x1p-70, 0x1p70, 0x1p990}) {
        Mesh x = fine, y = coarse;
        for (Mesh* mesh : {&x, &y})
            for (Vec3& p : mesh->positions) p *= size;
        const auto scaled = deviation(x, y, {.samples = 2000});
        CHECK(scaled.maximum() / size == Approx(d.maximum()).epsilon(1e-12));
        CHECK(scaled.rms() / size == Approx(d.rms()).epsilon(1e-5));
    }
}

TEST_CASE("slivers that lie askew and meet in one place are measured as others are", "[geometry]") {
    // A cone of 3,000 slivers from its apex, compared with a cone of 300. The first is farther out
    // everywhere, because the chords of its base are shorter.
    const auto cone = [](std::size_t sides) {
        Surface s;
        s.positions.push_back({0, 0, 1});
        for (std::size_t i = 0; i < sides; ++i) {
            const double angle = 2 * 3.14159265358979 * static_cast<double>(i) / static_cast<double>(sides);
            s.positions.push_back({std::cos(angle), std::sin(angle), 0});
            s.corners.insert(s.corners.end(),
                             {0, static_cast<Index>(1 + i), static_cast<Index>(1 + (i + 1) % sides)});
        }
        return s;
    };
    const Surface fine = cone(3000), coarse = cone(300);
    const auto d = deviation(fine, coarse, {.certify = true});
    // The farthest point is in the middle of a chord, which is also its closest chord.
    const double truth = 1 - std::cos(3.14159265358979 / 300);
    CHECK(d.forward.maximum == Approx(truth).epsilon(1e-3));
    CHECK(*d.bound() >= d.maximum());
    CHECK(*d.bound() <= d.maximum() * 1.01 + 1e-6 * d.diagonal);
}

TEST_CASE("triangles that are all in one place are not searched one by one", "[geometry]") {
    Surface one; // searching the lowest of these triangles for each of these points would take minutes
    one.positions.assign(200000, Vec3{1, 2, 3});
    for (Index i = 0; i < 3 * 60000; ++i) one.corners.push_back(i);
    Surface other = one;
    other.corners.resize(3 * 50000);
    const auto d = deviation(one, other);
    CHECK(d.maximum() == 0);
    CHECK(d.forward.vertices == 180000);
}
