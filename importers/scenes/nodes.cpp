// Nodes, meshes and skins of assimp.

#include "convert.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <unordered_map>

namespace importers {

namespace {

using Ints = std::vector<unsigned>;

constexpr std::size_t influences = 4; ///< joints of a vertex

std::vector<float> column_major(const aiMatrix4x4& m, double scale) {
    std::vector<float> all;
    all.reserve(16);
    const auto s = static_cast<float>(scale);
    for (unsigned c = 0; c < 4; ++c)
        for (unsigned r = 0; r < 4; ++r) all.push_back(c == 3 && r < 3 ? m[r][c] * s : m[r][c]);
    return all;
}

/// Adds a matrix as translation, rotation and scale, which animations need, or as a matrix if it shears.
void add_transform(const aiMatrix4x4& m, double unit, Json& node) {
    if (m.IsIdentity()) return;
    const auto column = [&](unsigned c) { return aiVector3D(m[0][c], m[1][c], m[2][c]); };
    aiVector3D x = column(0), y = column(1), z = column(2);
    aiVector3D size(x.Length(), y.Length(), z.Length());
    constexpr float sheared = 1e-4F; // as a cosine: beyond the noise of floats
    const bool square =
        size.x > 0 && size.y > 0 && size.z > 0 && std::fabs((x * y) / (size.x * size.y)) < sheared &&
        std::fabs((y * z) / (size.y * size.z)) < sheared && std::fabs((z * x) / (size.z * size.x)) < sheared;
    const bool affine = m.d1 == 0 && m.d2 == 0 && m.d3 == 0 && m.d4 == 1;
    if (!square || !affine) {
        if (affine) node["matrix"] = column_major(m, unit);
        return;
    }
    if ((x ^ y) * z < 0) size.x = -size.x;
    x /= size.x;
    y /= size.y;
    z /= size.z;
    aiQuaternion turn(aiMatrix3x3(x.x, y.x, z.x, x.y, y.y, z.y, x.z, y.z, z.z));
    turn.Normalize();
    const auto s = static_cast<float>(unit);
    if (m.a4 != 0 || m.b4 != 0 || m.c4 != 0) node["translation"] = {m.a4 * s, m.b4 * s, m.c4 * s};
    if (turn.x != 0 || turn.y != 0 || turn.z != 0) node["rotation"] = {turn.x, turn.y, turn.z, turn.w};
    constexpr float noise = 1e-6F;
    if (std::fabs(size.x - 1) > noise || std::fabs(size.y - 1) > noise || std::fabs(size.z - 1) > noise)
        node["scale"] = {size.x, size.y, size.z};
}

aiMatrix4x4 world_of(const aiNode* node) {
    aiMatrix4x4 world;
    for (; node; node = node->mParent) world = node->mTransformation * world;
    return world;
}

/// The matrix from a mesh to a bone; where the reader of assimp lost it (COLLADA without bind_shape_matrix),
/// the one of the rest pose.
aiMatrix4x4 bind_of(const aiBone& bone, const aiNode& mesh, const aiScene& scene) {
    if (bone.mOffsetMatrix.Determinant() != 0) return bone.mOffsetMatrix;
    return world_of(scene.mRootNode->FindNode(bone.mName)).Inverse() * world_of(&mesh);
}

/// Properties that programs and people stored with a node.
Json extras_of(const aiMetadata* data) {
    Json extras = Json::object();
    for (unsigned i = 0; data && i < data->mNumProperties; ++i) {
        const std::string key = data->mKeys[i].C_Str();
        const aiMetadataEntry& entry = data->mValues[i];
        if (key == "IsNull" || key == "InheritType" || !entry.mData) continue;
        if (entry.mType == AI_AISTRING) extras[key] = static_cast<const aiString*>(entry.mData)->C_Str();
        if (entry.mType == AI_BOOL) extras[key] = *static_cast<const bool*>(entry.mData);
        if (entry.mType == AI_INT32) extras[key] = *static_cast<const std::int32_t*>(entry.mData);
        if (entry.mType == AI_UINT64) extras[key] = *static_cast<const std::uint64_t*>(entry.mData);
        if (entry.mType == AI_FLOAT) extras[key] = *static_cast<const float*>(entry.mData);
        if (entry.mType == AI_DOUBLE) extras[key] = *static_cast<const double*>(entry.mData);
    }
    return extras;
}

std::uint16_t linear_short(float srgb) {
    const double x = std::isfinite(srgb) ? std::clamp(static_cast<double>(srgb), 0.0, 1.0) : 0;
    const double linear = x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
    return static_cast<std::uint16_t>(std::lround(linear * 65535));
}

std::uint16_t as_short(float x) {
    return static_cast<std::uint16_t>(
        std::lround((std::isfinite(x) ? std::clamp(x, 0.0F, 1.0F) : 0) * 65535));
}

/// The numbers of a vertex of one mesh, column by column, so that equal vertices can be merged.
class Vertices {
  public:
    explicit Vertices(std::size_t count) : count_(count) {}

