// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/pipeline/PreparedCity.h"
#include "app/pipeline/WithoutTrees.h"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace reflet {

/// The columns of table 1 of Meyer and Loscos 2003, and the rival of today: rays.
enum class Table1Column {
    None,         ///< the bare sky in place of reflections
    Rerender,     ///< the city drawn into six faces for each body, culled per face
    RayTrace,     ///< each body's map traced anew on the CPU, shaded as REMs are baked
    Mem,          ///< multiple environment maps
    RerenderLod,  ///< the same three with levels of detail
    RayTraceLod,
    MemLod,
};
inline constexpr std::size_t kTable1Columns = 7;
/// "none", "rerender", "raytrace", "mem", "rerenderLod", "raytraceLod", "memLod".
[[nodiscard]] const char* toString(Table1Column column);

struct Table1Options {
    int width = 1280;
    int height = 720;
    int frames = 12;                ///< measured for each cell, at least 1
    std::vector<int> cars{15, 30};  ///< a row for each
    int maps = 12;                  ///< places at which a local map of each kind is timed
};

/// Pictures of one column, until their pixels can be read.
struct Table1Cell {
    double median = 0.0;  ///< milliseconds
    double worst = 0.0;
    double maps = 0.0;  ///< local maps made for a picture, mean
    double rays = 0.0;  ///< of their meshes, mean
};

using Table1Cells = std::array<Table1Cell, kTable1Columns>;

/// What trees cost: the same moments in the city without them.
struct Table1TreeRow {
    Table1Cells without;
    /// Milliseconds that a picture takes longer with trees; the median over the moments.
    std::array<double, kTable1Columns> cost{};
};

struct Table1Row {
    int cars = 0;
    double displayed = 0.0;  ///< in the view, mean
    Table1Cells cells;
    std::optional<Table1TreeRow> trees;  ///< nullopt: the city has none

    [[nodiscard]] const Table1Cell& at(Table1Column column) const {
        return cells[std::size_t(column)];
    }
};

/// One local map, milliseconds: medians over the same places.
struct Table1Maps {
    std::size_t places = 0;
    double rerender = 0.0;         ///< all that lies in a face's view, as in the paper
    double rerenderThinned = 0.0;  ///< without what is smaller than a texel, as in the pictures
    double raytrace = 0.0, mem = 0.0;
    /// dB of the maps of mem against those that were traced anew, as displayed; nullopt: the same.
    std::optional<double> psnr;
};

struct Table1Trees {
    TreeCount count;
    Table1Maps without;  ///< the same places without them
};

struct Table1Report {
    std::string renderer;  ///< the driver's words
    int threads = 1;
    int resolution = 0;  ///< of local maps
    std::size_t probes = 0, triangles = 0;
    std::vector<Table1Row> rows;
    Table1Maps map;
    std::optional<Table1Trees> trees;  ///< nullopt: the city has none
};

/// `bare`: the same without trees (drivenWithoutTrees), for what trees cost; null: not asked for.
/// Levels of detail are those of the project without a limit of time (LodSettings::frameBudget), so
/// that all columns owe the same maps. Cars drive all routes of the project, evenly spread, seen
/// from over the first route. All columns of a moment are drawn one after the other, without trees
/// too, so that a busy machine is busy for all. Draws in a context of its own on the calling
/// thread. Usage when there are no routes or no probes; ResourceLimit without OpenGL 4.5;
/// Cancelled.
[[nodiscard]] Result<Table1Report> measureTable1(const PreparedCity& city, const RemSet& rems,
                                                 const Table1Options& options,
                                                 const JobContext& job,
                                                 const DrivenCity* bare = nullptr);

}  // namespace reflet
