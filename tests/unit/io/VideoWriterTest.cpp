// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/ImageFile.h"
#include "core/io/VideoWriter.h"
#include "tests/support/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

namespace reflet {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes picture(const VideoWriter::Format& format, std::uint8_t red) {
    Bytes rgb(std::size_t(3) * std::size_t(format.width) * std::size_t(format.height), 10);
    for (std::size_t i = 0; i < rgb.size(); i += 3)
        rgb[i] = red;
    return rgb;
}

std::size_t entries(const std::filesystem::path& folder) {
    return std::size_t(std::distance(std::filesystem::directory_iterator(folder), {}));
}

std::string outputOf(const std::string& command) {
    std::FILE* pipe = popen(command.c_str(), "r");
    std::array<char, 256> text{};
    const std::size_t length = std::fread(text.data(), 1, text.size(), pipe);
    pclose(pipe);
    return {text.data(), length};
}

TEST(VideoWriter, WritesNumberedPicturesOfEvenSizeWithoutAnEncoder) {
    const test::TemporaryFolder folder;
    const VideoWriter::Format format{35, 19, 10};
    auto writer = VideoWriter::open(folder / "film.mp4", format, VideoWriter::Encoder::Pictures);
    ASSERT_TRUE(writer.has_value()) << writer.error().message();
    ASSERT_TRUE((*writer)->add(picture(format, 50)).has_value());
    ASSERT_TRUE((*writer)->add(picture(format, 200)).has_value());
    const auto written = (*writer)->finish();
    ASSERT_TRUE(written.has_value()) << written.error().message();
    EXPECT_EQ(*written, folder / "film");
    EXPECT_EQ(entries(*written), 2U);
    const auto second = readTexture(*written / "frame-00002.png");
    ASSERT_TRUE(second.has_value());
    EXPECT_EQ(second->width, 34);
    EXPECT_EQ(second->height, 18);
    EXPECT_EQ(second->rgba[0], 200);
}

TEST(VideoWriter, LeavesNothingBehindWhenItIsNotFinished) {
    const test::TemporaryFolder folder;
    const VideoWriter::Format format{32, 16, 10};
    for (const auto encoder :
         {VideoWriter::Encoder::Pictures, VideoWriter::Encoder::FfmpegOrPictures}) {
        auto writer = VideoWriter::open(folder / "film.mp4", format, encoder);
        ASSERT_TRUE(writer.has_value());
        ASSERT_TRUE((*writer)->add(picture(format, 50)).has_value());
        writer->reset();
        EXPECT_EQ(entries(folder.path()), 0U);
    }
}

TEST(VideoWriter, RefusesFoldersThatDoNotExistAndImpossibleSizes) {
    const test::TemporaryFolder folder;
    const auto nowhere = VideoWriter::open(folder / "no" / "film.mp4", {});
    ASSERT_FALSE(nowhere.has_value());
    EXPECT_EQ(nowhere.error().code, ErrorCode::WriteFailed);
    EXPECT_FALSE(nowhere.error().remedy.empty());
    const auto tiny = VideoWriter::open(folder / "film.mp4", {1, 16, 30});
    ASSERT_FALSE(tiny.has_value());
    EXPECT_EQ(tiny.error().code, ErrorCode::Usage);
}

TEST(VideoWriter, DoesNotOverwriteAFolderOfPictures) {
    const test::TemporaryFolder folder;
    std::filesystem::create_directory(folder / "film");
    folder.write("film/mine.txt", "mine");
    const auto writer = VideoWriter::open(folder / "film.mp4", {}, VideoWriter::Encoder::Pictures);
    ASSERT_FALSE(writer.has_value());
    EXPECT_EQ(entries(folder / "film"), 1U);
}

TEST(VideoWriter, EncodesH264ThatPlaysEverywhereByFfmpeg) {
    if (!isFfmpegThere())
        GTEST_SKIP() << "no ffmpeg in PATH";
    const test::TemporaryFolder folder;
    const VideoWriter::Format format{65, 48, 30};
    auto writer = VideoWriter::open(folder / "film.mp4", format);
    ASSERT_TRUE(writer.has_value()) << writer.error().message();
    for (int i = 0; i < 45; ++i)
        ASSERT_TRUE((*writer)->add(picture(format, std::uint8_t(5 * i))).has_value());
    const auto written = (*writer)->finish();
    ASSERT_TRUE(written.has_value()) << written.error().message();
    EXPECT_EQ(entries(folder.path()), 1U);
    EXPECT_EQ(outputOf("ffprobe -v error -select_streams v -count_frames -show_entries "
                       "stream=codec_name,width,height,pix_fmt,nb_read_frames -of csv=p=0 '" +
                       written->string() + "'"),
              "h264,64,48,yuv420p,45\n");
}

TEST(VideoWriter, TellsWhatFfmpegSaysWhenItGivesUp) {
    // Another ffmpeg in PATH that reads nothing and complains.
    const test::TemporaryFolder folder;
    const auto script = folder.write("bin/ffmpeg", "#!/bin/sh\necho no libx264 here >&2\nexit 1\n");
    std::filesystem::permissions(script, std::filesystem::perms::owner_all);
    const std::string before = std::getenv("PATH");
    setenv("PATH", (script.parent_path().string() + ":" + before).c_str(), 1);
    const VideoWriter::Format format{640, 480, 30};
    {
        auto writer = VideoWriter::open(folder / "film.mp4", format);
        ASSERT_TRUE(writer.has_value());
        Result<void> added;
        for (int i = 0; i < 100 && added; ++i)
            added = (*writer)->add(picture(format, 1));
        const Error error = added ? (*writer)->finish().error() : added.error();
        EXPECT_EQ(error.code, ErrorCode::WriteFailed);
        EXPECT_NE(error.what.find("no libx264 here"), std::string::npos) << error.what;
    }
    setenv("PATH", before.c_str(), 1);
    EXPECT_FALSE(std::filesystem::exists(folder / "film.mp4"));
}

}  // namespace
}  // namespace reflet
