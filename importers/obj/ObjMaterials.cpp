// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/common/Colours.h"
#include "importers/obj/ObjFile.h"
#include "importers/obj/ObjText.h"

#include <algorithm>
#include <cmath>

namespace reflet::obj {

namespace {

/// One number stands for all three; other colour spaces ("spectral", "xyz") are passed over.
bool readColour(std::string_view line, glm::dvec3& colour) {
    glm::dvec3 read(nextNumber(line));
    if (const double y = nextNumber(line); !std::isnan(y))
        read = {read.x, y, nextNumber(line)};
    if (std::isnan(read.x + read.y + read.z))
        return false;
    colour = read;
    return true;
}

/// The file name behind the options of a map: "-s 2 2 1 -clamp on brick wall.png".
void readMap(std::string_view line, ObjMaterial& material) {
    for (;;) {
        std::string_view rest = line;
        const std::string_view word = nextWord(rest);
        if (!word.starts_with('-') || word.size() < 2)
            break;
        line = rest;
        const std::string_view option = word;
        // Numbers and on/off behind an option belong to it.
        for (;;) {
            rest = line;
            const std::string_view value = nextWord(rest);
            if (value != "on" && value != "off" && std::isnan(numberOf(value)))
                break;
            if (trimmed(rest).empty())
                break;  // "map_Kd -s 1 1 7" names a file 7
            if (option == "-clamp")
                material.clamp = value == "on";
            line = rest;
        }
        if (option == "-imfchan" || option == "-type")
            nextWord(line);
    }
    material.image = trimmed(line);
}

}  // namespace

std::vector<ObjMaterial> readMaterials(std::string_view text) {
    std::vector<ObjMaterial> materials;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        std::string_view line = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        const std::string_view word = nextWord(line);
        if (word == "newmtl") {
            materials.emplace_back().look.name = trimmed(line);
            continue;
        }
        if (materials.empty())
            continue;
        ObjMaterial& material = materials.back();
        glm::dvec3 colour(0.0);
        if (word == "Kd" && readColour(line, colour)) {
            material.look.diffuse = importers::linearFromSrgb(colour);
        } else if (word == "Ke" && readColour(line, colour)) {
            material.look.emission = importers::linearFromSrgb(colour);
        } else if (word == "d") {
            const double value = nextNumber(line);
            if (!std::isnan(value))
                material.look.transparency = float(1.0 - std::clamp(value, 0.0, 1.0));
        } else if (word == "Tr") {
            // Some programs write what "d" means: then all would be invisible.
            const double value = nextNumber(line);
            if (value >= 0.0 && value < 1.0)
                material.look.transparency = float(value);
        } else if (word == "Ns") {
            constexpr double kSharpest = 1000.0;
            const double value = nextNumber(line);
            if (!std::isnan(value))
                material.look.shininess = float(std::clamp(value / kSharpest, 0.0, 1.0));
        } else if (word == "map_Kd") {
            readMap(line, material);
        }
    }
    return materials;
}

}  // namespace reflet::obj
