// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/document/HeadStart.h"
#include "app/document/JobRunner.h"
#include "app/document/ProjectDocument.h"
#include "app/pipeline/Bake.h"
#include "app/pipeline/Figures.h"
#include "app/pipeline/Traffic.h"
#include "core/baking/AmbientVolume.h"
#include "core/gpu/Frame.h"

#include <QObject>
#include <QTimer>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace reflet {

/// Follows a document and keeps what is derived from its project: city, light, vehicles, baked
/// maps. Long work runs as jobs; whatever is there is published at once, one by one. GUI thread
/// only; both references must outlive this. Derived data lie beside ProjectDocument::dataFile().
class LiveCity : public QObject {
    Q_OBJECT
public:
    LiveCity(ProjectDocument& document, JobRunner& jobs, QObject* parent = nullptr);
    ~LiveCity() override;

    /// The project with what belongs to it; null while loading. Its project is the document's.
    [[nodiscard]] std::shared_ptr<const PreparedCity> prepared() const { return m_prepared; }
    [[nodiscard]] std::shared_ptr<const DrawnCity> city() const { return m_drawn; }
    [[nodiscard]] Lighting lighting() const { return m_lighting; }
    /// Null until it was gathered, and while the light changes.
    [[nodiscard]] std::shared_ptr<const AmbientVolume> ambient() const { return m_ambient; }
    /// The maps in use, in the project's order: a moved probe's old one at its old place until the
    /// new one is baked.
    [[nodiscard]] RemSet rems() const { return m_rems; }
    /// Never null; empty while vehicles are read.
    [[nodiscard]] std::shared_ptr<const Traffic> traffic() const { return m_traffic; }

    [[nodiscard]] ProbeState probeState(const std::string& id) const;
    /// Why the probe cannot be baked; empty unless it was refused.
    [[nodiscard]] QString probeProblem(const std::string& id) const;
    /// Where (absolute) a refused probe could stand instead.
    [[nodiscard]] std::optional<glm::dvec3> freePlace(const std::string& id) const;
    /// The map in use for a probe; may be null.
    [[nodiscard]] std::shared_ptr<const ReferenceEnvironmentMap> rem(const std::string& id) const;

    [[nodiscard]] std::optional<double> groundHeight(double x, double y) const;  ///< project frame
    /// From the pavement, the sun behind: where a pedestrian would look at the reflector.
    [[nodiscard]] Camera streetCamera(std::size_t reflector, double seconds) const;
    [[nodiscard]] std::vector<FileReport> reports() const;
    [[nodiscard]] std::vector<Diagnostic> remarks() const;
    /// The file that relative paths and the cache belong to: the document's dataFile().
    [[nodiscard]] std::filesystem::path projectFile() const;

    [[nodiscard]] bool loading() const { return m_loading; }
    [[nodiscard]] bool baking() const;
    [[nodiscard]] int probesToBake() const;  ///< those that are neither fresh nor refused
    /// On from the start.
    void setAutoBake(bool on);
    [[nodiscard]] bool autoBake() const { return m_autoBake; }
    /// Bakes all that is missing or stale, also without auto-bake.
    void bakeNow();
    /// Stops until the next change of the project, or bakeNow().
    void cancelBaking();
    /// What the next city shall be made from, as far as it belongs to the project.
    void setHeadStart(std::shared_ptr<const HeadStart> ahead) { m_ahead = std::move(ahead); }
    /// A city that was read for a project which is about to be opened.
    void setReadCity(Project project, std::shared_ptr<const LoadedCity> city) {
        m_read = ReadCity{std::move(project), std::move(city)};
    }
    /// Nothing long is begun for a city that just came until letWorkGoOn(), or for two and a half
    /// seconds: its first picture is drawn with all cores. To be called while it is announced.
    void holdWork();
    void letWorkGoOn();
    /// Reads the models again: their files came back or changed.
    void reload();

    /// Measures methods at a pose in the background, replacing a measurement that runs; the last
    /// reference maps are used again while the pose, the light and the resolution are the same.
    /// resolution: of the maps; 0 = the project's (64 for live figures).
    void measure(double seconds, const std::string& reflector, const std::vector<Method>& methods,
                 int resolution = 0);
    [[nodiscard]] std::optional<PoseFigures> figures() const { return m_figures; }
    /// Ray-traced maps of the measured reflector, for the wipe.
    [[nodiscard]] GivenMaps referenceMaps() const;

Q_SIGNALS:
    void loadingChanged();
    void cityChanged();
    void lightingChanged();
    void ambientChanged();
    void remsChanged();
    void trafficChanged();
    void probeStatesChanged();
    void bakingChanged();
    void figuresChanged();
    void measuringFailed();  ///< or was cancelled: nothing comes of the measurement
    void problem(const reflet::Error& error);
    void remark(const reflet::Diagnostic& diagnostic);

private:
    /// What is known about a probe.
    struct Record {
        std::string wanted;   ///< key of the map that it should have
        std::string looked;   ///< key that was looked for in the cache in vain
        std::string refused;  ///< key for which baking was refused
        RemSet::Pointer map;  ///< in use; may be of another key
        std::string mapKey;
        QString reason;  ///< of the refusal
        std::optional<glm::dvec3> freePlace;
    };
    using Changes = ProjectChanges;

    void follow(ProjectChanges what);
    void load();
    void publish(std::shared_ptr<const PreparedCity> city, std::shared_ptr<const DrawnCity> drawn);
    void forget();
    void forgetFigures();
    /// Brings the prepared city's project up to date where nothing long is needed.
    void refreshProject();
    void refreshTraffic();
    void refreshLighting();
    void gatherAmbientLight();

    void matchProbes();
    void publishRems();
    void pump();
    void readCached();
    void bakeNext();
    void accept(const std::string& id, const std::string& key, RemSet::Pointer map);
    void refuse(const std::string& id, const std::string& key, const Error& error);
    [[nodiscard]] const Probe* nextToBake() const;
    [[nodiscard]] const Probe* probe(const std::string& id) const;
    void stopBaking();
    void discard(std::shared_ptr<const void> data);

    ProjectDocument& m_document;
    JobRunner& m_jobs;
    std::shared_ptr<const PreparedCity> m_prepared;
    std::shared_ptr<const DrawnCity> m_drawn;
    std::shared_ptr<const AmbientVolume> m_ambient;
    std::shared_ptr<const Traffic> m_traffic;
    std::shared_ptr<VehicleShelf> m_vehicles;  ///< shared with the job that fills it
    Lighting m_lighting;
    RemSet m_rems;
    std::map<std::string, Record> m_records;
    std::optional<PoseFigures> m_figures;
    Lighting m_figuresLight;
    std::vector<glm::dvec3> m_figuresOthers;  ///< where the other vehicles stood

    std::string m_bakingId, m_bakingKey;  ///< of the job that runs; empty = none
    quint64 m_bakingJob = 0;
    bool m_reading = false;  ///< maps are read from the cache
    bool m_loading = false;
    std::shared_ptr<const HeadStart> m_ahead;
    struct ReadCity {
        Project project;
        std::shared_ptr<const LoadedCity> city;
    };
    std::optional<ReadCity> m_read;
    Project m_loadingProject;  ///< whose city is being read
    std::filesystem::path m_loadingFile;
    bool m_autoBake = true;
    bool m_bakeAll = false;  ///< bakeNow() was called
    bool m_stopped = false;  ///< cancelBaking() was called
    QTimer m_held;           ///< runs while work waits for a first picture
    QTimer m_settle;         ///< runs while changes come quickly
    QTimer m_settleLight;
};

}  // namespace reflet
