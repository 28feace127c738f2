// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/pipeline/CaptionedPictures.h"
#include "app/pipeline/Compare.h"
#include "app/pipeline/ComparedPose.h"
#include "app/pipeline/TrafficMaps.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace reflet {

/// Draws the vehicle of a pose by each method and by ray tracing, and compares its pixels. All that
/// is given must outlive it.
class VehicleComparison {
public:
    VehicleComparison(const PreparedCity& city, const Traffic& traffic, const RemSet& rems,
                      const CompareOptions& options)
        : m_city(city), m_traffic(traffic), m_rems(rems), m_options(options) {}

    /// The next pose; with CompareOptions::drawVehicle its reference picture. number: from 1.
    [[nodiscard]] Result<void> begin(const ComparedPose& pose, std::size_t number,
                                     const JobContext& job);

    /// The vehicles as they stand at the pose, the compared one first.
    [[nodiscard]] TrafficMaps& maps() { return *m_maps; }

    /// A method's picture, when vehicles are drawn; maps: of all bodies. Fills in the cell's
    /// pictures and its figure.
    [[nodiscard]] Result<void> add(Method method, const std::vector<LocalEnvironmentMap>& maps,
                                   FigureTally& tally, SheetCell& cell, const JobContext& job);

    /// After the last method of a pose: the reference, each method and its FLIP beside one another
    /// in one picture. Its file; empty when no pictures are written.
    [[nodiscard]] Result<std::filesystem::path> finish();

    /// The file of the reference's picture; empty when none was written.
    [[nodiscard]] const std::filesystem::path& reference() const { return m_reference; }
    std::vector<std::filesystem::path> pictures;

private:
    Result<RenderedView> draw(const std::vector<LocalEnvironmentMap>& maps, const JobContext& job);
    Result<RenderedView> drawPixels(const JobContext& job);
    Result<RenderedView> draw(std::span<const PlacedBody> bodies, const JobContext& job) const;
    Result<std::filesystem::path> write(const DisplayImage& image, const std::string& name);

    const PreparedCity& m_city;
    const Traffic& m_traffic;
    const RemSet& m_rems;
    const CompareOptions& m_options;
    std::size_t m_number = 0;
    std::unique_ptr<TrafficMaps> m_maps;
    Camera m_camera;
    DisplayImage m_truth;
    std::vector<unsigned char> m_mask;
    std::vector<std::vector<CaptionedPicture>> m_rows;  ///< of this pose: one for each method
    std::filesystem::path m_reference;
};

}  // namespace reflet
