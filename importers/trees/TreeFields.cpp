// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/trees/TreeFields.h"

#include "importers/common/FieldNames.h"
#include "importers/extrusion/Lengths.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <utility>

namespace reflet::trees {

namespace {

using importers::Fields;
using importers::firstField;
using importers::namedField;
using importers::plainName;

// Names as plainName() writes them, the surest first. Where a city has a class and its words
// (Vienna: BAUMHOEHE 2, BAUMHOEHE_TXT "6-10 m"), the words come first.
constexpr auto kIds = std::to_array<std::string_view>(
    {"baumid",   "standortnr", "treeid",    "pitid",       "baumnummer", "baumnr", "idbase",
     "idarbre",  "gisid",      "kennzeich", "kennzeichen", "assetid",    "boomid", "arbolid",
     "globalid", "objectid",   "uuid",      "gid",         "id",         "ref"});
constexpr auto kHeights = std::to_array<std::string_view>({"baumhoehetxt",
                                                           "baumhoehe",
                                                           "baumhöhe",
                                                           "hauteurenm",
                                                           "hauteurm",
                                                           "hauteur",
                                                           "treeheight",
                                                           "heightm",
                                                           "height",
                                                           "boomhoogte",
                                                           "boomhoogteklasseactueel",
                                                           "hoogte",
                                                           "hoehe",
                                                           "höhe",
                                                           "gesamthoehe",
                                                           "altura",
                                                           "altezza",
                                                           "alturatotal",
                                                           "hojde",
                                                           "højde",
                                                           "hoyde",
                                                           "høyde",
                                                           "visina",
                                                           "wysokosc"});
constexpr auto kCrowns = std::to_array<std::string_view>({"kronendurchmessertxt",
                                                          "kronedurch",
                                                          "kronendurchmesser",
                                                          "kronendurc",
                                                          "kronenbreite",
                                                          "kroneduchm",
                                                          "crowndiameter",
                                                          "diametercrown",
                                                          "crowndiam",
                                                          "crownspread",
                                                          "crownwidth",
                                                          "spreadm",
                                                          "spread",
                                                          "canopydiameter",
                                                          "canopyspread",
                                                          "canopywidth",
                                                          "kroondiameter",
                                                          "kroonbreedte",
                                                          "diametrecouronne",
                                                          "envergure",
                                                          "couronne",
                                                          "copa",
                                                          "diametrocopa",
                                                          "diametrochioma",
                                                          "kronediameter"});
constexpr auto kSpecies = std::to_array<std::string_view>(
    {"gattung",     "gattunglat", "baumgattunglat", "genre",           "genus",
     "artbot",      "spclatin",   "botanicalname",  "scientificname",  "baumartlat",
     "species",     "soortnaam",  "soortnaamtop",   "gattungart",      "baumart",
     "baumnamelat", "artdtsch",   "gattungdeutsch", "libellefrancais", "espece",
     "spccommon",   "commonname", "especie",        "nomcientific",    "specie",
     "leaftype"});
constexpr auto kGirths = std::to_array<std::string_view>(
    {"stammumfg", "stammumfang", "stammumfangcm", "circonferenceencm", "circonfere",
     "circonference", "umfang", "girth", "girthcm", "omtrek"});
constexpr auto kInches = std::to_array<std::string_view>({"treedbh", "dbhinches"});
constexpr auto kCentimetres = std::to_array<std::string_view>(
    {"stammdurchmesser", "stammdurch", "trunkdiameter", "dbhcm", "diametretronc"});
constexpr auto kLongitudes = std::to_array<std::string_view>(
    {"longitude", "lon", "long", "lng", "xlongitude", "geolon", "longitud", "xwgs84", "lonwgs84"});
constexpr auto kLatitudes = std::to_array<std::string_view>(
    {"latitude", "lat", "ylatitude", "geolat", "latitud", "ywgs84", "latwgs84"});
constexpr auto kEasts = std::to_array<std::string_view>(
    {"rechtswert", "ostwert", "easting", "east", "xkoordinate", "xcoord", "xcoordinate", "koordx",
     "e", "x", "xetrs89", "xlambert93", "xrd"});
constexpr auto kNorths = std::to_array<std::string_view>(
    {"hochwert", "nordwert", "northing", "north", "ykoordinate", "ycoord", "ycoordinate", "koordy",
     "n", "y", "yetrs89", "ylambert93", "yrd"});
constexpr auto kBoth =
    std::to_array<std::string_view>({"geopoint2d", "geopoint", "thegeom", "geom", "wkt", "geometry",
                                     "shape", "location", "geolocation"});
constexpr auto kConifers = std::to_array<std::string_view>({"abies",         "picea",
                                                            "pinus",         "larix",
                                                            "thuja",         "taxus",
                                                            "cedrus",        "cupressus",
                                                            "chamaecyparis", "cupressocyparis",
                                                            "juniperus",     "metasequoia",
                                                            "sequoia",       "sequoiadendron",
                                                            "pseudotsuga",   "tsuga",
                                                            "taxodium",      "araucaria",
                                                            "cryptomeria",   "calocedrus",
                                                            "kiefer",        "schwarzkiefer",
                                                            "fichte",        "tanne",
                                                            "lärche",        "laerche",
                                                            "eibe",          "zeder",
                                                            "lebensbaum",    "pine",
                                                            "spruce",        "fir",
                                                            "larch",         "cedar",
                                                            "yew",           "cypress",
                                                            "redwood",       "hemlock",
                                                            "sapin",         "pin",
                                                            "mélèze",        "if",
                                                            "cèdre",         "cyprès",
                                                            "needleleaved"});

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && std::isspace(static_cast<unsigned char>(text.front())) != 0)
        text.remove_prefix(1);
    while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())) != 0)
        text.remove_suffix(1);
    return text;
}

