// SPDX-License-Identifier: GPL-3.0-or-later
// Packed files: the city is the same, and damage is told.
#include "importers/FormatRegistry.h"
#include "tests/support/TemporaryFolder.h"
#include "tests/unit/importers/CityGmlText.h"
#include "tests/unit/importers/CityJsonText.h"

#include <fstream>
#include <zlib.h>

namespace reflet {

using namespace test;

namespace {

std::string packed(const std::string& text) {
    z_stream stream{};
    deflateInit2(&stream, Z_BEST_SPEED, Z_DEFLATED, 16 + MAX_WBITS, 8, Z_DEFAULT_STRATEGY);
    std::string bytes(deflateBound(&stream, text.size()) + 64, '\0');
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
    stream.avail_in = static_cast<uInt>(text.size());
    stream.next_out = reinterpret_cast<Bytef*>(bytes.data());
    stream.avail_out = static_cast<uInt>(bytes.size());
    deflate(&stream, Z_FINISH);
    bytes.resize(stream.total_out);
    deflateEnd(&stream);
    return bytes;
}

class Gzip : public testing::Test {
protected:
    Result<Imported<CityImport>> read(const std::string& name, const std::string& bytes,
                                      const ImportOptions& options = {}) {
        const auto path = m_folder.path() / name;
        std::ofstream(path, std::ios::binary) << bytes;
        const auto format = cityFormatOf(path);
        if (!format)
            return tl::unexpected<Error>(format.error());
        return (*format)->read(path, options, {});
    }

private:
    TemporaryFolder m_folder;
};

std::string boxGml() {
    return cityGml(
        building("a", "<bldg:lod1Solid>" + solidOf(boxFaces(0, 0)) + "</bldg:lod1Solid>"));
}

}  // namespace

TEST_F(Gzip, APackedCityIsTheSameCity) {
    const std::string sequence = emptyCity().dump() + "\n" +
                                 json{{"type", "CityJSONFeature"},
                                      {"CityObjects", boxCity()["CityObjects"]},
                                      {"vertices", boxVertices()}}
                                     .dump() +
                                 "\n";
    for (const auto& [name, text] :
         {std::pair("a.city.json.gz", boxCity().dump()), std::pair("a.city.jsonl.gz", sequence),
          std::pair("a.gml.gz", boxGml()), std::pair("misnamed.gml", boxCity().dump())}) {
        const auto result = read(name, packed(text));
        ASSERT_TRUE(result) << name << ": " << result.error().message();
        EXPECT_NEAR(enclosedVolume(result->value.city), 480.0, 1e-3) << name;
    }
    // Several streams one behind the other are one file.
    const std::string gml = boxGml();
    EXPECT_TRUE(read("b.gml.gz", packed(gml.substr(0, 300)) + packed(gml.substr(300))));
    EXPECT_TRUE(hasCitySuffix("a.city.json.gz"));
}

TEST_F(Gzip, DamageIsTold) {
    std::string text = boxGml();
    for (int i = 0; i < 20000; ++i)
        text += std::to_string(i * 7919) + " ";  // behind the root, so that there is much to pack
    const std::string bytes = packed(text);
    const auto cut = read("cut.gml.gz", bytes.substr(0, 20));
    ASSERT_FALSE(cut);
    EXPECT_EQ(cut.error().code, ErrorCode::Unreadable);
    EXPECT_EQ(cut.error().what, "cannot be unpacked: it is cut off");
    std::string broken = bytes;
    broken[12] = static_cast<char>(broken[12] ^ 0xff);
    const auto damaged = read("damaged.gml.gz", broken);
    ASSERT_FALSE(damaged);
    EXPECT_EQ(damaged.error().code, ErrorCode::Unreadable);
}

TEST_F(Gzip, WhatUnpacksBeyondTheLimitIsRefused) {
    ImportOptions options;
    options.maxFileBytes = 1 << 20;
    const std::string bomb = packed("{" + std::string(64 << 20, ' '));
    EXPECT_LT(bomb.size(), options.maxFileBytes);
    const auto result = read("bomb.city.json.gz", bomb, options);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, ErrorCode::ResourceLimit);
    EXPECT_EQ(result.error().what, "unpacks to more than the limit of 1048576 bytes");
}

}  // namespace reflet
