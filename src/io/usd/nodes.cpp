#include "io/usd/nodes.hpp"

#include <algorithm>
#include <numeric>

namespace facetmill::io::usd {

namespace {

std::vector<std::size_t> children_of(const Json& owner, const char* key, std::size_t nodes) {
    std::vector<std::size_t> all;
    const auto at = owner.find(key);
    if (at == owner.end() || !at->is_array()) return all;
    for (const Json& child : *at)
        if (child.is_number_unsigned() && child.get<std::size_t>() < nodes)
            all.push_back(child.get<std::size_t>());
    return all;
}

std::string text_at(const Json& owner, const char* key) {
    const auto at = owner.find(key);
    return at != owner.end() && at->is_string() ? at->get<std::string>() : std::string();
}

bool is_hidden(const Json& node) {
    const Json::json_pointer visible("/extensions/KHR_node_visibility/visible");
    return node.contains(visible) && node[visible] == false;
}

/// The numbers as "(a, b, c)" with all digits.
std::string tuple_of(const Json& numbers, std::size_t begin, std::size_t end) {
    std::string text = "(";
    for (std::size_t k = begin; k < end; ++k) {
        if (k > begin) text += ", ";
        put_number(text, numbers[k].get<double>());
    }
    return text + ")";
}

void put_vector(std::string& out, const Attribute& a, std::size_t i) {
    out += tuple<3>({a.value(i, 0), a.value(i, 1), a.value(i, 2)});
}

/// USD counts t from the bottom of the image, glTF from its top.
void put_coordinates(std::string& out, const Attribute& uvs, std::size_t i) {
    out += '(';
    put_number(out, static_cast<float>(uvs.value(i, 0)));
    out += ", ";
    put_number(out, 1 - static_cast<float>(uvs.value(i, 1)));
    out += ')';
}

void put_colour(std::string& out, const Attribute& colours, std::size_t i,
                const std::array<double, 4>& factor) {
    out += tuple<3>(
        {colours.value(i, 0) * factor[0], colours.value(i, 1) * factor[1], colours.value(i, 2) * factor[2]});
}

bool is_all_one(const Attribute& a, int begin, int end) {
    for (std::size_t i = 0; i < a.size(); ++i)
        for (int c = begin; c < end; ++c)
            if (a.value(i, c) != 1) return false;
    return true;
}

bool is_of_triangles(const Json& primitive) {
    constexpr int triangles = 4;
    const auto mode = primitive.find("mode");
    return (mode == primitive.end() || *mode == triangles) && primitive.contains("attributes") &&
           primitive["attributes"].contains("POSITION");
}

/// The number of a texture coordinate set, TEXCOORD_2.
std::optional<std::string> variable_of(const std::string& name) {
    constexpr std::string_view begin = "TEXCOORD_";
    if (!name.starts_with(begin)) return {};
    const std::string set = name.substr(begin.size());
    return set == "0" ? "st" : "st" + set;
}

} // namespace

Nodes::Nodes(gltf::Source& source, Materials& materials, std::string root)
    : source_(source), json_(source.json()), materials_(materials), root_(std::move(root)),
      uses_(gltf::count_of(json_, "meshes")), shared_names_(uses_.size()) {
    for (const char* name : {"Materials", "Meshes"}) layer_.take(name);
}

std::vector<Nodes::Root> Nodes::roots() const {
    const std::size_t nodes = gltf::count_of(json_, "nodes"), scenes = gltf::count_of(json_, "scenes");
    std::vector<bool> below(nodes);
    std::vector<Root> all;
    if (scenes > 0) {
        const std::size_t shown = gltf::index_at(json_, "scene", scenes).value_or(0);
        for (const std::size_t root : children_of(json_["scenes"][shown], "nodes", nodes)) {
            all.push_back({root, true});
            below[root] = true;
        }
    }
    for (std::size_t n = 0; n < nodes; ++n)
        for (const std::size_t child : children_of(json_["nodes"][n], "children", nodes)) below[child] = true;
    for (std::size_t n = 0; n < nodes; ++n)
        if (!below[n]) all.push_back({n, false});
    return all;
}

void Nodes::write() {
    const std::size_t nodes = gltf::count_of(json_, "nodes");
    if (nodes == 0) { // meshes of a document without nodes are at the origin
        for (std::size_t mesh = 0; mesh < uses_.size(); ++mesh) put_mesh(mesh);
        return;
    }
    write_nodes(nodes);
}

void Nodes::write_nodes(std::size_t nodes) {
    for (std::size_t n = 0; n < nodes; ++n)
        if (const auto mesh = gltf::index_at(json_["nodes"][n], "mesh", uses_.size())) ++uses_[*mesh];
    struct Step {
        std::size_t node;
        bool ends; ///< its children are written
        bool shown;
    };
    std::vector<Step> steps; // no recursion, because files may nest nodes deeply
    const std::vector<Root> top = roots();
    for (auto at = top.rbegin(); at != top.rend(); ++at) steps.push_back({at->node, false, at->shown});
    while (!steps.empty()) {
        const auto [index, ends, shown] = steps.back();
        steps.pop_back();
        if (ends) {
            layer_.close();
            continue;
        }
        const Json& node = json_["nodes"][index];
        open_node(node, index, shown);
        steps.push_back({index, true, shown});
        const std::vector<std::size_t> children = children_of(node, "children", nodes);
        for (auto at = children.rbegin(); at != children.rend(); ++at) steps.push_back({*at, false, true});
    }
}

void Nodes::open_node(const Json& node, std::size_t index, bool shown) {
    layer_.open("def Xform", text_at(node, "name"), fmt::format("node_{}", index));
    if (!shown || is_hidden(node)) layer_.line("token visibility = \"invisible\"");
    put_transform(node);
    if (const auto mesh = gltf::index_at(node, "mesh", uses_.size())) put_mesh(*mesh);
}

void Nodes::put_transform(const Json& node) {
    constexpr std::size_t row = 4, all = 16;
    if (node.contains("matrix")) {
        const Json& m = node["matrix"]; // columns of glTF are the rows of USD
        std::string text;
        for (std::size_t k = 0; k < all; k += row) text += (k > 0 ? ", " : "") + tuple_of(m, k, k + row);
        layer_.line("matrix4d xformOp:transform = ( " + text + " )");
        layer_.line("uniform token[] xformOpOrder = [\"xformOp:transform\"]");
        return;
    }
    std::vector<std::string> order;
    const auto add = [&](const char* type, const char* name, const std::string& value) {
        layer_.line(fmt::format("{} {} = {}", type, name, value));
        order.push_back(fmt::format("\"{}\"", name));
    };
    if (node.contains("translation"))
        add("double3", "xformOp:translate", tuple_of(node["translation"], 0, 3));
    if (node.contains("rotation")) { // the real part comes first
        const Json& q = node["rotation"];
        add("quatd", "xformOp:orient", tuple_of(Json::array({q[3], q[0], q[1], q[2]}), 0, 4));
    }
    if (node.contains("scale")) add("double3", "xformOp:scale", tuple_of(node["scale"], 0, 3));
    if (!order.empty())
        layer_.line(fmt::format("uniform token[] xformOpOrder = [{}]", fmt::join(order, ", ")));
}

void Nodes::put_mesh(std::size_t mesh) {
    if (uses_[mesh] < 2) {
        put_primitives(layer_, mesh);
        return;
    }
    const std::string name = text_at(json_["meshes"][mesh], "name");
    if (shared_names_[mesh].empty()) {
        shared_names_[mesh] = shared_.open("def Xform", name, fmt::format("mesh_{}", mesh));
        put_primitives(shared_, mesh);
        shared_.close();
    }
    layer_.open("def Xform", name, fmt::format("mesh_{}", mesh),
                {"instanceable = true",
                 fmt::format("prepend references = <{}/Meshes/{}>", root_, shared_names_[mesh])});
    layer_.close();
}

void Nodes::put_primitives(Layer& layer, std::size_t mesh) {
    const Json& item = json_["meshes"][mesh];
    std::string name = text_at(item, "name");
    if (name.empty()) name = fmt::format("mesh_{}", mesh);
    for (const Json& primitive : item["primitives"])
        if (is_of_triangles(primitive)) put_primitive(layer, name, primitive);
}

void Nodes::put_primitive(Layer& layer, const std::string& name, const Json& primitive) {
    const Json& attributes = primitive["attributes"];
    const Attribute positions = gltf::decode_numbers(source_, attributes["POSITION"].get<std::size_t>());
    const std::size_t count = positions.size();
    const auto colours = numbers_of(attributes, "COLOR_0", count);
    VertexColours used;
    if (colours && colours->components >= 3) used.colour = !is_all_one(*colours, 0, 3);
    if (colours && colours->components == 4) used.alpha = !is_all_one(*colours, 3, 4);
    const auto material = gltf::index_at(primitive, "material", gltf::count_of(json_, "materials"));
    const MaterialUse* bound = material ? &materials_.use(*material, used) : nullptr;
    std::vector<std::string> metadata;
    if (bound) metadata.emplace_back("prepend apiSchemas = [\"MaterialBindingAPI\"]");
    layer.open("def Mesh", name, "mesh", metadata);
    if (bound && bound->double_sided) layer.line("uniform bool doubleSided = 1");
    put_faces(layer, primitive, positions);
    constexpr const char* by_vertex = " (interpolation = \"vertex\")";
    layer.array("point3f[] points", count,
                [&](std::size_t i, std::string& out) { put_vector(out, positions, i); });
    if (const auto normals = numbers_of(attributes, "NORMAL", count); normals && normals->components == 3)
        layer.array(
            "normal3f[] normals", count,
            [&](std::size_t i, std::string& out) { put_vector(out, *normals, i); }, by_vertex);
    for (const auto& [attribute, accessor] : attributes.items()) {
        const auto variable = variable_of(attribute);
        if (!variable) continue;
        const auto uvs = numbers_of(attributes, attribute.c_str(), count);
        if (!uvs || uvs->components != 2) continue;
        layer.array(
            "texCoord2f[] primvars:" + *variable, count,
            [&](std::size_t i, std::string& out) { put_coordinates(out, *uvs, i); }, by_vertex);
    }
    const std::array<double, 4> factor = bound ? bound->factor : std::array<double, 4>{1, 1, 1, 1};
    if (used.colour)
        layer.array(
            "color3f[] primvars:displayColor", count,
            [&](std::size_t i, std::string& out) { put_colour(out, *colours, i, factor); }, by_vertex);
    if (used.alpha)
        layer.array(
            "float[] primvars:displayOpacity", count,
            [&](std::size_t i, std::string& out) {
                put_number(out, static_cast<float>(colours->value(i, 3) * factor[3]));
            },
            by_vertex);
    if (bound) layer.line(fmt::format("rel material:binding = <{}>", bound->path));
    layer.line("uniform token subdivisionScheme = \"none\"");
    layer.close();
}

std::optional<Attribute> Nodes::numbers_of(const Json& attributes, const char* name, std::size_t count) {
    const auto accessor = gltf::index_at(attributes, name, gltf::count_of(json_, "accessors"));
    if (!accessor) return {};
    Attribute numbers = gltf::decode_numbers(source_, *accessor);
    if (numbers.size() != count) return {};
    return numbers;
}

void Nodes::put_faces(Layer& layer, const Json& primitive, const Attribute& positions) {
    std::vector<Index> corners;
    if (primitive.contains("indices")) {
        corners = gltf::decode_indices(source_, gltf::JsonCursor(primitive, "primitive").at("indices"),
                                       positions.size());
    } else {
        corners.resize(positions.size());
        std::iota(corners.begin(), corners.end(), Index{0});
    }
    corners.resize(corners.size() / 3 * 3);
    std::array<double, 3> low{}, high{};
    for (std::size_t i = 0; i < positions.size(); ++i)
        for (std::size_t c = 0; c < 3; ++c) {
            const double x = positions.value(i, static_cast<int>(c));
            low.at(c) = i == 0 ? x : std::min(low.at(c), x);
            high.at(c) = i == 0 ? x : std::max(high.at(c), x);
        }
    layer.line(fmt::format("float3[] extent = [{}, {}]", tuple(low), tuple(high)));
    layer.array("int[] faceVertexCounts", corners.size() / 3,
                [](std::size_t, std::string& out) { out += '3'; });
    layer.array("int[] faceVertexIndices", corners.size(), [&](std::size_t i, std::string& out) {
        put_number(out, static_cast<std::int64_t>(corners[i]));
    });
}

} // namespace facetmill::io::usd