    void add(const char* name, std::size_t width, std::vector<float> values) {
        columns_.push_back({name, width, std::move(values), -1});
    }
    void add_target(int target, const char* name, std::vector<float> values) {
        columns_.push_back({name, 3, std::move(values), target});
    }

    /// [vertex of assimp] the vertex that is written. Vertices whose numbers are all equal are merged.
    Ints merged() {
        std::string keys;
        std::size_t bytes = 0;
        for (const Column& column : columns_) bytes += column.width * sizeof(float);
        keys.resize(bytes * count_);
        std::unordered_map<std::string_view, unsigned> first;
        first.reserve(count_);
        Ints map(count_);
        for (std::size_t v = 0; v < count_; ++v) {
            char* at = keys.data() + v * bytes;
            for (const Column& column : columns_) {
                std::memcpy(at, column.values.data() + v * column.width, column.width * sizeof(float));
                at += column.width * sizeof(float);
            }
            const auto [known, is_new] = first.try_emplace({keys.data() + v * bytes, bytes}, first.size());
            if (is_new) kept_.push_back(static_cast<unsigned>(v));
            map[v] = known->second;
        }
        return map;
    }

    void write(Glb& glb, Json& primitive, std::size_t targets) const {
        std::vector<Json> deltas(targets, Json::object());
        for (const Column& column : columns_) {
            std::vector<float> values;
            values.reserve(kept_.size() * column.width);
            for (const unsigned v : kept_)
                values.insert(values.end(),
                              column.values.begin() + static_cast<std::ptrdiff_t>(v * column.width),
                              column.values.begin() + static_cast<std::ptrdiff_t>((v + 1) * column.width));
            Json& to =
                column.target < 0 ? primitive["attributes"] : deltas[static_cast<std::size_t>(column.target)];
            to[column.name] = accessor(glb, column, values);
        }
        if (targets > 0) primitive["targets"] = deltas;
    }

  private:
    struct Column {
        std::string name;
        std::size_t width;
        std::vector<float> values;
        int target;
    };

    static int accessor(Glb& glb, const Column& column, const std::vector<float>& values) {
        const char* type = column.width == 2 ? "VEC2" : column.width == 3 ? "VEC3" : "VEC4";
        const bool joints = column.name.starts_with("JOINTS"), colours = column.name.starts_with("COLOR");
        if (!joints && !colours) return glb.floats(values, type, vertex_target, column.name == "POSITION");
        std::vector<std::uint16_t> shorts;
        shorts.reserve(values.size());
        for (std::size_t i = 0; i < values.size(); ++i)
            shorts.push_back(joints       ? static_cast<std::uint16_t>(values[i])
                             : i % 4 == 3 ? as_short(values[i])
                                          : linear_short(values[i]));
        return glb.shorts(shorts, type, colours);
    }

    std::size_t count_;
    std::vector<Column> columns_;
    Ints kept_;
};

std::vector<float> vectors(const aiVector3D* from, unsigned count, float scale) {
    std::vector<float> all;
    all.reserve(std::size_t{count} * 3);
    for (unsigned i = 0; i < count; ++i)
        for (const float x : {from[i].x, from[i].y, from[i].z}) all.push_back(x * scale + 0.0F); // no -0
    return all;
}

/// Unit normals; empty if one has no direction.
std::vector<float> normals(const aiMesh& mesh) {
    std::vector<float> all = vectors(mesh.mNormals, mesh.mNumVertices, 1);
    for (std::size_t i = 0; i < all.size(); i += 3) {
        const float size = std::sqrt(all[i] * all[i] + all[i + 1] * all[i + 1] + all[i + 2] * all[i + 2]);
        if (!(size > 0) || !std::isfinite(size)) return {};
        for (std::size_t k = 0; k < 3; ++k) all[i + k] /= size;
    }
    return all;
}

class Nodes {
  public:
    Nodes(const aiScene& scene, const Convention& convention, Glb& glb, Notes& notes)
        : scene_(scene), convention_(convention), glb_(glb), notes_(notes) {}

    void add();

