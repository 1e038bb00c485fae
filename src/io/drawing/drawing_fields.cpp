#include "io/drawing/drawing_fields.hpp"

namespace facetmill::io {

namespace {

using Flat = std::array<double, 2>;
Flat flat(const Vec2& p) { return {p.x, p.y}; }

/// A section or contour with moments.
struct SectionMoments {
    const Section* section = nullptr;
    const polygon::Moments* moments = nullptr;

    Vec3 centroid() const { return section->frame.point(moments->centroid); }
};

struct SectionContour {
    const Section* section = nullptr;
    const Contour* contour = nullptr;

    bool closed() const { return contour->role != ContourRole::open; }
    std::optional<SectionMoments> moments() const {
        if (!closed() || !contour->moments) return {};
        return SectionMoments{section, &*contour->moments};
    }
};

/// Second moments about a point. The moments in the plane follow P. Bourke, "Calculating the area and
/// centroid of a polygon" (1988). The moments in world space are integrals of products of coordinates.
struct MomentsAbout {
    polygon::SecondMoments plane;
    std::array<double, 6> world{}; ///< xx, yy, zz, xy, xz, yz
};

/// `point`: the vector from the reference point to the centroid, in world space.
MomentsAbout moments_about(const SectionMoments& of, const polygon::SecondMoments& plane, const Vec3& point) {
    const Vec3 &u = of.section->frame.u, &v = of.section->frame.v;
    const polygon::Moments& m = *of.moments;
    const auto product = [&](std::size_t i, std::size_t j) {
        return u[i] * u[j] * m.about_centroid.y + v[i] * v[j] * m.about_centroid.x +
               (u[i] * v[j] + v[i] * u[j]) * m.about_centroid.xy + m.area * point[i] * point[j];
    };
    return {plane,
            {product(0, 0), product(1, 1), product(2, 2), product(0, 1), product(0, 2), product(1, 2)}};
}

void declare_world_moments(DeclareFields<MomentsAbout>& d) {
    constexpr const char* names[] = {"xx", "yy", "zz", "xy", "xz", "yz"};
    for (std::size_t i = 0; i < 6; ++i)
        d.field(
            names[i], [i](const MomentsAbout& m) { return m.world[i]; },
            "The integral of this product of coordinates.");
}

void declare_moments_about(DeclareFields<MomentsAbout>& d) {
    d.field(
        "x", [](const MomentsAbout& m) { return m.plane.x; }, "The integral of v squared.");
    d.field(
        "y", [](const MomentsAbout& m) { return m.plane.y; }, "The integral of u squared.");
    d.field(
        "xy", [](const MomentsAbout& m) { return m.plane.xy; }, "The integral of u times v.");
    const auto self = [](const MomentsAbout& m) -> const MomentsAbout& { return m; };
    d.object("world", self, "The moments in world space.", declare_world_moments);
}

void declare_second_moments(DeclareFields<SectionMoments>& d) {
    const auto origin = [](const SectionMoments& s) {
        return moments_about(s, s.moments->about_origin, s.centroid());
    };
    d.object("about_origin", origin, "Moments about the origin of the plane and of world space.",
             declare_moments_about);
    const auto centroid = [](const SectionMoments& s) {
        return moments_about(s, s.moments->about_centroid, {});
    };
    d.object("about_centroid", centroid, "Moments about the centroid.", declare_moments_about);
}

void declare_centroid(DeclareFields<SectionMoments>& d) {
    d.field(
        "plane", [](const SectionMoments& s) { return flat(s.moments->centroid); },
        "The centroid in the plane.");
    d.field("world", &SectionMoments::centroid, "The centroid in world space.");
}

void declare_flat_axes(DeclareFields<SectionMoments>& d) {
    d.field(
        "largest", [](const SectionMoments& s) { return flat(s.moments->axes.major); },
        "The axis of the largest moment.");
    d.field(
        "smallest", [](const SectionMoments& s) { return flat(s.moments->axes.minor); },
        "The axis of the smallest moment.");
}

void declare_world_axes(DeclareFields<SectionMoments>& d) {
    d.field(
        "largest", [](const SectionMoments& s) { return s.section->frame.direction(s.moments->axes.major); },
        "The axis of the largest moment.");
    d.field(
        "smallest", [](const SectionMoments& s) { return s.section->frame.direction(s.moments->axes.minor); },
        "The axis of the smallest moment.");
}

void declare_principal_axes(DeclareFields<SectionMoments>& d) {
    d.field(
        "largest", [](const SectionMoments& s) { return s.moments->axes.largest; }, "The largest moment.");
    d.field(
        "smallest", [](const SectionMoments& s) { return s.moments->axes.smallest; }, "The smallest moment.");
    const auto self = [](const SectionMoments& s) -> const SectionMoments& { return s; };
    d.object("plane", self, "The axes in the plane.", declare_flat_axes);
    d.object("world", self, "The axes in world space.", declare_world_axes);
}

/// Declares the fields that sections and contours with moments share.
template <class R, class Get>
void declare_moments(DeclareFields<R>& d, Get moments) {
    constexpr const char* has = "there is a centroid";
    d.object("second_moments", moments, "Second moments of area.", declare_second_moments).only_when(has);
    d.object("principal_axes", moments, "Principal moments and axes, about the centroid.",
             declare_principal_axes)
        .only_when(has);
}

void declare_contour(DeclareFields<SectionContour>& d) {
    constexpr const char* closed = "the contour is closed";
    const auto of_closed = [](auto&& get) {
        return [get](const SectionContour& c) {
            return c.closed() ? std::optional(get(*c.contour)) : std::nullopt;
        };
    };
    const auto role = [](const SectionContour& c) { return c.contour->role; };
    d.choice("role", role,
             {{to_string(ContourRole::outline), ContourRole::outline, "the solid is inside only"},
              {to_string(ContourRole::hole), ContourRole::hole, "the solid is outside only"},
              {to_string(ContourRole::inner), ContourRole::inner, "the solid is on both sides"},
              {to_string(ContourRole::open), ContourRole::open, "not closed: the mesh has a boundary there"}},
             "The role in the section.");
    const auto parent = [](const SectionContour& c) {
        return c.contour->parent == none ? std::optional<Index>() : c.contour->parent;
    };
    d.field("parent", parent, "The number of the innermost contour around it.").only_when("there is one");
    d.field(
        "points", [](const SectionContour& c) { return c.contour->end - c.contour->begin; },
        "The number of points.");
    d.field(
         "length", [](const SectionContour& c) { return c.contour->length; }, "The length of the contour.")
        .unit("scene units");
    d.choice("orientation", of_closed([](const Contour& c) { return c.orientation > 0 ? 1 : -1; }),
             {{"anticlockwise", 1, "as seen with the normal towards the viewer"},
              {"clockwise", -1, "as seen with the normal towards the viewer"}},
             "The orientation of the contour.")
        .only_when(closed);
    std::vector<NamedChoice<polygon::Kind>> kinds;
    for (int k = 0; k < polygon::kinds; ++k) {
        const auto kind = static_cast<polygon::Kind>(k);
        kinds.push_back({polygon::to_string(kind), kind, ""});
    }
    d.choice("kind", of_closed([](const Contour& c) { return c.kind; }), kinds, "The type of polygon.")
        .only_when(closed);
    d.field("area", of_closed([](const Contour& c) { return c.area; }),
            "The area. Negative if the contour is clockwise.")
        .unit("square scene units")
        .only_when(closed);
    const auto centroid = [](const SectionContour& c) {
        return c.closed() ? std::optional(c.moments()) : std::nullopt;
    };
    d.object("centroid", centroid, "The centroid of the contour.", declare_centroid)
        .only_when(closed)
        .null_when("the contour covers no area");
    declare_moments(d, &SectionContour::moments);
}

std::vector<SectionContour> contours_of(const Section& section) {
    std::vector<SectionContour> all;
    for (const Contour& contour : section.contours) all.push_back({&section, &contour});
    return all;
}

std::optional<SectionMoments> moments_of(const Section& section) {
    if (!section.moments) return {};
    return SectionMoments{&section, &*section.moments};
}

} // namespace

void declare_frame_fields(DeclareFields<SectionFrame>& d) {
    d.field("origin", &SectionFrame::origin, "The origin (u = v = 0), in world space.");
    d.field("u", &SectionFrame::u, "The direction of the first coordinate.");
    d.field("v", &SectionFrame::v, "The direction of the second coordinate.");
    d.field("normal", &SectionFrame::normal, "The direction perpendicular to both.");
}

void declare_section_fields(DeclareFields<Section>& d) {
    d.field("area", &Section::area, "The area of the section, with holes subtracted.")
        .unit("square scene units");
    d.object("centroid", moments_of, "The centroid of the section.", declare_centroid)
        .null_when("a contour is open, or overlaps itself or another");
    declare_moments(d, moments_of);
    d.list("contours", contours_of, "The contours of the section.", declare_contour);
}

} // namespace facetmill::io