/// The numbers in a text, at most three; signs are words between them.
std::vector<double> numbersIn(std::string_view text) {
    std::vector<double> numbers;
    std::size_t i = 0;
    while (i < text.size() && numbers.size() < 3) {
        if (std::isdigit(static_cast<unsigned char>(text[i])) == 0) {
            ++i;
            continue;
        }
        // "1e400" is no range.
        if (i > 1 && std::isalpha(static_cast<unsigned char>(text[i - 1])) != 0 &&
            std::isdigit(static_cast<unsigned char>(text[i - 2])) != 0)
            return {};
        const std::size_t end = std::min(text.find_first_not_of("0123456789.,", i), text.size());
        std::string number(text.substr(i, end - i));
        while (number.ends_with('.') || number.ends_with(','))
            number.pop_back();
        std::replace(number.begin(), number.end(), ',', '.');
        double value = 0.0;
        const auto [stop, error] =
            std::from_chars(number.data(), number.data() + number.size(), value);
        if (error != std::errc() || stop != number.data() + number.size())
            return {};
        numbers.push_back(value);
        i = end;
    }
    return numbers;
}

std::string describe(const Fields& fields, const TreeFields& choice) {
    std::vector<std::string> parts;
    const auto add = [&](const char* what, std::optional<std::size_t> field) {
        if (field)
            parts.push_back(fmt::format("{} from {}", what, fields[*field]));
    };
    add("height", choice.height);
    add("crown", choice.crown);
    add("trunk", choice.girth ? choice.girth : choice.breadth);
    add("kind", choice.species);
    return fmt::to_string(fmt::join(parts, ", "));
}

}  // namespace

Result<TreeFields> chooseFields(const Fields& fields, const ImportOptions& options,
                                const std::string& subject) {
    TreeFields choice;
    const auto height = namedField(fields, options.heightField, "--height-field", subject);
    if (!height)
        return tl::unexpected(height.error());
    const auto crown = namedField(fields, options.crownField, "--crown-field", subject);
    if (!crown)
        return tl::unexpected(crown.error());
    choice.height = *height ? *height : firstField(fields, kHeights);
    choice.crown = *crown ? *crown : firstField(fields, kCrowns);
    choice.id = firstField(fields, kIds);
    choice.species = firstField(fields, kSpecies);
    choice.girth = firstField(fields, kGirths);
    choice.breadth = firstField(fields, kInches);
    choice.girthInches = choice.breadth.has_value();
    if (!choice.breadth)
        choice.breadth = firstField(fields, kCentimetres);
    choice.east = firstField(fields, kLongitudes);
    choice.north = firstField(fields, kLatitudes);
    choice.degrees = choice.east && choice.north;
    if (!choice.degrees) {
        choice.east = firstField(fields, kEasts);
        choice.north = firstField(fields, kNorths);
    }
    choice.both = firstField(fields, kBoth);
    choice.described = describe(fields, choice);
    return choice;
}

std::optional<double> parseSize(std::string_view text) {
    constexpr double kHighest = 2000.0;
    if (const auto plain = extrusion::parseLength(text))
        return *plain > 0.0 ? plain : std::nullopt;
    const std::vector<double> numbers = numbersIn(text);
    if (numbers.empty() || numbers.size() > 2 || trimmed(text).front() == '-')
        return std::nullopt;
    const double size = 0.5 * (numbers.front() + numbers.back());
    return size > 0.0 && size <= kHighest ? std::optional(size) : std::nullopt;
}

