// facetmill-import-scenes: reads files of 3D editors with assimp, and writes GLB (importers/helper.hpp).

#include "convert.hpp"

#include <assimp/Importer.hpp>
#include <assimp/postprocess.h>
#include <assimp/version.h>
#include <cmath>
#include <stdexcept>

namespace importers {

namespace {

constexpr unsigned steps = aiProcess_Triangulate | aiProcess_SortByPType | aiProcess_ValidateDataStructure;

aiMatrix4x4 from_rows(const aiVector3D& x, const aiVector3D& y, const aiVector3D& z) {
    return {x.x, x.y, x.z, 0, y.x, y.y, y.z, 0, z.x, z.y, z.z, 0, 0, 0, 0, 1};
}

aiMatrix4x4 z_to_y() { return from_rows({1, 0, 0}, {0, 0, 1}, {0, -1, 0}); }

/// From 5.4 on, assimp itself turns the root of FBX and scales it to centimetres.
bool turns_fbx() { return aiGetVersionMajor() > 5 || (aiGetVersionMajor() == 5 && aiGetVersionMinor() >= 4); }

/// The rotation that the axes in the file state; its third axis follows from the other two, because a
/// mirrored scene would turn faces over.
aiMatrix4x4 rotation_of_fbx(const aiMetadata& data) {
    const auto axis = [&](const char* name, int usual) {
        std::int32_t at = usual, sign = 1;
        data.Get(name, at);
        data.Get(std::string(name) + "Sign", sign);
        aiVector3D v;
        v[static_cast<unsigned>(at >= 0 && at < 3 ? at : usual)] = sign < 0 ? -1.0F : 1.0F;
        return v;
    };
    const aiVector3D up = axis("UpAxis", 1), right = axis("CoordAxis", 0), front = right ^ up;
    return front.SquareLength() == 0 ? aiMatrix4x4() : from_rows(right, up, front);
}

/// The metres of the unit attribute of AMF.
double unit_of_amf(const std::string& file) {
    constexpr std::size_t near = 4096;
    const std::string begin = file.substr(0, near);
    const auto has = [&](const char* unit) {
        return begin.find(std::string("unit=\"") + unit) != begin.npos ||
               begin.find(std::string("unit='") + unit) != begin.npos;
    };
    constexpr double inch = 0.0254, foot = 0.3048, micron = 1e-6, millimetre = 1e-3;
    return has("inch") ? inch : has("feet") ? foot : has("meter") ? 1 : has("micron") ? micron : millimetre;
}

/// Moves a scale of the root, which states the unit of the file, into the convention.
void take_root_scale(aiNode& root, Convention& convention) {
    aiMatrix4x4& m = root.mTransformation;
    const double s = std::cbrt(std::fabs(m.Determinant()));
    const auto near = [&](double a, double b) { return std::fabs(a - b) <= 1e-5 * s; };
    if (!(s > 0) || near(s, 1) || root.mNumMeshes > 0 || !near(m.a4, 0) || !near(m.b4, 0) || !near(m.c4, 0))
        return;
    for (unsigned c = 0; c < 3; ++c)
        if (!near(std::hypot(m[0][c], m[1][c], m[2][c]), s)) return;
    for (unsigned r = 0; r < 3; ++r)
        for (unsigned c = 0; c < 3; ++c) m[r][c] = static_cast<float>(m[r][c] / s);
    convention.scale *= s;
}

bool is_rotation(const aiMatrix4x4& m) { return m.a4 == 0 && m.b4 == 0 && m.c4 == 0; }

Convention convention_of(const aiScene& scene, const Options& options, const std::string& file) {
    Convention convention;
    constexpr double centimetre = 0.01;
    take_root_scale(*scene.mRootNode, convention);
    if (options.format == "fbx" && scene.mMetaData) {
        double unit = 1;
        float single = 1;
        if (!scene.mMetaData->Get("UnitScaleFactor", unit) && scene.mMetaData->Get("UnitScaleFactor", single))
            unit = single;
        convention.scale *= (turns_fbx() ? 1 : unit) * centimetre;
        if (!turns_fbx()) convention.rotation = rotation_of_fbx(*scene.mMetaData);
    } else if (options.format == "fbx") {
        convention.scale *= centimetre;
    }
    if (options.format == "amf") convention.scale *= unit_of_amf(file);
    if (options.format == "amf" || options.format == "blend") convention.rotation = z_to_y();
    if (options.keep_unit) convention.scale = 1;
    if (options.keep_up) convention.rotation = aiMatrix4x4();
    if (options.keep_up && is_rotation(scene.mRootNode->mTransformation) && scene.mRootNode->mNumMeshes == 0)
        scene.mRootNode->mTransformation = aiMatrix4x4();
    return convention;
}

void warn_of_losses(const aiScene& scene, Notes& notes) {
    if (scene.mNumCameras > 0) notes.warn("cameras are dropped");
    if (scene.mNumLights > 0) notes.warn("lights are dropped");
}

/// The name by which assimp finds its reader, which needs the usual suffix.
std::string name_for(const Options& options) {
    const std::string suffix = options.format == "md5" ? ".md5mesh" : "." + options.format;
    const std::string own = std::filesystem::path(options.name).extension().string();
    return own.empty() ? "input" + suffix : options.name;
}

void convert(const Options& given, const std::string& file, Glb& glb, Notes& notes) {
    Options options = given;
    options.name = name_for(given);
    Assimp::Importer importer;
    auto* files = new SceneFiles(options, file, notes); // the importer deletes it
    importer.SetIOHandler(files);
    importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, false);
    importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true); // no meshes that no file has
    importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, 0);
    const aiScene* scene = importer.ReadFile(options.name, steps);
    const std::string why = importer.GetErrorString();
    if (!scene || !scene->mRootNode) throw std::runtime_error(why.empty() ? "assimp gives no reason" : why);
    const Convention convention = convention_of(*scene, options, file);
    glb.json["asset"]["generator"] =
        "assimp " + std::to_string(aiGetVersionMajor()) + "." + std::to_string(aiGetVersionMinor());
    add_materials(*scene, *files, glb, notes);
    add_nodes(*scene, convention, glb, notes);
    warn_of_losses(*scene, notes);
}

} // namespace

} // namespace importers

int main(int count, char** arguments) { return importers::run(count, arguments, importers::convert); }
