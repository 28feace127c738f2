// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/RasterFile.h"

#include "core/base/Files.h"
#include "core/io/GdalSession.h"

#include <fmt/format.h>
#include <gdal_utils.h>

#include <algorithm>
#include <atomic>
#include <cctype>
#include <cmath>
#include <cpl_string.h>
#include <cpl_vsi.h>
#include <limits>
#include <vector>

namespace reflet {

namespace fs = std::filesystem;

namespace {

/// Formats that keep their data in the file itself or beside it. Left out on purpose: web services,
/// databases and archives.
constexpr const char* kDrivers[] = {
    "GTiff",   "VRT",     "AAIGrid",     "GRASSASCIIGrid", "XYZ",  "HFA",   "EHdr", "ENVI", "DTED",
    "SRTMHGT", "USGSDEM", "BT",          "GSAG",           "GSBG", "GS7BG", "SAGA", "RST",  "ERS",
    "PNG",     "JPEG",    "JP2OpenJPEG", "WEBP",           "BMP",  "GPKG",  nullptr};
constexpr std::int64_t kLargestBlock = std::int64_t(256) << 20;  // bytes
constexpr const char* kMend = "Open it in QGIS, or mend it with gdal_translate, and try again.";

/// The unit that a band names, in metres.
std::optional<double> unitOf(std::string name) {
    std::transform(name.begin(), name.end(), name.begin(),
                   [](unsigned char c) { return char(std::tolower(c)); });
    if (name == "m" || name == "metre" || name == "meter" || name == "metres" || name == "meters")
        return 1.0;
    if (name == "ft" || name == "foot" || name == "feet" || name == "international foot")
        return 0.3048;
    if (name == "us survey foot" || name == "ftus" || name == "us-ft" || name == "us ft" ||
        name == "us_survey_foot")
        return 1200.0 / 3937.0;
    if (name == "cm" || name == "centimetre" || name == "centimeter")
        return 0.01;
    if (name == "mm")
        return 0.001;
    return std::nullopt;
}

std::optional<std::string> wktOf(const OGRSpatialReference* system) {
    if (system == nullptr || system->IsEmpty() || system->IsLocal())
        return std::nullopt;
    char* text = nullptr;
    const char* const options[] = {"FORMAT=WKT2_2019", nullptr};
    system->exportToWkt(&text, options);
    std::string wkt = text == nullptr ? "" : text;
    CPLFree(text);
    return wkt.empty() ? std::nullopt : std::optional(std::move(wkt));
}

RasterInfo infoOf(GDALDataset& dataset) {
    RasterInfo info;
    info.format = dataset.GetDriverName();
    info.columns = dataset.GetRasterXSize();
    info.rows = dataset.GetRasterYSize();
    info.bands = dataset.GetRasterCount();
    info.placed = dataset.GetGeoTransform(info.transform.data()) == CE_None;
    info.crs = wktOf(dataset.GetSpatialRef());
    info.bytes = true;
    for (int k = 1; k <= info.bands; ++k)
        info.bytes &= dataset.GetRasterBand(k)->GetRasterDataType() == GDT_Byte;
    if (info.bands > 0) {
        info.palette = dataset.GetRasterBand(1)->GetColorTable() != nullptr;
        info.heightUnit = unitOf(dataset.GetRasterBand(1)->GetUnitType());
    }
    return info;
}

/// A VRT names its sources: only plain local files are followed.
Result<void> checkSources(const fs::path& path) {
    constexpr std::size_t kLargestVrt = std::size_t(64) << 20;
    const auto text = readFile(path, kLargestVrt);
    if (!text)
        return {};
    if (text->find("<VRTDataset") == std::string::npos)
        return {};
    for (const char* element : {"<SourceFilename", "<SourceDataset", "<OverviewFile"}) {
        for (std::size_t at = text->find(element); at != std::string::npos;
             at = text->find(element, at + 1)) {
            const std::size_t begin = text->find('>', at);
            const std::size_t end = text->find('<', begin == std::string::npos ? at : begin);
            const std::string name = begin == std::string::npos || end == std::string::npos
                                         ? std::string()
                                         : text->substr(begin + 1, end - begin - 1);
            if (name.empty() || name.find("/vsi") != std::string::npos ||
                name.find(':') != std::string::npos || name.find("&lt;") != std::string::npos)
                return fail(ErrorCode::Refused, "a source of it is no plain local file: " + name,
                            path.string(), "Build it anew over local files with gdalbuildvrt.");
        }
    }
    return {};
}

bool soundSize(GDALDataset& dataset, std::string& why) {
    if (dataset.GetRasterCount() < 1 || dataset.GetRasterXSize() < 1 ||
        dataset.GetRasterYSize() < 1) {
        why = "it holds no raster";
        return false;
    }
    return true;
}

/// True when a block can be held in memory; GDAL reads nothing smaller.
bool blocksFit(GDALRasterBand& band) {
    int width = 0;
    int height = 0;
    band.GetBlockSize(&width, &height);
    const int bytes = GDALGetDataTypeSizeBytes(band.GetRasterDataType());
    return std::int64_t(width) * height * std::max(bytes, 1) <= kLargestBlock;
}

void toHeights(GDALRasterBand& band, std::size_t count, const std::vector<GByte>& mask,
               float* heights) {
    constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
    const double scale = band.GetScale();
    const double offset = band.GetOffset();
    const bool scaled = scale != 1.0 || offset != 0.0;
    for (std::size_t i = 0; i < count; ++i) {
        if ((!mask.empty() && mask[i] == 0) || !std::isfinite(heights[i]))
            heights[i] = kNaN;
        else if (scaled)
            heights[i] = float(double(heights[i]) * scale + offset);
    }
}

struct OptionsFree {
    void operator()(GDALWarpAppOptions* options) const { GDALWarpAppOptionsFree(options); }
    void operator()(GDALTranslateOptions* options) const { GDALTranslateOptionsFree(options); }
};

/// The picture with its palette opened up, or null when that fails.
GdalDataset withoutPalette(GDALDataset& dataset) {
    CPLStringList arguments;
    for (const char* text : {"-of", "VRT", "-expand", "rgba"})
        arguments.AddString(text);
    const std::unique_ptr<GDALTranslateOptions, OptionsFree> options(
        GDALTranslateOptionsNew(arguments.List(), nullptr));
    return GdalDataset(static_cast<GDALDataset*>(
        GDALTranslate("", GDALDataset::ToHandle(&dataset), options.get(), nullptr)));
}

std::string number(double value) {
    return fmt::format("{:.17g}", value);
}

/// Where GDAL shall warp to, and how.
struct Target {
    std::optional<std::string> crs;
    glm::dvec2 min, max;
    int width = 0, height = 0;
    bool shrinks = false;  ///< several pixels of the source fall on one
};

GdalDataset warped(GDALDataset& source, const Target& target) {
    CPLStringList arguments;
    const auto add = [&](std::initializer_list<std::string> texts) {
        for (const std::string& text : texts)
            arguments.AddString(text.c_str());
    };
    add({"-of", "MEM", "-te", number(target.min.x), number(target.min.y), number(target.max.x),
         number(target.max.y), "-ts", std::to_string(target.width), std::to_string(target.height),
         "-r", target.shrinks ? "average" : "bilinear", "-wm", "64"});
    if (target.crs)
        add({"-t_srs", *target.crs, "-to", "ALLOW_BALLPARK=NO"});
    const int alpha = source.GetRasterCount();
    const bool hasAlpha = source.GetRasterBand(alpha)->GetColorInterpretation() == GCI_AlphaBand;
    if (!hasAlpha)
        add({"-dstalpha"});
    const std::unique_ptr<GDALWarpAppOptions, OptionsFree> options(
        GDALWarpAppOptionsNew(arguments.List(), nullptr));
    GDALDatasetH handle = GDALDataset::ToHandle(&source);
    return GdalDataset(
        static_cast<GDALDataset*>(GDALWarp("", nullptr, 1, &handle, options.get(), nullptr)));
}

/// Whether more than one and a half pixels of the file fall on one of the target, about.
bool shrinks(const RasterInfo& info, const std::optional<std::string>& crs, const glm::dvec2& size,
             int width) {
    if (crs && info.crs != crs)
        return true;  // averaging does no harm where it is not needed
    const double pixel = std::hypot(info.transform[1], info.transform[4]);
    return size.x / width > 1.5 * pixel;
}

}  // namespace

struct RasterFile::Impl {
    std::string subject;
    std::string memoryFile;  ///< to be unlinked; empty for a file on the disk
    GdalDataset dataset;
    RasterInfo info;

