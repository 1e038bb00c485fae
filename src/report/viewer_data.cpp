#include "report/viewer_data.hpp"

#include "base/math/whole_number.hpp"
#include "io/images/png.hpp"
#include "io/packing.hpp"

#include <algorithm>
#include <numeric>

namespace facetmill::report {

namespace {

/// The position of x in [low, low + size], as an integer from 0 to most.
std::uint32_t quantised(double x, double low, double size, std::uint32_t most) {
    if (!(size > 0)) return 0;
    const double part = std::clamp((x - low) / size, 0.0, 1.0);
    return whole_number<std::uint32_t>(std::floor(part * most + 0.5));
}

/// Splits numbers into planes of bytes: the lowest bytes of all numbers, then the next.
class Planes {
  public:
    void numbers(const std::vector<std::uint32_t>& values, int width) {
        std::size_t at = bytes_.size();
        bytes_.resize(at + values.size() * static_cast<std::size_t>(width));
        for (int w = 0; w < width; ++w)
            for (const std::uint32_t value : values)
                bytes_[at++] = static_cast<std::byte>(value >> (8 * w) & 255);
    }
    /// Stores each number as the difference from the previous one, modulo its width, with the sign in the
    /// last bit.
    void differences(std::vector<std::uint32_t> values, int width) {
        const std::uint32_t mask = (1U << (8 * width)) - 1;
        std::uint32_t before = 0;
        for (std::uint32_t& value : values) {
            const std::uint32_t d = (value - std::exchange(before, value)) & mask;
            value = d <= mask / 2 ? 2 * d : 2 * (mask + 1 - d) - 1;
        }
        numbers(values, width);
    }
    std::string packed() const { return io::base64(io::packed(bytes_, io::Packing::gzip)); }