  private:
    int reserve(const aiNode& node);
    void fill(const aiNode& node);
    void fill_meshes(const aiNode& node, Json& to);
    int mesh(const aiNode& node, const Ints& parts);
    int skin(const aiNode& node, const Ints& parts);
    void write_mesh(const Ints& parts, const std::map<std::string, int>& joints, Json& to);
    Json primitive(const aiMesh& mesh, const std::map<std::string, int>& joints);
    void add_joints(const aiMesh& mesh, const std::map<std::string, int>& joints, Vertices& to);
    static void add_targets(const aiMesh& mesh, float scale, Vertices& to);
    [[nodiscard]] bool is_plain_root(const aiNode& root) const;

    const aiScene& scene_;
    const Convention& convention_;
    Glb& glb_;
    Notes& notes_;
    std::map<const aiNode*, int> index_;
    AnimatedNodes animated_;
    std::map<Ints, int> meshes_; ///< the mesh of these parts, if they have no bones
};

int Nodes::reserve(const aiNode& node) {
    const int index = glb_.add("nodes", Json::object());
    index_[&node] = index;
    animated_.by_name.try_emplace(node.mName.C_Str(), index);
    for (unsigned i = 0; i < node.mNumChildren; ++i) (void)reserve(*node.mChildren[i]);
    return index;
}

void Nodes::add_joints(const aiMesh& mesh, const std::map<std::string, int>& joints, Vertices& to) {
    struct Influence {
        float weight, joint;
    };
    std::vector<std::vector<Influence>> all(mesh.mNumVertices);
    for (unsigned b = 0; b < mesh.mNumBones; ++b) {
        const aiBone& bone = *mesh.mBones[b];
        const auto joint = joints.find(bone.mName.C_Str());
        if (joint == joints.end()) continue;
        for (unsigned w = 0; w < bone.mNumWeights; ++w) {
            const aiVertexWeight& weight = bone.mWeights[w];
            if (weight.mVertexId < mesh.mNumVertices && weight.mWeight > 0 && std::isfinite(weight.mWeight))
                all[weight.mVertexId].push_back({weight.mWeight, static_cast<float>(joint->second)});
        }
    }
    std::vector<float> numbers(all.size() * influences), weights(all.size() * influences);
    const auto fixed = static_cast<float>(joints.at("")); // vertices without bones follow the mesh's node
    for (std::size_t v = 0; v < all.size(); ++v) {
        auto& own = all[v];
        std::stable_sort(own.begin(), own.end(),
                         [](const Influence& a, const Influence& b) { return a.weight > b.weight; });
        if (own.size() > influences) {
            notes_.warn("vertices keep the 4 strongest of their joints");
            own.resize(influences);
        }
        if (own.empty()) own.push_back({1, fixed});
        float sum = 0;
        for (const Influence& one : own) sum += one.weight;
        for (std::size_t i = 0; i < own.size(); ++i) {
            numbers[v * influences + i] = own[i].joint;
            weights[v * influences + i] = own[i].weight / sum;
        }
    }
    to.add("JOINTS_0", influences, std::move(numbers));
    to.add("WEIGHTS_0", influences, std::move(weights));
}

void Nodes::add_targets(const aiMesh& mesh, float scale, Vertices& to) {
    for (unsigned t = 0; t < mesh.mNumAnimMeshes; ++t) {
        const aiAnimMesh& target = *mesh.mAnimMeshes[t];
        if (!target.HasPositions() || target.mNumVertices != mesh.mNumVertices) {
            to.add_target(static_cast<int>(t), "POSITION",
                          std::vector<float>(std::size_t{mesh.mNumVertices} * 3));
            continue;
        }
        std::vector<float> deltas = vectors(target.mVertices, mesh.mNumVertices, scale);
        const std::vector<float> base = vectors(mesh.mVertices, mesh.mNumVertices, scale);
        for (std::size_t i = 0; i < deltas.size(); ++i) deltas[i] -= base[i];
        to.add_target(static_cast<int>(t), "POSITION", std::move(deltas));
    }
}

Json Nodes::primitive(const aiMesh& mesh, const std::map<std::string, int>& joints) {
    const auto scale = static_cast<float>(convention_.scale);
    Vertices vertices(mesh.mNumVertices);
    vertices.add("POSITION", 3, vectors(mesh.mVertices, mesh.mNumVertices, scale));
    if (mesh.HasNormals())
        if (auto all = normals(mesh); !all.empty()) vertices.add("NORMAL", 3, std::move(all));
    unsigned set = 0;
    for (unsigned t = 0; t < AI_MAX_NUMBER_OF_TEXTURECOORDS; ++t) {
        if (!mesh.HasTextureCoords(t)) continue;
        std::vector<float> uv;
        uv.reserve(std::size_t{mesh.mNumVertices} * 2);
        for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
            uv.push_back(mesh.mTextureCoords[t][v].x);
            uv.push_back(1 - mesh.mTextureCoords[t][v].y);
        }
        vertices.add(("TEXCOORD_" + std::to_string(set++)).c_str(), 2, std::move(uv));
    }
    set = 0;
    for (unsigned c = 0; c < AI_MAX_NUMBER_OF_COLOR_SETS; ++c) {
        if (!mesh.HasVertexColors(c)) continue;
        std::vector<float> colours;
        colours.reserve(std::size_t{mesh.mNumVertices} * 4);
        for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
            const aiColor4D& k = mesh.mColors[c][v];
            colours.insert(colours.end(), {k.r, k.g, k.b, k.a});
        }
        vertices.add(("COLOR_" + std::to_string(set++)).c_str(), 4, std::move(colours));
    }
    if (!joints.empty()) add_joints(mesh, joints, vertices);
    add_targets(mesh, scale, vertices);
    const Ints map = vertices.merged();
    std::vector<std::uint32_t> corners;
    for (unsigned f = 0; f < mesh.mNumFaces; ++f)
        for (unsigned i = 0; i < mesh.mFaces[f].mNumIndices; ++i)
            if (mesh.mFaces[f].mIndices[i] < map.size()) corners.push_back(map[mesh.mFaces[f].mIndices[i]]);
    Json to = {{"attributes", Json::object()}};
    vertices.write(glb_, to, mesh.mNumAnimMeshes);
    const std::size_t size = mesh.mPrimitiveTypes == aiPrimitiveType_POINT  ? 1
                             : mesh.mPrimitiveTypes == aiPrimitiveType_LINE ? 2
                                                                            : 3;
    corners.resize(corners.size() / size * size);
    to["indices"] = glb_.indices(corners);
    if (size == 1) to["mode"] = 0;
    if (size == 2) to["mode"] = 1;
    if (mesh.mMaterialIndex < scene_.mNumMaterials) to["material"] = mesh.mMaterialIndex;
    return to;
}

