// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/baking/Facade.h"

#include <array>

namespace reflet {

namespace {

using Style = FacadeStyle;

constexpr glm::vec3 kGlass{0.030F, 0.042F, 0.055F};
constexpr glm::vec3 kSkyInGlass{0.060F, 0.085F, 0.110F};
constexpr glm::vec3 kCurtain{0.34F, 0.33F, 0.30F};
constexpr glm::vec3 kLamp{0.62F, 0.42F, 0.20F};      ///< a lit room
constexpr glm::vec3 kShopLamp{0.75F, 0.58F, 0.36F};  ///< a lit shop
constexpr float kCornice = 0.42F;
constexpr float kLitShare = 0.34F;

glm::vec3 choose(std::uint32_t seed, const std::array<std::uint32_t, 6>& palette) {
    return colourOf(palette[patternHash(seed) % palette.size()]);
}

/// Where a point lies on the wall, and the sample's extents there.
struct WallPoint {
    float u = 0.0F;    ///< metres along the wall from its start
    float y = 0.0F;    ///< metres above the building's base
    float wu = 0.0F;   ///< footprint along the wall
    float wy = 0.0F;   ///< footprint upwards
    float top = 0.0F;  ///< of this wall, above the base
    float bottom = 0.0F;
    float bay = 3.0F;  ///< width of a bay
    float firstBay = 0.0F, lastBay = 1.0F;
    bool eaves = true;        ///< the wall ends in a cornice (a gable does not)
    float courses = 0.0F;     ///< how many string courses
    std::int32_t column = 0;  ///< of the bay that the point is in
};

WallPoint placeOn(const SurfaceLook& look, const BuildingLook& building, const FacadeGrid& grid,
                  const glm::vec3& point, const Footprint& footprint) {
    WallPoint w;
    w.u = point.x * look.tangent.x + point.y * look.tangent.y - look.uMin;
    w.y = point.z - building.base;
    w.wu = footprint.along({look.tangent.x, look.tangent.y, 0.0F}, look.normal);
    w.wy = footprint.along({0.0F, 0.0F, 1.0F}, look.normal);
    w.top = look.top - building.base;
    w.bottom = look.bottom - building.base;
    w.eaves = look.rectangular;
    w.u -= grid.margin;
    w.bay = grid.bay;
    w.firstBay = grid.firstBay;
    w.lastBay = grid.lastBay;
    w.courses = grid.courses;
    w.column = std::int32_t(std::floor(w.u / w.bay));
    return w;
}

/// Coverage of [centre - half, centre + half] about the middle of each bay.
float across(const WallPoint& w, float from, float to) {
    return periodicCoverage(w.u, w.bay, 0.5F * w.bay + from, 0.5F * w.bay + to, w.wu, w.firstBay,
                            w.lastBay);
}

/// One row of storeys: heights are measured from the floor of each.
struct Storeys {
    float floor = 0.0F;  ///< of the first, above the base
    float height = 3.2F;
    float first = 0.0F;  ///< counted, may leave out those below the wall's foot
    float last = 0.0F;
    [[nodiscard]] float upward(const WallPoint& w, float from, float to) const {
        return periodicCoverage(w.y - floor, height, from, to, w.wy, first, last);
    }
};

void blend(glm::vec3& colour, float coverage, const glm::vec3& over, const glm::vec3& beneath) {
    colour += coverage * (over - beneath);
}

/// The wall without openings: plaster that weather has toned, joints, plinth, courses, cornice.
glm::vec3 masonry(const Style& s, const BuildingLook& building, const WallPoint& w) {
    const float across = w.u + 0.37F * float(building.seed & 1023U);
    const float tone = 1.0F +
                       0.035F * filteredNoise(across, w.y, 3.7F, w.wu + w.wy, building.seed) +
                       0.022F * filteredNoise(across, w.y, 0.55F, w.wu + w.wy, building.seed ^ 7U);
    glm::vec3 colour = s.wall * tone;
    if (s.modern) {
        // Panels as high as a storey; joints hardly seen.
        const float joint = periodicCoverage(w.y - s.groundStorey, s.storey, 0.0F, 0.05F, w.wy) +
                            periodicCoverage(w.u, w.bay, 0.0F, 0.03F, w.wu);
        return colour * (1.0F - 0.35F * std::min(joint, 1.0F));
    }
    const float ground = intervalCoverage(w.y, -1e3F, s.groundStorey - 0.25F, w.wy);
    if (s.rusticated) {
        const float joint = periodicCoverage(w.y, 0.42F, 0.0F, 0.035F, w.wy);
        colour *= 1.0F - ground * (0.06F + 0.30F * joint);
    }
    blend(colour, intervalCoverage(w.y, -1e3F, 0.62F, w.wy), s.plinth * tone, colour);
    // A string course above the ground floor, or at every floor, each with its shadow below.
    const Storeys courses{s.groundStorey - 0.25F, s.storey, 0.0F, w.courses};
    blend(colour, courses.upward(w, 0.0F, 0.05F), 0.52F * s.wall, s.wall);
    blend(colour, courses.upward(w, 0.05F, 0.23F), s.trim, s.wall);
    if (!w.eaves) {
        return colour;
    }
    blend(colour, intervalCoverage(w.y, w.top - kCornice, 1e4F, w.wy), s.trim, colour);
    blend(colour, intervalCoverage(w.y, w.top - kCornice - 0.11F, w.top - kCornice, w.wy),
          0.50F * s.wall, s.wall);
    blend(colour,
          intervalCoverage(w.y, w.top - 0.5F * kCornice - 0.05F, w.top - 0.5F * kCornice, w.wy),
          0.72F * s.trim, s.trim);
    return colour;
}

/// The panes of a window: dark, bluish towards the top, with curtains of the window's own.
struct Panes {
    glm::vec3 colour;
    float lit;  ///< share of light, 0..1
};

Panes panesOf(std::uint32_t seed, std::int32_t column, std::int32_t storey, float height01,
              float bayFootprint) {
    const float own = resolved(2.2F, bayFootprint);
    const float drawn = patternRandom(seed ^ 0xA1U, column, storey);
    const float curtain = glm::mix(0.24F,
                                   drawn < 0.45F  ? 0.05F
                                   : drawn < 0.8F ? 0.25F
                                                  : 0.75F,
                                   own);
    const float sky = glm::mix(0.5F, std::clamp(height01, 0.0F, 1.0F), own);
    Panes p;
    p.colour = glm::mix(glm::mix(kGlass, kSkyInGlass, sky), kCurtain, curtain);
    const bool on = patternRandom(seed ^ 0xB2U, column, storey) < kLitShare;
    p.lit = glm::mix(kLitShare, on ? 0.65F + 0.35F * drawn : 0.0F, own);
    return p;
}

/// Windows of a row of storeys over the masonry.
void drawWindows(const Style& s, const BuildingLook& building, const WallPoint& w,
                 const Storeys& row, float night, Appearance& look) {
    if (row.last <= row.first || w.lastBay <= w.firstBay) {
        return;
    }
    const float half = 0.5F * s.window;
    const float head = s.sill + s.height;
    glm::vec3& colour = look.albedo;
    const glm::vec3 wall = s.wall;
    if (s.surround > 0.0F) {
        const float outer = half + s.surround;
        blend(colour,
              across(w, -outer - 0.07F, outer + 0.07F) *
                  row.upward(w, s.sill - 0.20F, s.sill - 0.12F),
              0.55F * wall, wall);
        blend(colour,
              across(w, -outer - 0.07F, outer + 0.07F) * row.upward(w, s.sill - 0.12F, s.sill),
              s.trim, wall);
        blend(colour, across(w, -outer, outer) * row.upward(w, s.sill, head + s.surround), s.trim,
              wall);
    }
    const float leaf = std::min(0.5F * s.window, 0.5F * w.bay - half - s.surround - 0.06F);
    if (s.shutters && leaf > 0.3F) {
        const float inner = half + s.surround;
        const float leaves = across(w, inner, inner + leaf) + across(w, -inner - leaf, -inner);
        const float louvres = 1.0F - 0.35F * periodicCoverage(w.y, 0.11F, 0.0F, 0.04F, w.wy);
        blend(colour, leaves * row.upward(w, s.sill, head), louvres * s.shutter, wall);
    }
    const glm::vec3 below = s.surround > 0.0F ? s.trim : wall;
    blend(colour, across(w, -half, half) * row.upward(w, s.sill, head), s.frameColour, below);

    const float storey = std::floor((w.y - row.floor) / row.height);
    const float height01 = (w.y - row.floor - storey * row.height - s.sill) / s.height;
    const Panes panes =
        panesOf(building.seed, w.column, std::int32_t(storey), height01, w.wu + w.wy);
    const float bar = s.modern ? 0.0F : 0.03F;
    const float columns = s.modern
                              ? across(w, -half + s.frame, half - s.frame)
                              : across(w, -half + s.frame, -bar) + across(w, bar, half - s.frame);
    const float transom = s.sill + 0.68F * s.height;
    const float rows = s.modern ? row.upward(w, s.sill + s.frame, head - s.frame)
                                : row.upward(w, s.sill + s.frame, transom - bar) +
                                      row.upward(w, transom + bar, head - s.frame);
    blend(colour, columns * rows, panes.colour, s.frameColour);
    // The lintel's shadow lies on the upper edge of frame and glass.
    colour *= 1.0F - 0.45F * across(w, -half, half) * row.upward(w, head - 0.11F, head);
    look.emission += night * panes.lit * columns * rows * kLamp;
}

/// What is seen through the pane of a shop: a dim room, goods of many colours on display.
struct ShopWindow {
    glm::vec3 colour;
    float lit;
};

ShopWindow shopWindow(const WallPoint& w, float within, std::uint32_t shop) {
    constexpr std::array<std::uint32_t, 6> palette{0xC9B48C, 0x8E3B33, 0x4F6F86,
                                                   0xD9D2C2, 0x6E7B4E, 0xB98443};
    constexpr float kItem = 0.36F;
    const glm::vec3 room =
        glm::mix(glm::mix(kGlass, kSkyInGlass, std::clamp(w.y / 2.6F, 0.0F, 1.0F)),
                 glm::vec3(0.30F, 0.25F, 0.18F), 0.16F);
    const auto item = std::int32_t(std::floor(within / kItem));
    const float height = 0.55F + 0.9F * patternRandom(shop ^ 0x33U, item, w.column);
    const float margin = 0.05F + 0.1F * patternRandom(shop ^ 0x44U, item, w.column);
    const float there = intervalCoverage(w.y, 0.4F, height, w.wy) *
                        periodicCoverage(within, kItem, margin, kItem - margin, w.wu);
    const glm::vec3 goods = 0.55F * choose(patternHash(shop, item, w.column), palette);
    const float own = resolved(kItem, w.wu);
    const glm::vec3 mean = glm::mix(room, glm::vec3(0.16F, 0.13F, 0.10F), 0.2F);
    return {glm::mix(mean, glm::mix(room, goods, there), own), 0.7F + 0.3F * own * there};
}

/// A shop front in each bay of the ground floor: stall riser, panes, fascia, perhaps an awning.
void drawShops(const Style& s, const BuildingLook& building, const WallPoint& w, float night,
               Appearance& look) {
    if (w.lastBay <= w.firstBay) {
        return;
    }
    const Storeys row{0.0F, s.groundStorey, 0.0F, 1.0F};
    const float half = 0.5F * w.bay - 0.24F;
    glm::vec3& colour = look.albedo;
    // Two bays make a shop; its colour fades to the row's mean far away.
    const std::uint32_t shop = patternHash(building.seed ^ 0xC3U, w.column >> 1);
    const float own = resolved(4.0F, w.wu);
    constexpr std::array<std::uint32_t, 6> palette{0x8A3F38, 0x3C6655, 0x3D5270,
                                                   0xA9823F, 0x55555A, 0x7D5A47};
    const glm::vec3 paint = glm::mix(glm::vec3(0.140F, 0.115F, 0.095F), choose(shop, palette), own);
    const float opening = across(w, -half, half);
    blend(colour, opening * row.upward(w, 0.0F, 3.25F), paint, colour);
    blend(colour, across(w, -half - 0.12F, half + 0.12F) * row.upward(w, 3.25F, 3.33F), s.trim,
          colour);
    // Panes between mullions, with goods that catch some light near the ground.
    const float pane = 2.0F * half / std::max(1.0F, std::floor(2.0F * half / 1.15F));
    const float within = w.u - std::floor(w.u / w.bay) * w.bay - 0.5F * w.bay + half;
    const float mullions = glm::mix(
        0.93F, periodicCoverage(within, pane, 0.04F, pane - 0.04F, w.wu), resolved(1.0F, w.wu));
    const float glass = opening * mullions * row.upward(w, 0.45F, 2.55F);
    const ShopWindow window = shopWindow(w, within, shop);
    const glm::vec3 inside = window.colour;
    blend(colour, glass, inside, paint);
    look.emission += night * glass * kShopLamp * window.lit;
    if (s.awnings && (shop & 3U) != 0U) {
        const float stripes = periodicCoverage(w.u, 0.44F, 0.0F, 0.22F, w.wu);
        const glm::vec3 cloth = glm::mix(glm::vec3(0.72F, 0.68F, 0.58F), paint * 1.7F, stripes);
        const float hang = opening * row.upward(w, 2.05F, 2.62F) * own;
        const float shade = 1.0F - 0.5F * opening * own * row.upward(w, 1.75F, 2.05F);
        colour *= shade;
        colour = glm::mix(colour, glm::min(cloth, glm::vec3(0.8F)), hang);
    }
}

void drawDoor(const Style& s, const WallPoint& w, const glm::vec3& leaf, Appearance& look) {
    const Storeys row{0.0F, s.groundStorey, 0.0F, 1.0F};
    blend(look.albedo, across(w, -0.82F, 0.82F) * row.upward(w, 0.0F, 2.75F), s.trim, look.albedo);
    blend(look.albedo, across(w, -0.66F, 0.66F) * row.upward(w, 0.0F, 2.58F), leaf, s.trim);
    blend(look.albedo, across(w, -0.60F, 0.60F) * row.upward(w, 2.15F, 2.50F), kSkyInGlass, leaf);
    const float panels = (across(w, -0.52F, -0.10F) + across(w, 0.10F, 0.52F)) *
                         (row.upward(w, 0.2F, 0.85F) + row.upward(w, 1.0F, 1.95F));
    look.albedo *= 1.0F - 0.25F * panels;
}

/// Whether the window of the point's own bay and storey lies wholly on the wall.
bool windowFits(const SurfaceLook& look, const BuildingLook& building, const Style& s,
                const WallPoint& w, const Storeys& row, WallContains contains, const void* wall) {
    const float storey = std::floor((w.y - row.floor) / row.height);
    const float foot = building.base + row.floor + storey * row.height;
    const float middle = look.uMin + (look.width > 0.0F && !s.modern ? 0.25F : 0.0F) +
                         (float(w.column) + 0.5F) * w.bay;
    const float half = 0.5F * s.window + s.surround;
    return contains(wall, middle - half, middle + half, foot + s.sill - 0.15F,
                    foot + s.sill + s.height + s.surround);
}

}  // namespace

FacadeStyle facadeStyle(const SurfaceLook& look, const BuildingLook& building) {
    const std::uint32_t seed = building.seed;
    const auto random = [&](int what) { return patternRandom(seed, what, 77); };
    const float height = building.top - building.base;
    FacadeStyle s;
    s.wall = look.colour;
    s.trim = glm::min(glm::mix(s.wall, glm::vec3(0.86F, 0.84F, 0.79F), 0.62F), glm::vec3(0.85F));
    s.plinth = glm::mix(0.55F * s.wall, glm::vec3(0.24F, 0.23F, 0.215F), 0.6F);
    s.modern = height > 27.0F || (height > 10.0F && random(1) < 0.10F);
    if (s.modern) {
        s.storey = s.groundStorey = 3.3F + 0.3F * random(2);
        s.bay = 1.6F + 0.8F * random(3);
        s.window = s.bay - 0.16F;
        s.height = 1.7F + 0.5F * random(4);
        s.sill = 0.75F;
        s.surround = 0.0F;
        s.frame = 0.05F;
        s.frameColour =
            choose(seed ^ 0x9U, {0x3B3F43, 0x55595C, 0x8A8D8E, 0x2F3437, 0x6A6259, 0x43484A});
        s.groundStorey = 4.0F;
        s.shops = random(5) < 0.6F;
        return s;
    }
    s.storey = 3.0F + 0.45F * random(2);
    s.bay = 2.7F + 0.6F * random(3);
    s.window = 1.0F + 0.25F * random(4);
    s.height = 1.6F + 0.35F * random(6);
    s.sill = 0.80F + 0.1F * random(7);
    s.shops = height > 7.5F && random(5) < 0.5F;
    s.awnings = random(8) < 0.55F;
    s.shutters = random(9) < 0.5F;
    s.rusticated = !s.shops && height > 8.0F && random(10) < 0.5F;
    s.stringCourses = random(11) < 0.5F;
    s.groundStorey = s.shops ? 3.8F + 0.3F * random(12) : s.storey + 0.3F;
    s.frameColour =
        choose(seed ^ 0x3U, {0xE8E4DA, 0xDAD6CC, 0xEDEAE2, 0x5A4636, 0xCFCBC0, 0x44504A});
    s.shutter = choose(seed ^ 0x5U, {0x5E7F73, 0x6F8FA0, 0x56685A, 0x7B5B45, 0x8A9AA0, 0x4C6A78});
    return s;
}

glm::vec3 doorColour(const BuildingLook& building) {
    constexpr std::array<std::uint32_t, 6> palette{0x5A3E2B, 0x3E4F45, 0x34465A,
                                                   0x6A2F2A, 0x4A4038, 0x2F3B3A};
    return choose(building.seed ^ 0xE5U, palette);
}

FacadeGrid facadeGrid(const SurfaceLook& look, const BuildingLook& building, const FacadeStyle& s) {
    FacadeGrid g;
    const float top = look.top - building.base;
    const float bottom = look.bottom - building.base;
    g.bay = s.bay;
    if (look.width > 0.0F) {
        g.margin = s.modern ? 0.0F : 0.25F;
        const float usable = look.width - 2.0F * g.margin;
        const float bays = std::floor(usable / s.bay + 0.35F);
        g.firstBay = 0.0F;
        g.lastBay = usable > s.window + 0.7F ? std::max(bays, 1.0F) : 0.0F;
        g.bay = usable / std::max(bays, 1.0F);
    }
    // Storeys that stand wholly between the wall's foot and its cornice.
    g.firstStorey =
        std::max(0.0F, std::ceil((bottom - s.groundStorey - s.sill + 0.25F) / s.storey));
    g.lastStorey =
        std::floor((top - kCornice - 0.1F - s.groundStorey - s.sill - s.height) / s.storey) + 1.0F;
    g.firstGround = bottom < 0.8F ? 0.0F : 1.0F;
    g.lastGround = top > s.sill + s.height + 0.35F ? 1.0F : 0.0F;
    g.courses = top > s.groundStorey + 1.5F ? 1.0F : 0.0F;
    if (s.stringCourses && g.courses > 0.0F) {
        g.courses += std::max(0.0F, std::floor((top - s.groundStorey - 0.9F) / s.storey));
    }
    const auto bays = std::int32_t(std::min(g.lastBay, 1000.0F));
    if (g.firstBay >= 0.0F && bays > 1 && bottom < 0.8F) {
        g.doorBay = float(patternHash(building.seed ^ 0xD4U, bays) % std::uint32_t(bays));
    }
    return g;
}

Appearance facadeAppearance(const SurfaceLook& look, const BuildingLook& building,
                            const glm::vec3& point, const Footprint& footprint, float night,
                            WallContains contains, const void* wall) {
    const Style s = facadeStyle(look, building);
    const FacadeGrid grid = facadeGrid(look, building, s);
    const WallPoint w = placeOn(look, building, grid, point, footprint);
    Appearance result;
    result.albedo = masonry(s, building, w);

    const Storeys upper{s.groundStorey, s.storey, grid.firstStorey, grid.lastStorey};
    const Storeys ground{0.0F, s.groundStorey, grid.firstGround, grid.lastGround};
    const bool inGround = w.y < s.groundStorey;
    const bool fits = contains == nullptr || w.wu > w.bay ||
                      windowFits(look, building, s, w, inGround ? ground : upper, contains, wall);
    if (fits || inGround) {
        drawWindows(s, building, w, upper, fits ? night : 0.0F, result);
    }
    if (s.shops && w.top > s.groundStorey && w.bottom < 0.8F) {
        drawShops(s, building, w, night, result);
    } else if (!s.modern && inGround && float(w.column) == grid.doorBay && w.top > 3.0F) {
        drawDoor(s, w, doorColour(building), result);
    } else if (fits || !inGround) {
        drawWindows(s, building, w, ground, fits ? night : 0.0F, result);
    }
    result.albedo = glm::clamp(result.albedo, glm::vec3(0.0F), glm::vec3(0.95F));
    return result;
}

glm::vec3 facadeMean(const SurfaceLook& look) {
    return glm::mix(look.colour, glm::vec3(0.12F, 0.12F, 0.12F), 0.25F);
}

}  // namespace reflet
