// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/ForeignFormats.h"

#include <array>

namespace reflet {

namespace {

constexpr std::string_view kIfc =
    "Convert it to CityJSON, or to glTF, e.g. with IfcConvert or by opening it in Blender with "
    "Bonsai and exporting glTF.";
constexpr std::string_view kBlender =
    "Open it in Blender and export it as glTF (.glb) or OBJ; city models come best as CityJSON or "
    "CityGML.";
constexpr std::string_view kItsProgram =
    "Export it as glTF (.glb) or OBJ from the program that made it; city models come best as "
    "CityJSON or CityGML.";
constexpr std::string_view kCad =
    "Export its solids and meshes as OBJ or glTF from the CAD program; footprints come as GeoJSON "
    "or a shapefile.";
constexpr std::string_view kPoints =
    "Point clouds have no surfaces: make a city model of it first, e.g. with roofer or City4CFD, "
    "which write CityJSON.";
constexpr std::string_view kTiles =
    "Ask for the city model that the tiles were made from, as CityJSON or CityGML; single tiles "
    "can be saved as glTF.";

// OLE files (3ds Max, Revit, old MicroStation) share their first bytes, and so do ZIP files: they
// are known by their suffix.
constexpr std::array<ForeignFormat, 26> kForeign{{
    {"IFC", ".ifc .ifcxml .ifczip", "ISO-10303-21", kIfc},
    {"FBX", ".fbx", "Kaydara FBX Binary", kBlender},
    {"SketchUp", ".skp", std::string_view("\xff\xfe\xff\x0e", 4), kItsProgram},
    {"AutoCAD drawing (DWG)", ".dwg", "AC10", kCad},
    {"AutoCAD drawing (DXF)", ".dxf", "AutoCAD Binary DXF", kCad},
    {"MicroStation (DGN)", ".dgn", "", kCad},
    {"3D Studio (3DS)", ".3ds", "MM", kBlender},
    {"3ds Max", ".max", "", kItsProgram},
    {"Revit", ".rvt .rfa", "", kIfc},
    {"ArchiCAD", ".pln .pla", "", kIfc},
    {"Blender", ".blend", "BLENDER", kBlender},
    {"Rhino", ".3dm", "3D Geometry File Format", kItsProgram},
    {"Cinema 4D", ".c4d", "", kItsProgram},
    {"LightWave", ".lwo .lws", "", kBlender},
    {"Collada", ".dae", "", kBlender},
    {"STL", ".stl", "solid ", kBlender},
    {"PLY", ".ply", "ply\n", kBlender},
    {"Universal Scene Description", ".usd .usdc .usda", "PXR-USDC", kBlender},
    {"Universal Scene Description", ".usdz", "#usda", kBlender},
    {"STEP", ".step .stp", "", kCad},
    {"VRML or X3D", ".wrl .x3d", "#VRML", kBlender},
    {"point cloud (LAS)", ".las .laz", "LASF", kPoints},
    {"point cloud (E57)", ".e57", "ASTM-E57", kPoints},
    {"point cloud (3D Tiles)", ".pnts", "pnts", kPoints},
    {"Indexed 3D Scene Layer", ".slpk", "", kTiles},
    {"KML", ".kml .kmz", "", kItsProgram},
}};

bool hasSuffix(std::string_view name, std::string_view suffixes) {
    while (!suffixes.empty()) {
        const std::size_t space = suffixes.find(' ');
        if (name.ends_with(suffixes.substr(0, space)))
            return true;
        suffixes = space == std::string_view::npos ? "" : suffixes.substr(space + 1);
    }
    return false;
}

/// Two letters alone say too little: the 3DS chunk also tells the size of its file.
bool matches(const ForeignFormat& format, const FileHead& head) {
    if (format.magic.empty() || !std::string_view(head.bytes).starts_with(format.magic))
        return false;
    return format.magic.size() > 2 || hasSuffix(head.name, format.suffixes);
}

}  // namespace

const ForeignFormat* foreignFormatByContent(const FileHead& head) {
    for (const ForeignFormat& format : kForeign) {
        if (matches(format, head))
            return &format;
    }
    const std::string_view start = std::string_view(head.text).substr(0, 1024);
    for (const auto& [root, suffix] : {std::pair("<COLLADA", ".dae"), std::pair("<kml", ".kml"),
                                       std::pair("<X3D", ".x3d"), std::pair("ifcXML", ".ifcxml")}) {
        if (start.find(root) != std::string_view::npos)
            return foreignFormatByName(suffix);
    }
    return nullptr;
}

const ForeignFormat* foreignFormatByName(std::string_view lowerCaseName) {
    for (const ForeignFormat& format : kForeign) {
        if (hasSuffix(lowerCaseName, format.suffixes))
            return &format;
    }
    return nullptr;
}

}  // namespace reflet