void Nodes::write_mesh(const Ints& parts, const std::map<std::string, int>& joints, Json& to) {
    to["primitives"] = Json::array();
    for (const unsigned part : parts) to["primitives"].push_back(primitive(*scene_.mMeshes[part], joints));
    const aiMesh& first = *scene_.mMeshes[parts.front()];
    if (first.mNumAnimMeshes == 0) return;
    Json names = Json::array(), weights = Json::array();
    for (unsigned t = 0; t < first.mNumAnimMeshes; ++t) {
        names.push_back(first.mAnimMeshes[t]->mName.C_Str());
        weights.push_back(first.mAnimMeshes[t]->mWeight);
    }
    to["extras"]["targetNames"] = names;
    to["weights"] = weights;
}

/// The skin of a node's parts; -1 if they have no bones. Joint "" is the node itself.
int Nodes::skin(const aiNode& node, const Ints& parts) {
    std::map<std::string, int> joints;
    std::vector<float> matrices;
    Json list = Json::array();
    const auto add = [&](const std::string& name, int at, const aiMatrix4x4& inverse) {
        if (!joints.try_emplace(name, static_cast<int>(list.size())).second) return;
        list.push_back(at);
        const std::vector<float> numbers = column_major(inverse, convention_.scale);
        matrices.insert(matrices.end(), numbers.begin(), numbers.end());
    };
    for (const unsigned part : parts) {
        const aiMesh& mesh = *scene_.mMeshes[part];
        for (unsigned b = 0; b < mesh.mNumBones; ++b) {
            const std::string name = mesh.mBones[b]->mName.C_Str();
            const auto at = animated_.by_name.find(name);
            if (at == animated_.by_name.end() || name.empty())
                notes_.warn("a bone without a node is dropped");
            else
                add(name, at->second, bind_of(*mesh.mBones[b], node, scene_));
        }
    }
    if (list.empty()) return -1;
    add("", index_.at(&node), aiMatrix4x4());
    Json mesh = Json::object();
    write_mesh(parts, joints, mesh);
    Json skin = {{"joints", list}, {"inverseBindMatrices", glb_.floats(matrices, "MAT4")}};
    const int index = glb_.add("skins", std::move(skin)), shape = glb_.add("meshes", std::move(mesh));
    Json& to = glb_.json["nodes"][static_cast<std::size_t>(index_.at(&node))];
    to["mesh"] = shape;
    to["skin"] = index;
    return index;
}

