// facetmill-import-cad: reads CAD files with Open CASCADE, divides their faces into triangles, and writes GLB
// (importers/helper.hpp) in the given unit with z up.

#include "mesh.hpp"

#include <BRepBndLib.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <Bnd_Box.hxx>
#include <IGESCAFControl_Reader.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Quantity_ColorRGBA.hxx>
#include <STEPCAFControl_Reader.hxx>
#include <Standard_Failure.hxx>
#include <Standard_Version.hxx>
#include <TDF_LabelSequence.hxx>
#include <TDataStd_Name.hxx>
#include <TDocStd_Document.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <XCAFApp_Application.hxx>
#include <XCAFDoc_ColorTool.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_LayerTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>
#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <tuple>

namespace importers {

namespace {

using Colour = std::array<float, 4>;

std::string text_of(const TCollection_ExtendedString& from) {
    const TCollection_AsciiString utf8(from, '\0');
    return {utf8.ToCString(), static_cast<std::size_t>(utf8.Length())};
}

std::string name_of(const TDF_Label& label) {
    Handle(TDataStd_Name) name;
    return label.FindAttribute(TDataStd_Name::GetID(), name) ? text_of(name->Get()) : std::string();
}

class Assembly {
  public:
    Assembly(const Handle(TDocStd_Document) & document, Glb& glb, Notes& notes)
        : shapes_(XCAFDoc_DocumentTool::ShapeTool(document->Main())),
          colours_(XCAFDoc_DocumentTool::ColorTool(document->Main())),
          layers_(XCAFDoc_DocumentTool::LayerTool(document->Main())), glb_(glb), notes_(notes) {}

    void add(const Options& options);

  private:
    int node(const TDF_Label& label, const std::optional<Colour>& inherited);
    void fill_shape(const TDF_Label& label, const std::optional<Colour>& colour, Json& to);
    int mesh(const TopoDS_Shape& shape, const std::optional<Colour>& colour, const std::string& name);
    int material(const std::optional<Colour>& colour);
    [[nodiscard]] std::optional<Colour> colour_of(const TDF_Label& label) const;
    [[nodiscard]] std::optional<Colour> colour_of(const TopoDS_Shape& shape) const;
    void add_layers(const TDF_Label& label, Json& to) const;
    void triangulate(const TDF_LabelSequence& roots, const Options& options);
    void refine(const TopoDS_Shape& shape);