    Impl() = default;
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;
    ~Impl() {
        const GdalSession session;
        dataset.reset();
        if (!memoryFile.empty())
            VSIUnlink(memoryFile.c_str());
    }
    Result<void> take(const char* name) {
        const GdalSession session;
        dataset.reset(GDALDataset::Open(name, GDAL_OF_RASTER, kDrivers));
        std::string why = session.message();
        if (!dataset || !soundSize(*dataset, why))
            return fail(ErrorCode::Unreadable, "GDAL cannot read it as a raster: " + why, subject,
                        "GeoTIFF works best.");
        info = infoOf(*dataset);
        return {};
    }
};

RasterFile::RasterFile(std::unique_ptr<Impl> impl) : m_impl(std::move(impl)) {}
RasterFile::RasterFile(RasterFile&&) noexcept = default;
RasterFile& RasterFile::operator=(RasterFile&&) noexcept = default;
RasterFile::~RasterFile() = default;

Result<RasterFile> RasterFile::open(const fs::path& path) {
    std::error_code failed;
    if (!fs::is_regular_file(path, failed))
        return fail(ErrorCode::Unreadable, "there is no such file", path.string(),
                    "Check the name.");
    if (auto sound = checkSources(path); !sound)
        return tl::unexpected(sound.error());
    auto impl = std::make_unique<Impl>();
    impl->subject = path.string();
    // An absolute name cannot be taken for a connection or a virtual file system.
    if (auto taken = impl->take(fs::absolute(path).lexically_normal().c_str()); !taken)
        return tl::unexpected(taken.error());
    return RasterFile(std::move(impl));
}

Result<RasterFile> RasterFile::openBytes(std::string_view bytes, const std::string& name) {
    static std::atomic<unsigned> number{0};
    auto impl = std::make_unique<Impl>();
    impl->subject = name;
    impl->memoryFile = fmt::format("/vsimem/reflet-{}/{}", ++number, name);
    auto* const data = static_cast<GByte*>(CPLMalloc(bytes.size() + 1));
    std::copy(bytes.begin(), bytes.end(), data);
    VSILFILE* const file = VSIFileFromMemBuffer(impl->memoryFile.c_str(), data, bytes.size(), TRUE);
    if (file != nullptr)
        VSIFCloseL(file);
    if (auto taken = impl->take(impl->memoryFile.c_str()); !taken)
        return tl::unexpected(taken.error());
    return RasterFile(std::move(impl));
}

bool RasterFile::recognises(const fs::path& path) {
    std::error_code failed;
    if (!fs::is_regular_file(path, failed))
        return false;
    const GdalSession session;
    CPLStringList drivers;
    for (const char* const* name = kDrivers; *name != nullptr; ++name)
        drivers.AddString(*name);
    return GDALIdentifyDriverEx(fs::absolute(path).lexically_normal().c_str(), GDAL_OF_RASTER,
                                drivers.List(), nullptr) != nullptr;
}

const RasterInfo& RasterFile::info() const {
    return m_impl->info;
}

Result<void> RasterFile::readHeights(int firstColumn, int firstRow, int columns, int rows,
                                     float* heights) const {
    const GdalSession session;
    GDALRasterBand& band = *m_impl->dataset->GetRasterBand(1);
    if (!blocksFit(band))
        return fail(ErrorCode::ResourceLimit, "its blocks are too large to be read",
                    m_impl->subject, "Write it anew in tiles: gdal_translate -co TILED=YES.");
    const auto failed = [&] {
        return fail(ErrorCode::Unreadable, "its data are damaged: " + session.message(),
                    m_impl->subject, kMend);
    };
    if (band.RasterIO(GF_Read, firstColumn, firstRow, columns, rows, heights, columns, rows,
                      GDT_Float32, 0, 0, nullptr) != CE_None)
        return failed();
    std::vector<GByte> mask;
    const std::size_t count = std::size_t(columns) * std::size_t(rows);
    if ((band.GetMaskFlags() & GMF_ALL_VALID) == 0) {
        mask.resize(count);
        GDALRasterBand& maskBand = *band.GetMaskBand();
        if (!blocksFit(maskBand) ||
            maskBand.RasterIO(GF_Read, firstColumn, firstRow, columns, rows, mask.data(), columns,
                              rows, GDT_Byte, 0, 0, nullptr) != CE_None)
            return failed();
    }
    if (session.failed())
        return failed();
    toHeights(band, count, mask, heights);
    return {};
}

Result<TextureImage> RasterFile::readPicture(const std::optional<std::string>& crs,
                                             const glm::dvec2& min, const glm::dvec2& max,
                                             int width, int height) const {
    const GdalSession session;
    const RasterInfo& info = m_impl->info;
    if (!info.bytes)
        return fail(ErrorCode::Refused, "its colours have more than 8 bits", m_impl->subject,
                    "Convert it: gdal_translate -ot Byte -scale IN.tif OUT.tif");
    const auto failed = [&] {
        return fail(ErrorCode::Unreadable, "its data are damaged: " + session.message(),
                    m_impl->subject, kMend);
    };
    for (int k = 1; k <= info.bands; ++k)
        if (!blocksFit(*m_impl->dataset->GetRasterBand(k)))
            return fail(ErrorCode::ResourceLimit, "its blocks are too large to be read",
                        m_impl->subject, "Write it anew in tiles: gdal_translate -co TILED=YES.");
    GdalDataset expanded;
    GDALDataset* source = m_impl->dataset.get();
    if (info.palette) {
        expanded = withoutPalette(*source);
        source = expanded.get();
    }
    if (source == nullptr)
        return failed();
    // A file without a system lies in that of the target.
    const auto system = info.crs ? crs : std::nullopt;
    const GdalDataset picture =
        warped(*source, {system, min, max, width, height, shrinks(info, system, max - min, width)});
    if (!picture || session.failed())
        return failed();

    TextureImage image{width, height, {}};
    image.rgba.resize(4 * std::size_t(width) * std::size_t(height));
    const int bands = picture->GetRasterCount();
    const bool grey = bands < 4;
    const std::array<int, 4> from{1, grey ? 1 : 2, grey ? 1 : 3, bands};
    for (std::size_t c = 0; c < 4; ++c)
        if (picture->GetRasterBand(from[c])->RasterIO(
                GF_Read, 0, 0, width, height, image.rgba.data() + c, width, height, GDT_Byte, 4,
                4 * GSpacing(width), nullptr) != CE_None)
            return failed();
    return image;
}

}  // namespace reflet