int Nodes::mesh(const aiNode& node, const Ints& parts) {
    const auto [at, is_new] = meshes_.try_emplace(parts, -1);
    if (!is_new) return at->second;
    Json mesh = Json::object();
    const char* name = scene_.mMeshes[parts.front()]->mName.C_Str();
    mesh["name"] = *name ? name : node.mName.C_Str();
    write_mesh(parts, {}, mesh);
    return at->second = glb_.add("meshes", std::move(mesh));
}

/// Parts with the same number of morph targets are primitives of one mesh, because glTF requires it.
void Nodes::fill_meshes(const aiNode& node, Json& to) {
    std::map<unsigned, Ints> groups;
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
        if (node.mMeshes[i] >= scene_.mNumMeshes) continue;
        const aiMesh& mesh = *scene_.mMeshes[node.mMeshes[i]];
        if (mesh.mNumVertices > 0 && mesh.mNumFaces > 0)
            groups[mesh.mNumAnimMeshes].push_back(node.mMeshes[i]);
    }
    const int own = index_.at(&node);
    for (const auto& [targets, parts] : groups) {
        Json holder = Json::object();
        const bool first = parts == groups.begin()->second;
        int at = own;
        const bool has_bones = std::any_of(
            parts.begin(), parts.end(), [&](unsigned part) { return scene_.mMeshes[part]->mNumBones > 0; });
        if (first && has_bones && skin(node, parts) >= 0) {
            // the skin has set the mesh
        } else if (first) {
            const int index = mesh(node, parts);
            glb_.json["nodes"][static_cast<std::size_t>(own)]["mesh"] = index;
        } else {
            if (has_bones) notes_.warn("some parts of a mesh lose their skin");
            at = glb_.add("nodes", {{"name", node.mName.C_Str()}, {"mesh", mesh(node, parts)}});
            to.push_back(at);
        }
        if (targets > 0) {
            animated_.with_targets.try_emplace(node.mName.C_Str(), at, targets);
            for (const unsigned part : parts)
                animated_.with_targets.try_emplace(scene_.mMeshes[part]->mName.C_Str(), at, targets);
        }
    }
}

void Nodes::fill(const aiNode& node) {
    const auto index = static_cast<std::size_t>(index_.at(&node));
    Json children = Json::array();
    for (unsigned i = 0; i < node.mNumChildren; ++i) children.push_back(index_.at(node.mChildren[i]));
    fill_meshes(node, children);
    {
        Json& to = glb_.json["nodes"][index];
        to["name"] = node.mName.C_Str();
        add_transform(node.mTransformation, convention_.scale, to);
        if (!children.empty()) to["children"] = children;
        if (Json extras = extras_of(node.mMetaData); !extras.empty()) to["extras"] = std::move(extras);
    }
    for (unsigned i = 0; i < node.mNumChildren; ++i) fill(*node.mChildren[i]);
}

/// A root that only holds its children: importers add it.
bool Nodes::is_plain_root(const aiNode& root) const {
    if (!root.mTransformation.IsIdentity() || root.mNumMeshes > 0 || root.mNumChildren == 0) return false;
    for (unsigned a = 0; a < scene_.mNumAnimations; ++a)
        for (unsigned c = 0; c < scene_.mAnimations[a]->mNumChannels; ++c)
            if (scene_.mAnimations[a]->mChannels[c]->mNodeName == root.mName) return false;
    for (unsigned m = 0; m < scene_.mNumMeshes; ++m)
        for (unsigned b = 0; b < scene_.mMeshes[m]->mNumBones; ++b)
            if (scene_.mMeshes[m]->mBones[b]->mName == root.mName) return false;
    return true;
}

void Nodes::add() {
    const aiNode& root = *scene_.mRootNode;
    const bool plain = is_plain_root(root);
    Json roots = Json::array();
    if (plain) {
        for (unsigned i = 0; i < root.mNumChildren; ++i) roots.push_back(reserve(*root.mChildren[i]));
        for (unsigned i = 0; i < root.mNumChildren; ++i) fill(*root.mChildren[i]);
    } else {
        roots.push_back(reserve(root));
        fill(root);
    }
    if (!convention_.rotation.IsIdentity()) {
        Json turned = {{"name", "y_up"}, {"children", roots}};
        add_transform(convention_.rotation, 1, turned);
        roots = {glb_.add("nodes", std::move(turned))};
    }
    glb_.json["scenes"][0]["nodes"] = roots;
    add_animations(scene_, animated_, convention_.scale, glb_, notes_);
}

} // namespace

void add_nodes(const aiScene& scene, const Convention& convention, Glb& glb, Notes& notes) {
    Nodes(scene, convention, glb, notes).add();
}

} // namespace importers
