// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/Diagnostic.h"
#include "core/base/JobContext.h"
#include "core/city/CityModel.h"
#include "importers/common/ByteSource.h"

#include <string>
#include <string_view>
#include <vector>

namespace reflet::obj {

/// A Wavefront OBJ file as it is written; only faces with three corners or more.
struct ObjFile {
    struct Face {
        std::uint32_t object = 0;    ///< index into objects
        std::uint32_t group = 0;     ///< index into groups
        std::uint32_t material = 0;  ///< index into materials
        std::uint32_t firstCorner = 0;
        std::uint32_t corners = 0;
        bool textured = false;  ///< all of its corners have texture coordinates
    };
    struct Fault {
        std::uint32_t object = 0, group = 0;
        std::size_t line = 0;
        bool outOfRange =
            false;  ///< a corner's vertex does not exist; else it has no three corners
    };
    std::vector<glm::dvec3> vertices;  ///< NaN where a line is no point
    std::vector<glm::vec2> texture;
    std::vector<std::string> objects{""}, groups{""};  ///< distinct; the first has no name
    std::vector<std::string> materials{""};
    std::vector<std::string> libraries;  ///< of materials, as written
    std::vector<Face> faces;
    std::vector<std::uint32_t> corners;    ///< vertices of faces, all of them valid
    std::vector<std::uint32_t> cornerUvs;  ///< of textured faces valid, else kNone
    std::vector<Fault> faults;             ///< faces that are left out
    std::size_t unreadable = 0;            ///< lines that should be vertices and are not
    std::size_t freeForms = 0;             ///< curves and surfaces, which are not read
};

/// Reads a file line by line. ResourceLimit for a line of more than 16 MB and for more than 200
/// million corners or vertices, Unreadable where the source is damaged, Cancelled.
[[nodiscard]] Result<ObjFile> readObj(importers::ByteSource& source, const std::string& subject,
                                      const JobContext& job);

/// Whether the beginning of a file is that of an OBJ file.
[[nodiscard]] bool looksLikeObjText(std::string_view text, bool named);

/// What a library says of a material.
struct ObjMaterial {
    CityMaterial look;
    std::string image;  ///< of its colour, relative to the library; may be empty
    bool clamp = false;
};

/// Materials of a library (MTL). What is not understood is passed over.
[[nodiscard]] std::vector<ObjMaterial> readMaterials(std::string_view text);

}  // namespace reflet::obj
