#include "io/other_formats.hpp"

#include "base/text/spelling.hpp"
#include "io/codec.hpp"
#include "io/packing.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <vector>

namespace facetmill::io {

namespace {

struct OtherFormat {
    std::vector<std::string_view> suffixes;
    std::string_view what;
    std::string_view to_read;  ///< how to convert it to a readable format
    std::string_view to_write; ///< empty: no conversion to this format is known
};

/// Built on first use, not at every start.
const std::vector<OtherFormat>& other_formats() {
    static const std::vector<OtherFormat> all{
        {{"fbx", "blend", "dae", "3ds", "abc", "max", "ma", "mb", "c4d", "lwo", "x3d", "wrl", "vrml", "x"},
         "a file of a 3D editor",
         "export it as glTF (.glb), which keeps materials; Blender opens and exports most of them",
         "write .glb, which Blender and others open and convert"},
        {{"usd", "usda", "usdc", "usdz"},
         "a USD file",
         "export it as glTF (.glb), as Blender does",
         "write .usdz, which programs for USD open"},
        {{"step", "stp", "iges", "igs", "brep", "sldprt", "sldasm", "ipt", "iam", "prt", "catpart", "x_t",
          "x_b", "fcstd", "sat", "3dm", "dwg", "ifc", "f3d"},
         "a CAD file of curved surfaces or solids, not a mesh",
         "export a mesh (.stl, .3mf or .obj) from the CAD program, or with FreeCAD or Gmsh",
         "a mesh is not a CAD solid: write .stl or .3mf, which CAD programs import as a mesh"},
        {{"scad"}, "an OpenSCAD program", "convert it to a mesh: openscad -o part.3mf part.scad", ""},
        {{"xyz", "pts", "ptx", "asc", "las", "laz", "e57", "pcd"},
         "a cloud of points",
         "convert it to .ply, with CloudCompare or PDAL, which can also make a surface from points",
         "write .ply, which CloudCompare and others convert"},
        {{"vtk", "vtp", "vtu", "msh", "inp", "mesh", "bdf", "cgns"},
         "a file of simulation meshes",
         "convert its surface to .ply or .stl, with meshio or ParaView",
         "write .ply or .stl, which meshio and ParaView convert"},
        {{"amf"}, "an AMF file", "save it as .3mf or .stl in the slicer", "write .3mf, which replaced it"},
        {{"gcode"},
         "a program for a printer, not a mesh",
         "give the mesh from which it was made",
         "write .3mf or .stl, from which the slicer makes it"},
        {{"ctm", "nxs", "nxz", "u3d", "mdd"},
         "a file that few programs still read",
         "convert it to .ply, with MeshLab",
         "write .ply"},
        {{"zip", "7z", "rar", "tar", "tgz"}, "an archive", "unpack it and give the mesh in it", ""},
        {{"jpg", "jpeg", "png", "tif", "tiff", "webp", "avif", "gif", "bmp", "pdf"},
         "a picture, not a mesh",
         "give the mesh that it shows",
         "render makes pictures, as .png"},
        {{"yaml", "yml"}, "a pipeline, not a mesh", "a pipeline runs by facetmill run FILE", ""},
    };
    return all;
}

const OtherFormat* other_format(const std::filesystem::path& path) {
    const std::string name = lower_case(without_packing(path).extension().generic_string());
    for (const auto& format : other_formats())
        for (const std::string_view suffix : format.suffixes)
            if (name.size() == suffix.size() + 1 && name.ends_with(suffix)) return &format;
    return nullptr;
}

} // namespace

std::string hint_for_reading(const std::filesystem::path& path) {
    const Codec* codec = codec_for(path);
    const OtherFormat* format = codec && codec->reads() ? nullptr : other_format(path);
    return format ? fmt::format("its name suggests {}: {}", format->what, format->to_read) : "";
}

std::string hint_for_writing(const std::filesystem::path& path) {
    const OtherFormat* format = other_format(path);
    return format ? std::string(format->to_write) : "";
}

} // namespace facetmill::io
