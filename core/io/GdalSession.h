// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gdal_priv.h>

#include <memory>
#include <string>

namespace reflet {

/// While it lives, what GDAL has to say in this thread is kept instead of printed; its drivers are
/// registered. Only for the .cpp files of core/io.
class GdalSession {
public:
    GdalSession();
    ~GdalSession();
    GdalSession(const GdalSession&) = delete;
    GdalSession& operator=(const GdalSession&) = delete;

    /// Whether GDAL reported a failure (a warning is none).
    [[nodiscard]] bool failed() const { return !m_failure.empty(); }
    /// GDAL's first failure, in its own words; else its last warning; else empty.
    [[nodiscard]] const std::string& message() const {
        return m_failure.empty() ? m_warning : m_failure;
    }

private:
    static void CPL_STDCALL keep(CPLErr level, CPLErrorNum number, const char* text);

    std::string m_failure;
    std::string m_warning;
};

struct GdalClose {
    void operator()(GDALDataset* dataset) const { GDALClose(dataset); }
};
using GdalDataset = std::unique_ptr<GDALDataset, GdalClose>;

}  // namespace reflet