    Handle(XCAFDoc_ShapeTool) shapes_;
    Handle(XCAFDoc_ColorTool) colours_;
    Handle(XCAFDoc_LayerTool) layers_;
    Glb& glb_;
    Notes& notes_;
    IMeshTools_Parameters how_;
    std::map<std::optional<Colour>, int> materials_;
    /// By the solid, without its place, and the inherited colour.
    std::map<std::tuple<const void*, int, std::optional<Colour>>, int> meshes_;
};

Colour as_colour(const Quantity_ColorRGBA& c) {
    return {static_cast<float>(c.GetRGB().Red()), static_cast<float>(c.GetRGB().Green()),
            static_cast<float>(c.GetRGB().Blue()), c.Alpha()};
}

template <class What>
std::optional<Colour> first_colour(const Handle(XCAFDoc_ColorTool) & tool, const What& what) {
    for (const auto kind : {XCAFDoc_ColorSurf, XCAFDoc_ColorGen})
        if (Quantity_ColorRGBA colour; tool->GetColor(what, kind, colour)) return as_colour(colour);
    return {};
}

std::optional<Colour> Assembly::colour_of(const TDF_Label& label) const {
    return first_colour(colours_, label);
}

std::optional<Colour> Assembly::colour_of(const TopoDS_Shape& shape) const {
    return first_colour(colours_, shape);
}

int Assembly::material(const std::optional<Colour>& colour) {
    const auto [at, is_new] = materials_.try_emplace(colour, -1);
    if (!is_new || !colour) return at->second;
    const auto& c = *colour;
    Json item = {
        {"pbrMetallicRoughness",
         {{"baseColorFactor", {c[0], c[1], c[2], c[3]}}, {"metallicFactor", 0}, {"roughnessFactor", 0.5}}}};
    if (c[3] < 1) item["alphaMode"] = "BLEND";
    return at->second = glb_.add("materials", std::move(item));
}

void Assembly::add_layers(const TDF_Label& label, Json& to) const {
    Handle(TColStd_HSequenceOfExtendedString) names;
    if (!layers_->GetLayers(label, names) || names.IsNull()) return;
    for (int i = 1; i <= names->Length(); ++i) to["extras"]["layers"].push_back(text_of(names->Value(i)));
}

/// Writes a location as a matrix, which may mirror.
void add_place(const TopLoc_Location& place, Json& to) {
    if (place.IsIdentity()) return;
    const gp_Trsf& t = place.Transformation();
    Json matrix = Json::array();
    for (int c = 1; c <= 4; ++c)
        for (int r = 1; r <= 4; ++r) matrix.push_back(r <= 3 ? t.Value(r, c) : c == 4 ? 1.0 : 0.0);
    to["matrix"] = std::move(matrix);
}

int Assembly::mesh(const TopoDS_Shape& shape, const std::optional<Colour>& colour, const std::string& name) {
    const std::optional<Colour> own = colour_of(shape);
    const std::optional<Colour> whole = own ? own : colour;
    const std::tuple key{static_cast<const void*>(shape.TShape().get()),
                         static_cast<int>(shape.Orientation()), whole};
    const auto [at, is_new] = meshes_.try_emplace(key, -1);
    if (!is_new) return at->second;
    refine(shape);
    const auto groups = groups_of(
        shape.Located(TopLoc_Location()),
        [&](const TopoDS_Shape& face) {
            const std::optional<Colour> painted = colour_of(face);
            return material(painted ? painted : whole);
        },
        notes_);
    Json primitives = Json::array();
    for (const auto& [material, group] : groups) {
        if (group.corners.empty()) continue;
        Json one = {{"attributes",
                     {{"POSITION", glb_.floats(group.positions, "VEC3", vertex_target, true)},
                      {"NORMAL", glb_.floats(group.normals, "VEC3", vertex_target)},
                      {"_CAD_FACE", glb_.floats(group.faces, "SCALAR", vertex_target)}}},
                    {"indices", glb_.indices(group.corners)}};
        if (material >= 0) one["material"] = material;
        primitives.push_back(std::move(one));
    }
    if (primitives.empty()) return -1;
    Json item = {{"primitives", std::move(primitives)}};
    if (!name.empty()) item["name"] = name;
    return at->second = glb_.add("meshes", std::move(item));
}

/// The solids of a shape, then shells outside of solids, then the other faces as one shape.
std::vector<TopoDS_Shape> pieces_of(const TopoDS_Shape& shape) {
    std::vector<TopoDS_Shape> pieces;
    for (TopExp_Explorer at(shape, TopAbs_SOLID); at.More(); at.Next()) pieces.push_back(at.Current());
    for (TopExp_Explorer at(shape, TopAbs_SHELL, TopAbs_SOLID); at.More(); at.Next())
        pieces.push_back(at.Current());
    BRep_Builder builder;
    TopoDS_Compound rest;
    builder.MakeCompound(rest);
    bool any = false;
    for (TopExp_Explorer at(shape, TopAbs_FACE, TopAbs_SHELL); at.More(); at.Next()) {
        builder.Add(rest, at.Current());
        any = true;
    }
    if (any) pieces.push_back(rest);
    return pieces;
}

void Assembly::fill_shape(const TDF_Label& label, const std::optional<Colour>& colour, Json& to) {
    const TopoDS_Shape shape = shapes_->GetShape(label);
    const std::string name = name_of(label);
    const std::vector<TopoDS_Shape> pieces = pieces_of(shape);
    const bool single = pieces.size() == 1 && pieces.front().Location().IsIdentity();
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const int index = mesh(pieces[i], colour, name);
        if (index < 0) continue;
        if (single) {
            to["mesh"] = index;
            return;
        }
        Json child = {{"name", name + "_" + std::to_string(i + 1)}, {"mesh", index}};
        add_place(pieces[i].Location(), child);
        to["children"].push_back(glb_.add("nodes", std::move(child)));
    }
}

int Assembly::node(const TDF_Label& label, const std::optional<Colour>& inherited) {
    Json to = Json::object();
    TDF_Label original = label;
    const bool refers = XCAFDoc_ShapeTool::GetReferredShape(label, original);
    std::string name = name_of(label);
    // "=>[0:1:1:2]" and "NAUO1" are numbers of the use, which nobody has named.
    if (name.empty() || name.starts_with("=>[") || name.starts_with("NAUO"))
        if (std::string product = name_of(original); !product.empty()) name = std::move(product);
    if (!name.empty()) to["name"] = name;
    if (refers) add_place(XCAFDoc_ShapeTool::GetLocation(label), to);
    std::optional<Colour> colour = colour_of(label);
    if (!colour && refers) colour = colour_of(original);
    if (!colour) colour = inherited;
    add_layers(label, to);
    if (refers && !to.contains("extras")) add_layers(original, to);
    if (XCAFDoc_ShapeTool::IsAssembly(original)) {
        TDF_LabelSequence parts;
        XCAFDoc_ShapeTool::GetComponents(original, parts);
        for (int i = 1; i <= parts.Length(); ++i) to["children"].push_back(node(parts.Value(i), colour));
    } else {
        fill_shape(original, colour, to);
    }
    return glb_.add("nodes", std::move(to));
}

void Assembly::triangulate(const TDF_LabelSequence& roots, const Options& options) {
    Bnd_Box box;
    for (int i = 1; i <= roots.Length(); ++i)
        BRepBndLib::Add(XCAFDoc_ShapeTool::GetShape(roots.Value(i)), box, Standard_False);
    constexpr double least = 1e-6, half_turn = 180;
    const double diagonal = box.IsVoid() ? 1 : std::sqrt(box.SquareExtent());
    how_.Deflection =
        std::max(options.deviation > 0 ? options.deviation / options.unit : options.ratio * diagonal,
                 diagonal * least);
    how_.DeflectionInterior = how_.Deflection;
    how_.Angle = how_.AngleInterior = options.degrees * M_PI / half_turn;
    for (int i = 1; i <= roots.Length(); ++i) {
        const TopoDS_Shape shape = XCAFDoc_ShapeTool::GetShape(roots.Value(i));
        BRepTools::Clean(shape); // files may contain coarser triangles
        BRepMesh_IncrementalMesh run(shape, how_);
    }
}

/// Open CASCADE exceeds its deflection on spheres and the like: divides again, more finely, until it holds.
void Assembly::refine(const TopoDS_Shape& shape) {
    IMeshTools_Parameters how = how_;
    constexpr int most_tries = 3;
    double found = deviation_of(shape), before = 2 * found;
    // Faces of bad parameters do not improve, and must not get ever more triangles.
    constexpr double improves = 0.9, least_step = 0.5, largest_step = 0.75;
    for (int tries = 0; tries < most_tries && found > how_.Deflection && found < improves * before; ++tries) {
        how.Deflection *= std::clamp(how_.Deflection / found, least_step, largest_step);
        how.DeflectionInterior = how.Deflection;
        BRepTools::Clean(shape);
        BRepMesh_IncrementalMesh run(shape, how);
        before = found;
        found = deviation_of(shape);
    }
    if (found > how_.Deflection) notes_.warn("some faces deviate more than max_deviation");
}

void Assembly::add(const Options& options) {
    TDF_LabelSequence roots;
    shapes_->GetFreeShapes(roots);
    if (roots.IsEmpty()) throw std::runtime_error("it has no shapes");
    triangulate(roots, options);
    Json nodes = Json::array();
    for (int i = 1; i <= roots.Length(); ++i) nodes.push_back(node(roots.Value(i), {}));
    glb_.json["scenes"][0]["nodes"] = nodes;
}

template <class Reader>
void transfer(Reader& reader, Handle(TDocStd_Document) document) {
    reader.SetNameMode(Standard_True);
    reader.SetColorMode(Standard_True);
    reader.SetLayerMode(Standard_True);
    if (!reader.Transfer(document)) throw std::runtime_error("its shapes cannot be converted");
}

void read(const Options& options, const std::string& file, const Handle(TDocStd_Document) & document) {
    std::istringstream stream(file);
    if (options.format == "step") {
        STEPCAFControl_Reader reader;
        if (reader.ChangeReader().ReadStream("input.step", stream) != IFSelect_RetDone)
            throw std::runtime_error("it is not a valid STEP file");
        transfer(reader, document);
    } else if (options.format == "iges") {
        IGESCAFControl_Reader reader; // reads only files by name: the input is open as number 0
        if (reader.ReadFile("/proc/self/fd/0") != IFSelect_RetDone)
            throw std::runtime_error("it is not a valid IGES file");
        transfer(reader, document);
    } else {
        TopoDS_Shape shape;
        BRepTools::Read(shape, stream, BRep_Builder());
        if (shape.IsNull()) throw std::runtime_error("it is not a valid BREP file");
        XCAFDoc_DocumentTool::ShapeTool(document->Main())->AddShape(shape, Standard_False);
    }
}

void convert(const Options& options, const std::string& file, Glb& glb, Notes& notes) {
    try {
        Message::DefaultMessenger()->ChangePrinters().Clear();
        const Handle(XCAFApp_Application) application = XCAFApp_Application::GetApplication();
        Handle(TDocStd_Document) document;
        application->NewDocument("MDTV-XCAF", document);
        XCAFDoc_DocumentTool::SetLengthUnit(document, options.unit);
        read(options, file, document);
        glb.json["asset"]["generator"] = "Open CASCADE " OCC_VERSION_COMPLETE;
        Assembly(document, glb, notes).add(options);
    } catch (const Standard_Failure& failure) {
        throw std::runtime_error(failure.GetMessageString());
    }
}

} // namespace

} // namespace importers

int main(int count, char** arguments) { return importers::run(count, arguments, importers::convert); }