  private:
    io::Bytes bytes_;
};

/// The coordinates of a direction on an octahedron's net, two bytes (Q. Meyer et al., "On Floating-Point
/// Normal Vectors", 2010).
std::array<std::uint32_t, 2> folded(const Vec3& n) {
    const double sum = std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
    if (!(sum > 0)) return {255, 255}; // any direction works for viewer.js
    double x = n.x / sum, y = n.y / sum;
    if (n.z < 0) {
        const double over = (1 - std::abs(y)) * (x >= 0 ? 1 : -1);
        y = (1 - std::abs(x)) * (y >= 0 ? 1 : -1);
        x = over;
    }
    return {quantised(x, -1, 2, 255), quantised(y, -1, 2, 255)};
}

/// The faces sorted by primitive, and the wedges in order of first use.
struct Order {
    std::vector<Index> faces, wedges;
    std::size_t loose = 0;            ///< the first wedge without a face
    std::vector<std::uint32_t> codes; ///< [corners] number of wedges so far minus the wedge's number
};

Order order_of(const Preview& preview) {
    const Mesh& mesh = preview.mesh;
    Order out;
    out.faces.resize(mesh.face_count());
    std::iota(out.faces.begin(), out.faces.end(), Index{0});
    if (mesh.primitives.size() > 1)
        std::stable_sort(out.faces.begin(), out.faces.end(),
                         [&](Index a, Index b) { return mesh.primitive_of(a) < mesh.primitive_of(b); });
    std::vector<Index> number(mesh.wedge_count(), none);
    for (const Index f : out.faces)
        for (const Index w : mesh.face_wedges(f)) {
            const auto met = static_cast<Index>(out.wedges.size());
            out.codes.push_back(number[w] == none ? 0 : met - number[w]);
            if (number[w] != none) continue;
            number[w] = met;
            out.wedges.push_back(w);
        }
    out.loose = out.wedges.size();
    for (auto w = static_cast<Index>(preview.first_loose); w < mesh.wedge_count(); ++w)
        out.wedges.push_back(w);
    return out;
}

std::vector<PackedGroup> groups_of(const Preview& preview, const Order& order) {
    if (preview.paints.size() == 1 && !order.faces.empty())
        return {{preview.paints.front(), order.faces.size()}};
    std::vector<PackedGroup> groups;
    for (std::size_t i = 0, begin = 0; i < order.faces.size(); ++i) {
        const Index primitive = preview.mesh.primitive_of(order.faces[i]);
        const bool last =
            i + 1 == order.faces.size() || preview.mesh.primitive_of(order.faces[i + 1]) != primitive;
        if (!last) continue;
        groups.push_back({preview.paints[primitive], i + 1 - begin});
        begin = i + 1;
    }
    return groups;
}

/// Stores a number per wedge, in order.
template <class Of>
std::vector<std::uint32_t> column(const Order& order, Of&& of) {
    std::vector<std::uint32_t> out(order.wedges.size());
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = of(order.wedges[i]);
    return out;
}

void put_places(const Mesh& mesh, const Order& order, Planes& planes, Json& json) {
    const Box box = box_of(mesh.positions);
    const Vec3 size = box.extent();
    for (std::size_t c = 0; c < 3; ++c)
        planes.differences(column(order,
                                  [&](Index w) {
                                      return quantised(mesh.positions[mesh.vertex_of_wedge(w)][c], box.min[c],
                                                       size[c], 65535);
                                  }),
                           2);
    json["origin"] = {box.min.x, box.min.y, box.min.z};
    json["size"] = {size.x, size.y, size.z};
}

void put_normals(const Attribute& normals, const Order& order, Planes& planes) {
    for (std::size_t c = 0; c < 2; ++c)
        planes.differences(
            column(order,
                   [&](Index w) {
                       return folded({normals.value(w, 0), normals.value(w, 1), normals.value(w, 2)})[c];
                   }),
            1);
}

void put_coordinates(const Attribute& uv, const Order& order, Planes& planes, Json& json) {
    double low[2] = {HUGE_VAL, HUGE_VAL}, high[2] = {-HUGE_VAL, -HUGE_VAL};
    for (const Index w : order.wedges)
        for (int c = 0; c < 2; ++c) {
            low[c] = std::min(low[c], uv.value(w, c));
            high[c] = std::max(high[c], uv.value(w, c));
        }
    for (int c = 0; c < 2; ++c)
        planes.differences(
            column(order,
                   [&](Index w) { return quantised(uv.value(w, c), low[c], high[c] - low[c], 65535); }),
            2);
    json["uv"] = {low[0], low[1], high[0] - low[0], high[1] - low[1]};
}

} // namespace

PackedMesh packed(const Preview& preview, const std::vector<float>& distances, double most) {
    const Mesh& mesh = preview.mesh;
    const Order order = order_of(preview);
    Planes planes;
    PackedMesh out{{{"vertices", order.wedges.size()},
                    {"triangles", mesh.face_count()},
                    {"loose", order.loose},
                    {"dots", order.loose + preview.first_dot - preview.first_loose}},
                   {}};
    put_places(mesh, order, planes, out.json);
    const Attribute* normals = mesh.face_count() > 0 ? mesh.find("NORMAL", Domain::wedge) : nullptr;
    out.json["normals"] = normals != nullptr;
    if (normals) put_normals(*normals, order, planes);
    const Attribute* colours = mesh.find("COLOR_0", Domain::wedge);
    out.json["coloured"] = colours != nullptr;
    for (int c = 0; colours && c < 4; ++c)
        planes.differences(column(order,
                                  [&](Index w) {
                                      return quantised(std::sqrt(std::max(0.0, colours->value(w, c))), 0, 1,
                                                       255);
                                  }),
                           1);
    if (const Attribute* uv = mesh.find("TEXCOORD_0", Domain::wedge))
        put_coordinates(*uv, order, planes, out.json);
    if (!distances.empty())
        planes.differences(column(order,
                                  [&](Index w) {
                                      return quantised(distances[mesh.vertex_of_wedge(w)], -most, 2 * most,
                                                       65534);
                                  }),
                           2);
    planes.numbers(order.codes, 3);
    out.json["data"] = planes.packed();
    out.groups = groups_of(preview, order);
    return out;
}

} // namespace facetmill::report
