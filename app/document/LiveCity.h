// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/document/JobRunner.h"
#include "app/document/ProjectDocument.h"
#include "app/pipeline/PreparedCity.h"
#include "core/baking/AmbientVolume.h"
#include "core/gpu/Frame.h"

#include <QObject>
#include <map>
#include <set>

namespace reflet {

/// What is derived from the document, kept up to date in the background: the city as it is drawn,
/// its light, the probes' maps, the traffic. GUI thread only.
class LiveCity : public QObject {
    Q_OBJECT
public:
    LiveCity(ProjectDocument& document, JobRunner& jobs, QObject* parent);

    [[nodiscard]] std::shared_ptr<const DrawnCity> city() const { return m_city; }
    [[nodiscard]] Lighting lighting() const { return m_lighting; }
    [[nodiscard]] std::shared_ptr<const AmbientVolume> ambient() const { return {}; }
    [[nodiscard]] RemSet rems() const;
    [[nodiscard]] std::shared_ptr<const Traffic> traffic() const { return m_traffic; }
    [[nodiscard]] ProbeState probeState(const std::string& id) const;
    [[nodiscard]] QString probeProblem(const std::string& id) const;
    [[nodiscard]] std::shared_ptr<const ReferenceEnvironmentMap> rem(const std::string& id) const;
    [[nodiscard]] std::optional<double> groundHeight(double x, double y) const;
    [[nodiscard]] Camera streetCamera(std::size_t reflector, double seconds) const;
    [[nodiscard]] std::vector<FileReport> reports() const;
    [[nodiscard]] bool loading() const { return m_loading; }
    [[nodiscard]] bool baking() const { return m_baking; }
    void setAutoBake(bool automatic) { m_autoBake = automatic; }
    void bakeNow();
    void cancelBaking();
    [[nodiscard]] GivenMaps referenceMaps() const { return {}; }

Q_SIGNALS:
    void cityChanged();
    void lightingChanged();
    void ambientChanged();
    void remsChanged();
    void trafficChanged();
    void probeStatesChanged();
    void figuresChanged();
    void problem(const reflet::Error& error);
    void remark(const reflet::Diagnostic& remark);

private:
    struct Prepared {
        std::shared_ptr<PreparedCity> city;
        std::shared_ptr<const DrawnCity> drawn;
    };
    void projectChanged(ProjectChanges what);
    void load();
    void updateTraffic();
    void bakeNext();
    [[nodiscard]] std::string keyOf(const Probe& probe) const;

    ProjectDocument& m_document;
    JobRunner& m_jobs;
    std::shared_ptr<PreparedCity> m_prepared;
    std::shared_ptr<const DrawnCity> m_city;
    std::shared_ptr<const Traffic> m_traffic;
    Lighting m_lighting;
    std::map<std::string, RemSet::Pointer> m_maps;  ///< by key
    std::map<std::string, std::string> m_refused;   ///< by key
    bool m_loading = false;
    bool m_baking = false;
    bool m_autoBake = true;
};

}  // namespace reflet
