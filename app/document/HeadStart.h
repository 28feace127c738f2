// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/pipeline/PreparedCity.h"

#include <filesystem>
#include <future>
#include <memory>
#include <thread>

namespace reflet {

/// A project's city that is read while the window is still being made.
class HeadStart {
public:
    /// With what is drawn of it; both are null for a file that cannot be opened.
    struct City {
        std::shared_ptr<const PreparedCity> prepared;
        std::shared_ptr<const DrawnCity> drawn;
    };

    /// Begins to read the project and its city on a thread of its own.
    explicit HeadStart(const std::filesystem::path& projectFile);
    /// Cancels what is not finished, and waits for its end.
    ~HeadStart();
    HeadStart(const HeadStart&) = delete;
    HeadStart& operator=(const HeadStart&) = delete;

    /// Waits until it is read, or until the job is cancelled: then both are null.
    [[nodiscard]] City city(const JobContext& job) const;

private:
    std::shared_future<City> m_city;
    std::jthread m_thread;
};

}  // namespace reflet