bool hasNeedles(std::string_view species) {
    std::size_t begin = 0;
    while (begin < species.size()) {
        const std::size_t end =
            std::min(species.find_first_of(" ,;:()'\"/-\t", begin), species.size());
        const std::string word = plainName(species.substr(begin, end - begin));
        if (std::find(kConifers.begin(), kConifers.end(), word) != kConifers.end())
            return true;
        begin = end + 1;
    }
    return plainName(species) == "needleleaved";
}

std::optional<double> parseCoordinate(std::string_view text) {
    std::string number(trimmed(text));
    if (std::count(number.begin(), number.end(), ',') == 1 && number.find('.') == std::string::npos)
        std::replace(number.begin(), number.end(), ',', '.');
    const char* const begin = number.data() + (number.starts_with('+') ? 1 : 0);
    double value = 0.0;
    const auto [end, error] = std::from_chars(begin, number.data() + number.size(), value);
    if (error != std::errc() || end != number.data() + number.size() || !std::isfinite(value))
        return std::nullopt;
    return value;
}

std::optional<glm::dvec2> parsePlace(std::string_view text) {
    text = trimmed(text);
    const bool wkt = text.starts_with("POINT") || text.starts_with("Point");
    if (wkt || text.starts_with('(')) {
        const auto open = text.find('('), close = text.rfind(')');
        if (open == std::string_view::npos || close == std::string_view::npos || close < open)
            return std::nullopt;
        text = trimmed(text.substr(open + 1, close - open - 1));
    }
    const std::size_t gap = text.find(wkt ? ' ' : ',');
    if (gap == std::string_view::npos)
        return std::nullopt;
    const auto first = parseCoordinate(text.substr(0, gap));
    // A height behind them does not matter.
    const std::string_view rest = trimmed(text.substr(gap + 1));
    const auto second = parseCoordinate(rest.substr(0, rest.find(wkt ? ' ' : ',')));
    if (!first || !second)
        return std::nullopt;
    return wkt ? glm::dvec2(*first, *second) : glm::dvec2(*second, *first);
}

TreeReader::TreeReader(TreeFields fields) : m_fields(std::move(fields)) {
    for (const auto& field :
         {m_fields.id, m_fields.height, m_fields.crown, m_fields.species, m_fields.girth,
          m_fields.breadth, m_fields.east, m_fields.north, m_fields.both}) {
        if (field)
            m_columns.push_back(*field);
    }
    std::sort(m_columns.begin(), m_columns.end());
    m_columns.erase(std::unique(m_columns.begin(), m_columns.end()), m_columns.end());
}

std::string_view TreeReader::value(const PointFeature& feature,
                                   std::optional<std::size_t> field) const {
    if (!field)
        return {};
    const auto found = std::lower_bound(m_columns.begin(), m_columns.end(), *field);
    return trimmed(feature.values[std::size_t(found - m_columns.begin())]);
}

std::string_view TreeReader::id(const PointFeature& feature) const {
    return value(feature, m_fields.id);
}

std::optional<glm::dvec2> TreeReader::place(const PointFeature& feature) const {
    if (!feature.places.empty())
        return glm::dvec2(feature.places.front());
    const auto east = parseCoordinate(value(feature, m_fields.east));
    const auto north = parseCoordinate(value(feature, m_fields.north));
    if (east && north)
        return glm::dvec2(*east, *north);
    return parsePlace(value(feature, m_fields.both));
}

std::optional<double> TreeReader::size(const PointFeature& feature,
                                       std::optional<std::size_t> field, double most) {
    const std::string_view text = value(feature, field);
    const auto metres = parseSize(text);
    // A zero says that nobody has measured.
    const bool silent = text.empty() || extrusion::parseLength(text) == 0.0;
    if (!silent && (!metres || *metres > most)) {
        ++m_tally.unreadable;
        if (m_tally.example.empty())
            m_tally.example = text;
        return std::nullopt;
    }
    return metres;
}

void TreeReader::read(const PointFeature& feature, Tree& tree) {
    constexpr double kHighest = 130.0, kWidest = 60.0;  // of any tree on Earth
    constexpr double kInch = 0.0254, kCentimetre = 0.01;
    tree.height = size(feature, m_fields.height, kHighest);
    tree.crown = size(feature, m_fields.crown, kWidest);
    if (const auto girth = parseSize(value(feature, m_fields.girth)))
        tree.trunkRadius = *girth * kCentimetre / (2.0 * kPi);
    else if (const auto breadth = parseSize(value(feature, m_fields.breadth)))
        tree.trunkRadius = 0.5 * *breadth * (m_fields.girthInches ? kInch : kCentimetre);
    tree.needles = hasNeedles(value(feature, m_fields.species));
    ++m_tally.trees;
    m_tally.heightAssumed += tree.height ? 0 : 1;
    m_tally.crownAssumed += tree.crown ? 0 : 1;
}

}  // namespace reflet::trees
