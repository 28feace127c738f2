// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/document/HeadStart.h"

#include <chrono>
#include <exception>

namespace reflet {

namespace {

HeadStart::City readCity(const std::filesystem::path& projectFile, const JobContext& job) {
    try {
        std::error_code error;
        const auto file = std::filesystem::weakly_canonical(projectFile, error);
        auto prepared = PreparedCity::open(error ? projectFile : file, job, {nullptr, true, true});
        if (!prepared)
            return {};
        auto drawn = prepared->drawn(job);
        if (!drawn)
            return {};
        return {std::make_shared<const PreparedCity>(std::move(*prepared)), std::move(*drawn)};
    } catch (const std::exception&) {
        return {};  // who opens the project meets the same and tells
    }
}

}  // namespace

HeadStart::HeadStart(const std::filesystem::path& projectFile) {
    std::promise<City> promise;
    m_city = promise.get_future().share();
    m_thread = std::jthread(
        [projectFile, promise = std::move(promise)](const std::stop_token& stop) mutable {
            promise.set_value(readCity(projectFile, JobContext({}, stop)));
        });
}

HeadStart::~HeadStart() = default;

HeadStart::City HeadStart::city(const JobContext& job) const {
    constexpr std::chrono::milliseconds poll(20);
    while (m_city.wait_for(poll) != std::future_status::ready) {
        if (job.cancelled())
            return {};
    }
    return m_city.get();
}

}  // namespace reflet
